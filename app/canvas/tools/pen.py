"""Pen: an outline node by node; a click makes a corner, a drag a smooth node."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, QPointF, Qt
from PySide6.QtGui import QPainter

from app.canvas.ink import draw_line, draw_nodes, draw_ring, pen
from app.canvas.pointer import REACH, Pointer
from app.canvas.tools.drawing import DrawingTool
from app.canvas.tools.tool import Command, Gesture
from app.style import colours
from app.workspace import Workspace
from core.geometry.flatten import flatten_ring
from core.model import Ring
from core.model.outline import MIN_NODES, Array

if TYPE_CHECKING:
    from app.canvas.pane import Pane

SAME_PLACE = 1.0
"""Screen pixels: a click this close to the last node is not meant as another."""
CURVE_TOLERANCE = 0.25
"""Screen pixels."""


@dataclass
class PullHandles:
    """A drag right after a node was set: its handles, symmetric."""

    handles: list[Array]
    node: int
    at: Array
    text: str = ""

    def move(self, pointer: Pointer) -> None:
        """Pull the leaving handle to the mouse."""
        self.handles[self.node] = pointer.position - self.at

    def end(self, pointer: Pointer) -> None:
        """Nothing is left to do."""


class PenTool(DrawingTool):
    """Draws a closed Bézier outline."""

    name = "pen"
    cursor = Qt.CursorShape.CrossCursor

    def __init__(self, workspace: Workspace, parent: QObject) -> None:
        super().__init__(workspace, parent)
        self._points: list[Array] = []
        self._handles: list[Array] = []
        """The leaving handle of each node; the arriving one is opposite."""
        self._mouse: Array | None = None
        self._closing = False

    @property
    def busy(self) -> bool:
        """Whether an outline is begun."""
        return bool(self._points)

    def hover(self, pointer: Pointer) -> None:
        """Follow with the rubber line."""
        if not self._points:
            self._pane = pointer.pane
        self._mouse = self._aimed(pointer) if pointer.pane is self._pane else None

    def leave(self) -> None:
        """Take the rubber line away."""
        super().leave()
        self._mouse = None
        if not self._points:
            self._pane = None

    def grab(self, pointer: Pointer) -> Gesture | None:
        """Set a node, or take the first one again to close."""
        if not self._points:
            if not self.begin(pointer):
                return None
        elif pointer.pane is not self._pane:
            self.notice = self.tr("Close the outline first (Enter), or abandon it (Esc)")
            return None
        self._mouse = at = self._aimed(pointer)
        self._closing = self._closes(pointer)
        if self._closing:
            return PullHandles(self._handles, 0, self._points[0])
        last = self._points[-1] if self._points else None
        if last is None or np.hypot(*(at - last)) > SAME_PLACE * pointer.pixel:
            self._points.append(at)
            self._handles.append(np.zeros(2))
        node = len(self._points) - 1
        return PullHandles(self._handles, node, self._points[node])

    def release(self, pointer: Pointer) -> None:
        """Close, if that is what the press was for."""
        super().release(pointer)
        if self._closing:
            self._close()

    def double_click(self, pointer: Pointer) -> None:
        """Close; the first press of the double click has set the last node."""
        if len(self._points) >= MIN_NODES and pointer.pane is self._pane:
            self._close()

    def key(self, key: int, modifiers: Qt.KeyboardModifier) -> Command | None:
        """Close with Enter, take the last node back with Backspace or Ctrl+Z."""
        if not self._points:
            return None
        if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            return self._close_if_possible
        undo = key == Qt.Key.Key_Z and modifiers == Qt.KeyboardModifier.ControlModifier
        if undo or key in (Qt.Key.Key_Backspace, Qt.Key.Key_Delete):
            return self._take_back
        return None

    def abandon(self) -> None:
        """Forget the outline."""
        super().abandon()
        self._points, self._handles, self._closing = [], [], False

    def put_away(self) -> None:
        """Close what can be closed, so that nothing drawn is lost."""
        if len(self._points) >= MIN_NODES:
            self._close()
        super().put_away()

    def advice(self) -> str:
        """Say what the next click does."""
        if not self._points:
            if self._pane is None:
                return self.tr("Click to set corners, or press and drag for smooth nodes")
            text = self.tr("Click to begin {outcome}; press and drag for a smooth node")
            return text.format(outcome=self.outcome(self._pane))
        if len(self._points) < MIN_NODES:
            return self.tr("Click to set the next node; Backspace takes one back, Esc abandons")
        if self._over_first():
            return self.tr("Click to close the outline")
        return self.tr("Click to set the next node; click the first one or press Enter to close")

    @property
    def seen(self) -> object:
        """Something new with every event, while there is something to see."""
        return object() if self._points else None

    def paint(self, painter: QPainter, pane: Pane) -> None:
        """Paint the outline so far, and where it goes next."""
        if pane is not self._pane or not self._points:
            return
        view, tint = pane.view, colours().selection
        points, handles = np.array(self._points), np.array(self._handles)
        if self._mouse is not None and self._gesture is None:
            leap = Ring([points[-1], self._mouse], np.zeros((2, 2)), [handles[-1], [0, 0]])
            line = _open_line(leap, view.pixel)
            draw_line(painter, view.to_screen(line), tint, style=Qt.PenStyle.DashLine, width=1.2)
        if len(points) > 1:
            line = _open_line(Ring(points, -handles, handles), view.pixel)
            draw_line(painter, view.to_screen(line), tint)
        at = view.to_screen(points)
        if handles[-1].any():
            ends = view.to_screen([points[-1] - handles[-1], points[-1] + handles[-1]])
            painter.setPen(pen(tint, 1.2))
            painter.drawLine(QPointF(*ends[0]), QPointF(*ends[1]))
            draw_nodes(painter, ends, tint, smooth=True, size=3.2)
        smooth = handles.any(axis=1)
        for kind in (False, True):
            if (smooth == kind).any():
                draw_nodes(painter, at[smooth == kind], tint, smooth=kind)
        if self._over_first():
            draw_ring(painter, at[0], REACH, tint)

    # -- the outline ---------------------------------------------------------------------------

    def _close(self) -> None:
        points, handles, pane = np.array(self._points), np.array(self._handles), self._pane
        self.abandon()
        assert pane is not None
        self.finish(Ring(points, -handles, handles), pane)

    def _close_if_possible(self) -> None:
        if len(self._points) >= MIN_NODES:
            self._close()
        else:
            text = self.tr("An outline needs at least {count} nodes; click to set the next one")
            self.notice = text.format(count=MIN_NODES)

    def _take_back(self) -> None:
        self._points.pop()
        self._handles.pop()
        self._gesture = None

    def _aimed(self, pointer: Pointer) -> Array:
        """Return where the next node goes: with Shift, at a multiple of 45° from the last."""
        if not pointer.shift or not self._points:
            return pointer.position
        away = pointer.position - self._points[-1]
        angle = np.round(np.arctan2(away[1], away[0]) / (np.pi / 4)) * (np.pi / 4)
        along = np.array([np.cos(angle), np.sin(angle)])
        return self._points[-1] + along * max(float(away @ along), 0.0)

    def _closes(self, pointer: Pointer) -> bool:
        if len(self._points) < MIN_NODES:
            return False
        return bool(np.hypot(*(pointer.position - self._points[0])) <= pointer.reach)

    def _over_first(self) -> bool:
        """Whether the mouse rests on the first node, so that a click closes."""
        if self._mouse is None or self._pane is None or len(self._points) < MIN_NODES:
            return False
        away = np.hypot(*(self._mouse - self._points[0]))
        return bool(away <= REACH * self._pane.view.pixel)


def _open_line(ring: Ring, pixel: float) -> Array:
    """Return the polyline (n, 2) of a ring without the segment that would close it."""
    line = flatten_ring(ring, CURVE_TOLERANCE * pixel)
    return line.points[line.at <= len(ring) - 1]
