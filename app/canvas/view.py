"""One view of the document: pyqtgraph's view box under the shared camera, and its mouse events."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pyqtgraph as pg
from numpy.typing import ArrayLike
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QGraphicsItem, QGraphicsView

from app.canvas.camera import Camera
from app.canvas.pointer import Pointer
from app.style import colours
from core.model.outline import Array

if TYPE_CHECKING:
    from app.canvas.pane import Pane

PREFERRED_SIZE, LEAST_SIZE = (320, 240), (120, 90)
WHEEL_STEP = 1.0015
"""Zoom factor for an eighth of a degree of the wheel: 1.2 a notch."""


class View(pg.GraphicsView):
    """Shows items in document coordinates (y down) or in screen pixels.

    The camera alone says what is seen, so that all views stay together; the view box only carries
    the transform. Mouse events leave as ``Pointer``; keys are the canvas's.
    """

    pressed = Signal(object)
    moved = Signal(object)
    released = Signal(object)
    double_clicked = Signal(object)
    left = Signal()
    key_wanted = Signal(object)
    """A key event that asks who would take it; accept it to keep it from the shortcuts."""
    key_pressed = Signal(object)
    key_released = Signal(object)
    focus_changed = Signal()
    resized = Signal()

    def __init__(self, pane: Pane, camera: Camera) -> None:
        super().__init__(pane)
        self.pane, self._camera = pane, camera
        self._pan_from: QPointF | None = None
        self._held: Qt.MouseButton | None = None
        """The button whose press is under way; until it is let go, others do nothing."""
        self._hand = False
        self._cursor = Qt.CursorShape.ArrowCursor
        self._box = pg.ViewBox(enableMouse=False, enableMenu=False, defaultPadding=0.0)
        self._box.disableAutoRange()
        self._box.setAspectLocked(True)
        self._box.invertY(True)
        self.setCentralItem(self._box)
        self.setAntialiasing(True)
        # Items that change would have it painted once more than what calls for it
        self.setViewportUpdateMode(QGraphicsView.ViewportUpdateMode.NoViewportUpdate)
        self.setCacheMode(QGraphicsView.CacheModeFlag.CacheNone)
        self.setAcceptDrops(False)  # files are for the window
        self.viewport().setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.viewport().setMouseTracking(True)
        camera.changed.connect(self._aim)

    # -- the mouse ---------------------------------------------------------------------------

    @property
    def hand(self) -> bool:
        """Whether the left button moves the view, as the middle one always does."""
        return self._hand

    @hand.setter
    def hand(self, hand: bool) -> None:
        self._hand = hand
        self._show_cursor()

    def rest_cursor(self, cursor: Qt.CursorShape) -> None:
        """Set the cursor that is shown while the view is not being moved."""
        if cursor is not self._cursor:
            self._cursor = cursor
            self._show_cursor()

    def _show_cursor(self) -> None:
        shape = Qt.CursorShape.OpenHandCursor if self._hand else self._cursor
        if self._pan_from is not None:
            shape = Qt.CursorShape.ClosedHandCursor
        self.viewport().setCursor(shape)

    # -- coordinates ---------------------------------------------------------------------------

    @property
    def pixel(self) -> float:
        """Document units per screen pixel."""
        return 1.0 / self._camera.zoom

    def to_screen(self, points: ArrayLike) -> Array:
        """Map (…, 2) document points to pixels of this view."""
        centre = np.array([self._camera.centre.x(), self._camera.centre.y()])
        return (np.asarray(points, dtype=float) - centre) * self._scale() + self._middle()

    def to_document(self, pixels: ArrayLike) -> Array:
        """Map (…, 2) pixels of this view to document points."""
        centre = np.array([self._camera.centre.x(), self._camera.centre.y()])
        return (np.asarray(pixels, dtype=float) - self._middle()) / self._scale() + centre

    def _scale(self) -> Array:
        zoom = self._camera.zoom
        return np.array([-zoom if self._camera.flipped else zoom, zoom])

    def _middle(self) -> Array:
        size = self.viewport().size()
        return np.array([size.width() / 2, size.height() / 2])

    def _aim(self) -> None:
        """Turn the view box to where the camera looks."""
        size = self.viewport().size()
        if size.isEmpty():
            return
        width, height = size.width() * self.pixel, size.height() * self.pixel
        rect = QRectF(0.0, 0.0, width, height)
        rect.moveCenter(self._camera.centre)
        self._box.invertX(self._camera.flipped)
        self._box.setRange(rect, padding=0.0)
        self.viewport().update()

    def update_all(self) -> None:
        """Repaint, in the theme as it is now."""
        self.setBackground(colours().pasteboard)
        self.viewport().update()

    # -- items ---------------------------------------------------------------------------------

    def add_artwork(self, item: QGraphicsItem, z: float) -> None:
        """Add an item that paints in document coordinates; ``update_all`` shows its changes."""
        item.setZValue(z)
        self._box.addItem(item, ignoreBounds=True)

    def add_overlay(self, item: QGraphicsItem, z: float) -> None:
        """Add an item that paints in pixels of this view, above all artwork."""
        item.setZValue(z)
        self.addItem(item)

    # -- events --------------------------------------------------------------------------------

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        """Keep the centre in the middle."""
        super().resizeEvent(event)
        if hasattr(self, "_box"):  # pyqtgraph calls it while constructing
            self._aim()
            self.resized.emit()

    def sizeHint(self) -> QSize:
        """Ask for no more room than any other view."""
        return QSize(*PREFERRED_SIZE)

    def minimumSizeHint(self) -> QSize:
        """Stay large enough to draw in."""
        return QSize(*LEAST_SIZE)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the cursor; sideways, or with Shift, pan."""
        turn, sideways = event.angleDelta().y(), event.angleDelta().x()
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            turn, sideways = 0, sideways or turn
        if sideways:
            self._camera.pan(sideways / 2, 0.0)
        if turn:
            x, y = self.to_document([event.position().x(), event.position().y()])
            self._camera.zoom_at(QPointF(x, y), WHEEL_STEP**turn)
        event.accept()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Start panning, or press the tool."""
        event.accept()
        if not self._take(event):
            return
        if event.button() == Qt.MouseButton.MiddleButton or self._hand:
            self._pan_from = event.position()
            self._show_cursor()
        else:
            self.pressed.emit(self._pointer(event))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Pan, or move the tool."""
        if self._pan_from is None:
            self.moved.emit(self._pointer(event))
            return
        step = event.position() - self._pan_from
        self._pan_from = event.position()
        self._camera.pan(step.x(), step.y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End panning, or release the tool."""
        if event.button() != self._held:
            return
        self._held = None
        if self._pan_from is not None:
            self._pan_from = None
            self._show_cursor()
        else:
            self.released.emit(self._pointer(event))

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Tell the tool; panning sees just another press."""
        if event.button() != Qt.MouseButton.LeftButton or self._hand:
            self.mousePressEvent(event)
        elif self._take(event):
            self.double_clicked.emit(self._pointer(event))

    def _take(self, event: QMouseEvent) -> bool:
        """Return whether a press may begin something, and remember its button if so."""
        button = event.button()
        useful = button in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton)
        if not useful or self._held not in (None, button):
            return False
        self._held = button
        return True

    def leaveEvent(self, event: QEvent) -> None:
        """Tell the tool that the mouse is elsewhere."""
        super().leaveEvent(event)
        self.left.emit()

    def event(self, event: QEvent) -> bool:
        """Let the canvas take keys before the window's shortcuts do, Tab included."""
        if event.type() == QEvent.Type.ShortcutOverride:
            event.ignore()
            self.key_wanted.emit(event)
            return event.isAccepted()
        if event.type() == QEvent.Type.KeyPress and event.key() in (
            Qt.Key.Key_Tab,
            Qt.Key.Key_Backtab,
        ):
            event.ignore()
            self.key_pressed.emit(event)
            return event.isAccepted() or super().event(event)
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Hand the key to the canvas; what it leaves goes to the window."""
        event.ignore()
        self.key_pressed.emit(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Hand the key to the canvas."""
        event.ignore()
        self.key_released.emit(event)

    def focusInEvent(self, event: QEvent) -> None:
        """Tell the canvas which view is worked in."""
        super().focusInEvent(event)
        self.focus_changed.emit()

    def focusOutEvent(self, event: QEvent) -> None:
        """Tell the canvas that none is."""
        super().focusOutEvent(event)
        self.focus_changed.emit()

    def _pointer(self, event: QMouseEvent) -> Pointer:
        at = event.position()
        position = self.to_document([at.x(), at.y()])
        return Pointer(self.pane, position, event.modifiers(), self.pixel)
