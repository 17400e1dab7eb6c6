"""What ruler and tracks have in common: the scale, the playhead, wheel, pan and drags."""

from __future__ import annotations

from collections.abc import Callable
from math import floor

from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPen, QWheelEvent
from PySide6.QtWidgets import QWidget

from app.style import colours
from app.timeline.gestures import Gesture, Pan
from app.timeline.time_view import TimeView
from app.workspace import Workspace

ZOOM_A_NOTCH = 1.2
NOTCH = 120
"""Qt's angle of one notch of a wheel."""
HEAD = 30
"""Pixels on either side of the playhead that its head may cover."""


class TimeWidget(QWidget):
    """A widget along the time axis; subclasses paint and say what a press begins."""

    def __init__(self, workspace: Workspace, view: TimeView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.workspace, self.view = workspace, view
        self.setMouseTracking(True)
        self._gesture: Gesture | None = None
        self._playhead_x = view.scale.x(workspace.playhead.frame)
        view.changed.connect(self._on_scale_changed)
        workspace.playhead.moved.connect(self._on_playhead_moved)
        workspace.playhead.range_changed.connect(self.update)
        workspace.session.changed.connect(self.on_document_changed)

    # -- for subclasses ------------------------------------------------------------------------

    def begin(self, event: QMouseEvent) -> Gesture | None:
        """Return the gesture that a press of the left button begins."""
        raise NotImplementedError

    def on_document_changed(self) -> None:
        """Show the new document."""
        self.update()

    def paint_playhead(self, painter: QPainter) -> None:
        """Draw the line of the playhead over the full height."""
        painter.setPen(QPen(QColor(colours().accent), 1.5))
        x = self.view.scale.x(self.workspace.playhead.frame)
        painter.drawLine(QPointF(x, 0), QPointF(x, self.height()))

    # -- events --------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a gesture."""
        if self._gesture is None and event.button() == Qt.MouseButton.MiddleButton:
            self._gesture = Pan(self.view, event.position().x())
            self.setCursor(Qt.CursorShape.ClosedHandCursor)
        elif self._gesture is None and event.button() == Qt.MouseButton.LeftButton:
            self._gesture = self.begin(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Go on with it."""
        if self._gesture:
            self._gesture.move(event.position().x(), event.modifiers())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End it."""
        if self._gesture:
            self._end(self._gesture.finish)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Let Escape end a gesture as if it had not been."""
        if self._gesture and event.key() == Qt.Key.Key_Escape:
            self._end(self._gesture.cancel)
        else:
            super().keyPressEvent(event)

    def event(self, event: QEvent) -> bool:
        """Keep Escape for the gesture under way."""
        override = event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent)
        if override and self._gesture and event.key() == Qt.Key.Key_Escape:
            event.accept()
            return True
        return super().event(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the cursor; sideways, or with Shift, pan."""
        turn, sideways = event.angleDelta().y(), event.angleDelta().x()
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            turn, sideways = 0, sideways or turn
        if sideways:
            self.view.pan(sideways / 2)
        if turn:
            self.view.zoom(ZOOM_A_NOTCH ** (turn / NOTCH), event.position().x())
        event.accept()

    # -- keeping up ----------------------------------------------------------------------------

    @property
    def dragging(self) -> bool:
        """Whether a gesture is under way."""
        return self._gesture is not None

    def _end(self, how: Callable[[], None]) -> None:
        self._gesture = None
        self.unsetCursor()
        how()
        self.update()

    def _on_scale_changed(self) -> None:
        self._playhead_x = self.view.scale.x(self.workspace.playhead.frame)
        self.update()

    def _on_playhead_moved(self, frame: float) -> None:
        """Repaint no more than where the playhead was and is."""
        before, self._playhead_x = self._playhead_x, self.view.scale.x(frame)
        for x in (before, self._playhead_x):
            self.update(floor(x) - HEAD, 0, 2 * HEAD + 1, self.height())
