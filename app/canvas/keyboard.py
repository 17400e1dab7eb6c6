"""What keys do on the canvas, before any shortcut of the window."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent

from app.canvas.hand import HAND_KEYS, Hand
from app.canvas.tools.tool import ARROWS, Command

if TYPE_CHECKING:
    from app.canvas.canvas import Canvas
    from app.document.playhead import Playhead

ZOOM_KEYS = {Qt.Key.Key_Plus: 1.25, Qt.Key.Key_Equal: 1.25, Qt.Key.Key_Minus: 0.8}
SIGN_KEYS = (
    Qt.KeyboardModifier.ControlModifier
    | Qt.KeyboardModifier.ShiftModifier
    | Qt.KeyboardModifier.KeypadModifier
)
"""What may be held to type a plus on some keyboard."""


class Keyboard(QObject):
    """Takes keys for the hand, for zooming, for Esc, and for the tool in hand."""

    used = Signal()
    """A key did something."""

    def __init__(self, canvas: Canvas, playhead: Playhead) -> None:
        super().__init__(canvas)
        self._playhead = playhead
        views = [pane.view for pane in canvas.panes.values()]
        self._hand = Hand(canvas.camera, views)
        for view in views:
            view.key_wanted.connect(self._on_wanted)
            view.key_pressed.connect(self._on_pressed)
            view.key_released.connect(self._on_released)

    @property
    def _canvas(self) -> Canvas:
        """The parent; to keep it would be a cycle, in which views die before their splitters."""
        return cast("Canvas", self.parent())

    def drop_hand(self) -> None:
        """Forget that a key is held: its release will be told to another window."""
        self._hand.let_go()

    def _on_wanted(self, event: QKeyEvent) -> None:
        if self._command(event) is not None:
            event.accept()

    def _on_pressed(self, event: QKeyEvent) -> None:
        command = self._command(event)
        if command is not None:
            event.accept()
            command()
            self.used.emit()

    def _on_released(self, event: QKeyEvent) -> None:
        if event.isAutoRepeat():
            return
        if self._hand.held and event.key() in HAND_KEYS:
            event.accept()
            if self._hand.let_go() and event.key() == Qt.Key.Key_Space:
                self._playhead.toggle()
        self._canvas.in_hand.key_released()

    def _command(self, event: QKeyEvent) -> Command | None:
        """Return what a key does now."""
        key, modifiers, tool = event.key(), event.modifiers(), self._canvas.in_hand
        plain = not modifiers
        if plain and key in HAND_KEYS:
            return self._hand.take
        if key in ZOOM_KEYS and not modifiers & ~SIGN_KEYS:
            camera = self._canvas.camera
            return partial(camera.zoom_at, camera.centre, ZOOM_KEYS[key])
        if plain and key == Qt.Key.Key_Escape:
            if tool.busy:
                return tool.abandon
            if not (self._canvas.at_rest or self._playhead.playing):
                return self._canvas.put_tool_away
        if key in ARROWS and self._canvas.chosen.focused is None:
            return None  # in the in-between there is nothing to nudge, and time to step through
        return tool.key(key, modifiers)
