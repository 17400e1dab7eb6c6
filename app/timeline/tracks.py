"""The tracks: a row a layer, with its keys, its spans and how they stand."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QEvent, QPointF, QSize, Qt
from PySide6.QtGui import (
    QContextMenuEvent,
    QHelpEvent,
    QKeyEvent,
    QKeySequence,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from app.document.keyframes import delete_key, step_key
from app.timeline import keys
from app.timeline.gestures import Gesture, KeyCopy, KeyDrag, Scrub
from app.timeline.menu import TrackMenu
from app.timeline.rows import Place, Rows
from app.timeline.time_view import TimeView
from app.timeline.time_widget import TimeWidget
from app.timeline.track_painter import paint_tracks
from app.timeline.words import describe_place, describe_selection
from app.workspace import Workspace


class Tracks(TimeWidget):
    """Keys are clicked, dragged in time and deleted; spans are chosen and played alone."""

    def __init__(self, workspace: Workspace, view: TimeView, parent: QWidget | None = None) -> None:
        super().__init__(workspace, view, parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.MinimumExpanding)
        self.setAccessibleName(self.tr("Tracks"))
        self._hovered: Place | None = None
        self._keyboard: dict[str, Callable[[], object]] = {
            "Left": partial(workspace.playhead.step, -1),
            "Right": partial(workspace.playhead.step, 1),
            "Ctrl+Left": partial(step_key, workspace.playhead, workspace.selection, -1),
            "Ctrl+Right": partial(step_key, workspace.playhead, workspace.selection, 1),
            "Home": workspace.playhead.to_start,
            "End": workspace.playhead.to_end,
            "Space": workspace.playhead.toggle,
            "Del": partial(delete_key, workspace.session, workspace.selection),
            "Backspace": partial(delete_key, workspace.session, workspace.selection),
            "Alt+Left": partial(keys.nudge_key, workspace, -1),
            "Alt+Right": partial(keys.nudge_key, workspace, 1),
            "Up": partial(keys.choose_layer, workspace, 1),
            "Down": partial(keys.choose_layer, workspace, -1),
        }
        workspace.selection.changed.connect(self._on_selection_changed)
        workspace.inspector.changed.connect(self.update)
        self.on_document_changed()

    @property
    def rows(self) -> Rows:
        """Where everything lies now."""
        return Rows(self.workspace.session.document, self.view.scale)

    def sizeHint(self) -> QSize:
        """Return the height of all rows."""
        return QSize(400, self.rows.height)

    def on_document_changed(self) -> None:
        """Show the new document."""
        self.setMinimumHeight(self.rows.height)  # rows are scrolled, never squeezed
        self._on_selection_changed()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the rows, and the playhead over them."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            paint_tracks(painter, self.workspace, self.rows, self._hovered, event.rect())
            self.paint_playhead(painter)

    # -- what the mouse does -------------------------------------------------------------------

    def begin(self, event: QMouseEvent) -> Gesture | None:
        """Grab a key; else choose the layer and its span there, and scrub."""
        position = event.position()
        place = self.rows.key_at(position)
        if place is not None:
            return self._grab(place, event)
        self._choose(position)
        scrub = Scrub(self.workspace, self.view)
        scrub.move(position.x(), event.modifiers())
        return scrub

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Show what a press would grab."""
        super().mouseMoveEvent(event)
        if not self.dragging:
            self._hover(self.rows.key_at(event.position()))

    def leaveEvent(self, event: QEvent) -> None:
        """Forget what the mouse was over."""
        self._hover(None)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Scroll through layers where more are there than fit; with Ctrl, or else, zoom."""
        hidden = self.visibleRegion().boundingRect().height() < self.height()
        if hidden and event.angleDelta().y() and not event.modifiers():
            event.ignore()  # the scroll area around takes it
        else:
            super().wheelEvent(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Play the span alone, or everything again if it is already."""
        place = self.rows.span_at(event.position())
        if event.button() == Qt.MouseButton.LeftButton and place is not None:
            keys.play_only(self.workspace, place)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Offer what can be done with what is under the mouse, or else with the chosen key."""
        selection = self.workspace.selection
        if event.reason() == QContextMenuEvent.Reason.Mouse:
            position = QPointF(event.pos())
            place = self.rows.key_at(position) or self.rows.span_at(position)
        else:
            place = (selection.layer.id, selection.key) if selection.layer else None
        if place is not None:
            selection.select_key(*place)
            TrackMenu(self.workspace, place, self).popup(event.globalPos())

    def _grab(self, place: Place, event: QMouseEvent) -> Gesture | None:
        layer = self.workspace.session.document.layer(place[0])
        self.workspace.playhead.stop()
        self.workspace.selection.select_key(*place)
        self.workspace.playhead.move_to(layer.keyframes[place[1]].frame)
        if layer.locked:
            return None
        gesture = KeyCopy if event.modifiers() & Qt.KeyboardModifier.AltModifier else KeyDrag
        return gesture(self.workspace, self.view, place, event.position().x())

    def _choose(self, position: QPointF) -> None:
        place, layer = self.rows.span_at(position), self.rows.layer_at(position.y())
        if place is not None:
            self.workspace.selection.select_key(*place)
        elif layer is not None:
            self.workspace.selection.select_layer(layer.id)

    def _hover(self, place: Place | None) -> None:
        if place != self._hovered:
            self._hovered = place
            self.update()
        locked = place and self.workspace.session.document.layer(place[0]).locked
        shape = Qt.CursorShape.ForbiddenCursor if locked else Qt.CursorShape.SizeHorCursor
        self.setCursor(shape if place else Qt.CursorShape.ArrowCursor)

    # -- what the keyboard does, and what is said ----------------------------------------------

    def event(self, event: QEvent) -> bool:
        """Keep the keys that mean the timeline from the window's shortcuts; answer tooltips."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            if _name(event) in self._keyboard:
                event.accept()
                return True
        elif isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            position = QPointF(event.pos())
            place = self.rows.key_at(position)
            span = None if place else self.rows.span_at(position)
            QToolTip.showText(event.globalPos(), describe_place(self.workspace, place, span), self)
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Step, jump, play, choose, nudge or delete."""
        action = self._keyboard.get(_name(event))
        if action is None or self.dragging:
            super().keyPressEvent(event)
        else:
            action()

    def _on_selection_changed(self) -> None:
        self.setAccessibleDescription(describe_selection(self.workspace))
        self.update()


def _name(event: QKeyEvent) -> str:
    """Return the key as it is written in menus, without what the keypad adds."""
    modifiers = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
    return QKeySequence(event.key() | modifiers.value).toString(
        QKeySequence.SequenceFormat.PortableText
    )
