"""What every tool is: how clicks, drags and keys reach it, and what it may ask."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QPainter

from app.canvas.ink import draw_outline
from app.canvas.pointer import DRAG_DISTANCE, Pointer
from app.document.session import Drag
from app.workspace import Workspace
from core.model import Document, Layer
from core.model.outline import Array

if TYPE_CHECKING:
    from app.canvas.pane import Pane

Command = Callable[[], None]
Apply = Callable[..., None]
"""Takes an edit of a document, and what to call it with."""

STEP, LARGE_STEP = 1.0, 10.0
"""Document units that an arrow key moves, without and with Shift."""
ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0),
    Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, -1.0),
    Qt.Key.Key_Down: (0.0, 1.0),
}


class Gesture(Protocol):
    """What goes on between press and release; it begins once the mouse has really moved."""

    text: str
    """Names the undo step; empty when the gesture itself changes nothing."""

    def move(self, pointer: Pointer) -> None:
        """Follow the mouse."""

    def end(self, pointer: Pointer) -> None:
        """Finish at the release."""


class Tool(QObject):
    """A tool overrides what it needs of ``hover`` to ``leave``.

    A gesture with a text runs inside one session drag: every edit it hands to ``drag`` starts from
    the document at the press, all of it is one undo step, and Esc takes it back.
    """

    name = ""
    cursor = Qt.CursorShape.ArrowCursor
    aims = False
    """Whether it works on what keys show in so many places that playing must not hide them."""

    places_marks = False
    """Whether it works on marks; for other tools they stand back."""

    def __init__(self, workspace: Workspace, parent: QObject) -> None:
        super().__init__(parent)
        self.workspace = workspace
        self.session, self.selection = workspace.session, workspace.selection
        self.notice = ""
        """Said instead of the advice until the next press: why something was refused."""
        self._gesture: Gesture | None = None
        self._drag: Drag | None = None
        self._pressed: Pointer | None = None
        self._last: Pointer | None = None
        self._moving = False
        self.held = object()
        """Stands for the key that is held down: all that it repeats is one undo step."""

    # -- for subclasses ------------------------------------------------------------------------

    def hover(self, pointer: Pointer) -> None:
        """Follow the mouse while no button is down."""

    def grab(self, pointer: Pointer) -> Gesture | None:
        """Return what a drag from here does; selecting what is pressed belongs here, too."""

    def click(self, pointer: Pointer) -> None:
        """Do what a click does, at the release of a press that no gesture followed."""

    def double_click(self, pointer: Pointer) -> None:
        """Do what the second press of a double click does."""

    def key(self, key: int, modifiers: Qt.KeyboardModifier) -> Command | None:
        """Return what a key does now; None leaves it to the window's shortcuts."""

    def advice(self) -> str:
        """Say what the next click does."""
        return ""

    def paint(self, painter: QPainter, pane: Pane) -> None:
        """Paint handles and the like, in pixels of the pane's view."""

    @property
    def seen(self) -> object:
        """What ``paint`` shows besides document and selection; while it is equal, none is due."""
        return None

    def paint_key(self, painter: QPainter, pane: Pane) -> None:
        """Trace the outline of the key that is edited where something else is seen."""
        if pane.live and pane.keyframe is not None:
            draw_outline(painter, pane.view, pane.keyframe.outline, pane.tint)

    def leave(self) -> None:
        """Forget what was under the mouse."""
        self._last = None

    # -- for the canvas ------------------------------------------------------------------------

    @property
    def busy(self) -> bool:
        """Whether Esc has something to abandon."""
        return self._gesture is not None

    @property
    def hint(self) -> str:
        """What the status bar says."""
        return self.notice or (self.refusal() if self.refuses else self.advice())

    def press(self, pointer: Pointer) -> None:
        """Take a press of the left button."""
        self.notice = ""
        self._pressed, self._moving = pointer, False
        self._gesture = self.grab(pointer)

    def move(self, pointer: Pointer) -> None:
        """Take a move, with or without the button down."""
        self._last = pointer
        if self._pressed is None:
            self.hover(pointer)
        elif self._gesture is not None and (self._moving or self._far(pointer)):
            if self._gesture.text and not self._moving:
                self._drag = self.session.begin(self._gesture.text)
            elif self._drag is not None and not self._drag.open:  # undo or another edit ended it
                self._gesture = self._drag = None
                return
            self._moving = True
            self._gesture.move(pointer)

    def release(self, pointer: Pointer) -> None:
        """Take a release of the left button."""
        if self._pressed is None:
            return
        pressed, gesture = self._pressed, self._gesture
        self._pressed = self._gesture = None
        if not self._moving:
            self.click(pressed)
        elif gesture is not None:
            gesture.end(pointer)
            if self._drag is not None:
                self._drag.commit()
        self._drag = None
        self.hover(pointer)

    def abandon(self) -> None:
        """Take back the gesture under way."""
        if self._drag is not None:
            self._drag.abandon()
        self._gesture = self._pressed = self._drag = None

    def put_away(self) -> None:
        """Stop, because another tool is taken; nothing that was drawn may be lost."""
        self.abandon()
        self.leave()
        self.notice = ""

    def look_again(self) -> None:
        """Find out what is under the resting mouse, after the document changed beneath it."""
        if self._last is not None and self._pressed is None:
            self.hover(self._last)

    def key_released(self) -> None:
        """Let the next key begin another undo step."""
        self.held = object()

    # -- shared --------------------------------------------------------------------------------

    def drag(self, edit: Callable[..., Document], *args: Any) -> None:
        """Show what the gesture under way makes of the document at its beginning."""
        if self._drag is not None:
            self._drag.apply(edit, *args)

    @property
    def layer(self) -> Layer | None:
        """The current layer, if it may be edited and no gesture is at it."""
        return None if self.fixed or self._gesture is not None else self.selection.layer

    def editable(self, pane: Pane) -> Layer | None:
        """Return the current layer, with the key of this pane selected, if it may be edited."""
        layer = self.selection.layer
        if layer is None or pane.key is None or not self.unlocked():
            return None
        self.selection.select_key(layer.id, pane.key)
        return layer

    @property
    def fixed(self) -> bool:
        """Whether the current layer is locked or hidden."""
        layer = self.selection.layer
        return layer is not None and (layer.locked or not layer.visible)

    def unlocked(self) -> bool:
        """Return whether the current layer may be edited, or say why not."""
        if not self.fixed:
            return True
        self.notice = self.refusal()
        return False

    @property
    def refuses(self) -> bool:
        """Whether the next click changes nothing, because the current layer may not be edited."""
        return self.fixed

    def refusal(self) -> str:
        """Say why the current layer may not be edited."""
        layer = self.selection.layer
        assert layer is not None
        state = self.tr("locked") if layer.locked else self.tr("hidden")
        text = self.tr("The layer “{name}” is {state}: change that in the layers panel first")
        return text.format(name=layer.name, state=state)

    def _far(self, pointer: Pointer) -> bool:
        assert self._pressed is not None
        distance = np.hypot(*(pointer.position - self._pressed.position))
        return bool(distance >= DRAG_DISTANCE * pointer.pixel)


def arrow_step(key: int, modifiers: Qt.KeyboardModifier) -> Array | None:
    """Return the offset (2,) that an arrow key asks for; None for other keys."""
    if key not in ARROWS or modifiers & ~(
        Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier
    ):
        return None
    size = LARGE_STEP if modifiers & Qt.KeyboardModifier.ShiftModifier else STEP
    return size * np.array(ARROWS[key])
