"""Freehand: a whole outline in one stroke, fitted with few smooth nodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter

from app.canvas.ink import draw_line
from app.canvas.pointer import Pointer
from app.canvas.tools.drawing import DrawingTool
from app.canvas.tools.tool import Gesture
from app.style import colours
from core.errors import OutlineError
from core.geometry.freehand import fit_stroke
from core.model.outline import Array

if TYPE_CHECKING:
    from app.canvas.pane import Pane

TOLERANCE = 2.0
"""Screen pixels that the fitted outline may stray from the stroke."""


@dataclass
class Stroke:
    """The points of the mouse."""

    tool: FreehandTool
    points: list[Array]
    text: str = ""

    def move(self, pointer: Pointer) -> None:
        """Add a point."""
        self.points.append(pointer.position)

    def end(self, pointer: Pointer) -> None:
        """Make an outline of it."""
        self.tool.fit(self.points, pointer)


class FreehandTool(DrawingTool):
    """Draws a closed outline in one stroke."""

    name = "freehand"
    cursor = Qt.CursorShape.CrossCursor

    def hover(self, pointer: Pointer) -> None:
        """Note where a stroke would go."""
        self._pane = pointer.pane

    def leave(self) -> None:
        """Forget where."""
        super().leave()
        if self._gesture is None:
            self._pane = None

    def grab(self, pointer: Pointer) -> Gesture | None:
        """Begin a stroke."""
        if not self.begin(pointer):
            return None
        return Stroke(self, [pointer.position])

    def fit(self, points: list[Array], pointer: Pointer) -> None:
        """Turn a stroke into an outline, or say why it cannot be one."""
        try:
            ring = fit_stroke(points, TOLERANCE * pointer.pixel)
        except OutlineError as error:
            self.notice = str(error)
            return
        self.finish(ring, pointer.pane)

    def advice(self) -> str:
        """Say what a stroke does."""
        if self._gesture is not None:
            return self.tr("Go around the whole shape, then let go; Esc abandons")
        if self._pane is None:
            return self.tr("Press and draw around the whole shape in one stroke")
        text = self.tr("Press and draw around the whole shape: it becomes {outcome}")
        return text.format(outcome=self.outcome(self._pane))

    @property
    def seen(self) -> object:
        """Something new with every event, while there is something to see."""
        return object() if self._gesture else None

    def paint(self, painter: QPainter, pane: Pane) -> None:
        """Paint the stroke so far, and how it would close."""
        if isinstance(self._gesture, Stroke) and pane is self._pane:
            line = pane.view.to_screen(np.array(self._gesture.points))
            tint = colours().selection
            draw_line(painter, line[[-1, 0]], tint, style=Qt.PenStyle.DotLine, width=1.0)
            draw_line(painter, line, tint, width=2.0)
