"""Select: pick a layer, and move, scale or rotate a whole outline."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, QPointF, Qt
from PySide6.QtGui import QPainter

from app.canvas.ink import draw_line, draw_nodes, pen
from app.canvas.pointer import REACH, Pointer
from app.canvas.tools.tool import Apply, Command, Gesture, Tool, arrow_step
from app.canvas.tools.transform_box import TransformBox
from app.style import colours
from app.workspace import Workspace
from core.model import edits
from core.model.outline import Array

if TYPE_CHECKING:
    from app.canvas.pane import Pane

ROTATE = -1
"""Stands for the rotating handle among the indices of those that scale."""
CURSORS = (
    Qt.CursorShape.SizeFDiagCursor,
    Qt.CursorShape.SizeVerCursor,
    Qt.CursorShape.SizeBDiagCursor,
    Qt.CursorShape.SizeHorCursor,
)
"""Of the handles that scale, in their order, twice around."""


@dataclass
class Transform:
    """A drag of the outline or of one of its handles."""

    drag: Apply
    text: str
    layer_id: int
    key: int
    box: TransformBox
    handle: int | None
    start: Array

    def move(self, pointer: Pointer) -> None:
        """Transform the outline by what the drag means so far."""
        now = pointer.position
        if self.handle is None:
            step = now - self.start
            if pointer.shift:  # along one axis
                step[np.argmin(np.abs(step))] = 0.0
            change = np.eye(2), step
        elif self.handle == ROTATE:
            change = self.box.rotation(self.start, now, steps=pointer.shift)
        else:
            change = self.box.scaling(
                self.handle, self.start, now, even=pointer.shift, centred=pointer.alt
            )
        self.drag(edits.transform_outline, self.layer_id, self.key, *change)

    def end(self, pointer: Pointer) -> None:
        """Nothing is left to do."""


class SelectTool(Tool):
    """Works on whole outlines."""

    name = "select"

    def __init__(self, workspace: Workspace, parent: QObject) -> None:
        super().__init__(workspace, parent)
        self._handle: int | None = None
        self._over: int | None = None
        self._taken: tuple[int, int] | None = None
        """The outline that the arrow keys move, by layer id and key: the one pressed last."""
        workspace.playhead.moved.connect(self._let_go)

    def hover(self, pointer: Pointer) -> None:
        """Find the handle or the layer under the mouse."""
        self._handle = self._handle_at(pointer)
        self._over = None if self._handle is not None else self._layer_at(pointer)
        self.cursor = Qt.CursorShape.ArrowCursor
        if self._handle == ROTATE:
            self.cursor = Qt.CursorShape.CrossCursor
        elif self._handle is not None:
            self.cursor = CURSORS[self._handle % 4]
        elif self._over is not None and pointer.pane.key is not None and not self.refuses:
            self.cursor = Qt.CursorShape.SizeAllCursor

    def leave(self) -> None:
        """Forget the hover."""
        super().leave()
        self._handle = self._over = None
        self.cursor = Qt.CursorShape.ArrowCursor

    def grab(self, pointer: Pointer) -> Gesture | None:
        """Take a handle, or else the shape under the mouse."""
        self._taken = None
        handle = self._handle_at(pointer)
        if handle is None:
            layer_id = self._layer_at(pointer)
            if layer_id is None:
                return None
            self.selection.select_layer(layer_id)
        if pointer.pane.key is None:
            return None
        layer, keyframe = self.editable(pointer.pane), pointer.pane.keyframe
        if layer is None or keyframe is None:
            return None
        text = {None: self.tr("Move outline"), ROTATE: self.tr("Rotate outline")}.get(
            handle, self.tr("Scale outline")
        )
        box = TransformBox.around(keyframe.outline)
        key = pointer.pane.key
        self._taken = layer.id, key
        return Transform(self.drag, text, layer.id, key, box, handle, pointer.position)

    def key(self, key: int, modifiers: Qt.KeyboardModifier) -> Command | None:
        """Nudge the outline that was taken, or let go of it; else arrows step through time."""
        step = arrow_step(key, modifiers)
        layer = self.layer
        if layer is None or self._taken != (layer.id, self.selection.key):
            return None
        if key == Qt.Key.Key_Escape:
            return self._let_go
        if step is None:
            return None
        return lambda: self._nudge(layer.id, self.selection.key, step)

    @property
    def refuses(self) -> bool:
        """Whether the next click changes nothing; another layer can be selected in any case."""
        layer = self.selection.layer
        return super().refuses and layer is not None and self._over in (None, layer.id)

    def advice(self) -> str:
        """Say what a drag does from here."""
        if self.selection.layer is None:
            return self.tr("Press P or B and draw the source outline, or drop an SVG on the window")
        if self._handle == ROTATE:
            return self.tr("Drag to rotate the outline; Shift turns in steps of 15°")
        if self._handle is not None:
            return self.tr("Drag to scale the outline; Shift keeps its proportions, Alt its middle")
        if self._over is not None and self._over != self.selection.layer.id:
            name = self.session.document.layer(self._over).name
            return self.tr("Click to select the layer “{name}”").format(name=name)
        if self._taken is not None:
            return self.tr("Drag or arrow keys move the outline, Shift by 10; Esc lets go of it")
        return self.tr("Drag the outline to move it, or a handle to scale or rotate it")

    def put_away(self) -> None:
        """Let go of the outline."""
        super().put_away()
        self._let_go()

    @property
    def seen(self) -> object:
        """Which outline is taken."""
        return self._taken

    def paint(self, painter: QPainter, pane: Pane) -> None:
        """Paint the box of the key that is edited in the pane."""
        keyframe = pane.keyframe
        if keyframe is None or self.fixed:
            return
        self.paint_key(painter, pane)
        box = TransformBox.around(keyframe.outline)
        accent = colours().selection
        frame = box.frame(pane.view)
        draw_line(painter, frame, accent, closed=True, halo=False, width=1.2)
        top, rotator = (frame[0] + frame[1]) / 2, box.rotator(pane.view)
        painter.setPen(pen(accent, 1.2))
        painter.drawLine(QPointF(*top), QPointF(*rotator))
        taken = self._taken == (self.selection.layer.id, pane.key)
        draw_nodes(painter, box.handles(pane.view), accent, selected=taken)
        draw_nodes(painter, rotator[None], accent, smooth=True, selected=taken, size=5.0)

    def _let_go(self) -> None:
        self._taken = None

    def _nudge(self, layer_id: int, key: int, step: Array) -> None:
        edit = edits.transform_outline
        text = self.tr("Move outline")
        self.session.amend(self.held, text, edit, layer_id, key, np.eye(2), step)

    def _handle_at(self, pointer: Pointer) -> int | None:
        keyframe = pointer.pane.keyframe
        if keyframe is None or self.fixed:
            return None
        view = pointer.pane.view
        box = TransformBox.around(keyframe.outline)
        handles = np.vstack([box.handles(view), box.rotator(view)])
        away = np.hypot(*(handles - view.to_screen(pointer.position)).T)
        nearest = int(np.argmin(away))
        if away[nearest] > REACH:
            return None
        return ROTATE if nearest == len(handles) - 1 else nearest

    def _layer_at(self, pointer: Pointer) -> int | None:
        layer = self.selection.layer
        prefer = layer.id if layer and pointer.pane.key is not None else None
        return pointer.pane.artwork.layer_at(pointer.position, prefer)
