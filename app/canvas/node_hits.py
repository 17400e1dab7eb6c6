"""What of an outline is under the mouse: a handle, a node, the edge; and how nodes look."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from PySide6.QtCore import QPointF
from PySide6.QtGui import QPainter

from app.canvas.ink import draw_nodes, draw_outline, pen
from app.canvas.view import View
from core.geometry.places import nearest_place
from core.model import Outline, Ring, RingPoint
from core.model.outline import Array

Node = tuple[int, int]
"""(ring, node)."""
Side = Literal["in", "out"]


@dataclass(frozen=True)
class HandleHit:
    """A Bézier handle."""

    node: Node
    side: Side


@dataclass(frozen=True)
class NodeHit:
    """A node."""

    node: Node


@dataclass(frozen=True)
class EdgeHit:
    """A place between nodes."""

    place: RingPoint


Hit = HandleHit | NodeHit | EdgeHit


def hit_outline(
    outline: Outline, selected: frozenset[Node], point: Array, reach: float
) -> Hit | None:
    """Return what of an outline lies within ``reach`` of a point (2,), both in the document.

    Handles count before nodes, as they lie on top, and nodes before the edge.
    """
    handles = list(shown_handles(outline, selected))
    if handles:
        away = np.hypot(*(np.array([tip for _, _, tip in handles]) - point).T)
        nearest = int(np.argmin(away))
        if away[nearest] <= reach:
            node, side, _ = handles[nearest]
            return HandleHit(node, side)
    nodes = [(r, i) for r, ring in enumerate(outline.rings) for i in range(len(ring))]
    positions = np.concatenate([ring.points for ring in outline.rings])
    away = np.hypot(*(positions - point).T)
    nearest = int(np.argmin(away))
    if away[nearest] <= reach:
        return NodeHit(nodes[nearest])
    place, distance = nearest_place(outline, point)
    return EdgeHit(place) if distance <= reach else None


def shown_handles(
    outline: Outline, selected: frozenset[Node]
) -> Iterator[tuple[Node, Side, Array]]:
    """Yield the handles of the selected nodes, each with its tip (2,) in the document."""
    for r, i in sorted(selected):
        ring = outline.rings[r]
        sides: tuple[tuple[Side, Array], ...] = (("in", ring.handles_in), ("out", ring.handles_out))
        for side, handles in sides:
            if handles[i].any():
                yield (r, i), side, ring.points[i] + handles[i]


def smooth_nodes(ring: Ring) -> np.ndarray:
    """Return (n,) whether the curve passes each node without a kink."""
    a, b = -ring.handles_in, ring.handles_out
    lengths = np.hypot(*a.T) * np.hypot(*b.T)
    cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    along = np.einsum("ij,ij->i", a, b)
    return (lengths > 0) & (np.abs(cross) < 1e-3 * lengths) & (along > 0)


def paint_nodes(
    painter: QPainter, view: View, outline: Outline, tint: str, selected: frozenset[Node]
) -> None:
    """Paint an outline with its nodes, and the handles of those that are selected."""
    draw_outline(painter, view, outline, tint)
    for r, ring in enumerate(outline.rings):
        chosen = np.isin(np.arange(len(ring)), [i for s, i in selected if s == r])
        smooth, at = smooth_nodes(ring), view.to_screen(ring.points)
        for is_chosen, is_smooth in ((False, False), (False, True), (True, False), (True, True)):
            group = at[(chosen == is_chosen) & (smooth == is_smooth)]
            if len(group):
                draw_nodes(painter, group, tint, smooth=is_smooth, selected=is_chosen)
    for (r, i), _, tip in shown_handles(outline, selected):
        node, end = view.to_screen([outline.rings[r].points[i], tip])
        painter.setPen(pen(tint, 1.2))
        painter.drawLine(QPointF(*node), QPointF(*end))
        draw_nodes(painter, end[None], tint, smooth=True, size=3.2)
