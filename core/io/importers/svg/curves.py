"""SVG path segments to rings of nodes with handles."""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil, pi, tan
from typing import TYPE_CHECKING, Any

import numpy as np

from core.model import Ring
from core.model.outline import MIN_NODES, Array
from core.model.structure import FARTHEST

if TYPE_CHECKING:
    from svgelements import Arc, CubicBezier, Path

SAME = 1e-6
"""Nodes closer than this fraction of the path's size, with no curve between them, are one."""
QUARTER = 1.001 * pi / 2
"""Largest piece of an arc that becomes one cubic, in radians: a circle gets four nodes."""


def rings_of(path: Path) -> tuple[list[Ring], bool]:
    """Return the closed curves of a path, and whether it had to close one that was open.

    The path is brought to its place in the drawing. Curves without area are left out. ValueError
    for numbers that cannot be drawn.
    """
    _replace_arcs(path)
    path.reify()
    with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is refused
        drawn = [list(curve) for curve in _curves(path)]
    corners = [p for curve in drawn for p, *_ in curve]
    if not all((np.abs(node[:3]) <= FARTHEST).all() for curve in drawn for node in curve):
        raise ValueError("a number is too large")
    size = float(np.ptp(np.array(corners), axis=0).max()) if corners else 0.0
    rings, opened = [], False
    for curve in drawn:
        ring, closed = _ring(curve, SAME * size)
        if ring is not None:
            rings.append(ring)
            opened |= not closed
    return rings, opened


def _replace_arcs(path: Path) -> None:
    """Replace arcs by cubics while they still are arcs: a transform may skew them.

    The cubics are tangent at both ends and touch the arc in the middle: off by less than 3e-4 of
    the radius. (The library's own cut a full circle short by 2e-3 of its area.)
    """
    from svgelements import Arc

    for i in range(len(path) - 1, -1, -1):
        if isinstance(path[i], Arc):
            path[i : i + 1] = _cubics(path[i])


def _cubics(arc: Arc) -> list[CubicBezier]:
    from svgelements import CubicBezier

    pieces = max(ceil(abs(arc.sweep) / QUARTER), 1)
    step = arc.sweep / pieces
    angles = [arc.get_start_t() + step * i for i in range(pieces + 1)]
    ends = [arc.start, *map(arc.point_at_t, angles[1:-1]), arc.end]
    reach = 4 / 3 * tan(step / 4)
    handles = [(arc.point_at_t(angle + pi / 2) - arc.center) * reach for angle in angles]
    return [
        CubicBezier(ends[i], ends[i] + handles[i], ends[i + 1] - handles[i + 1], ends[i + 1])
        for i in range(pieces)
    ]


Node = tuple[Array, Array, Array, bool]
"""A point with its handles (offsets) before and after, and whether it closes the curve."""


def _curves(path: Path) -> Iterable[list[Node]]:
    """Yield the nodes of every subpath; a closing segment repeats the first node."""
    from svgelements import Close, CubicBezier, Line, Move, QuadraticBezier

    nodes: list[Node] = []
    for segment in path:
        if segment.end is None:
            continue
        end = _point(segment.end)
        before, after, closes = np.zeros(2), np.zeros(2), False
        match segment:
            case Move():
                yield nodes
                nodes = [(end, before, before, False)]
                continue
            case CubicBezier():
                after = _point(segment.control1) - _point(segment.start)
                before = _point(segment.control2) - end
            case QuadraticBezier():
                control = _point(segment.control)
                after = (control - _point(segment.start)) * (2 / 3)
                before = (control - end) * (2 / 3)
            case Close():
                closes = True
            case Line():
                pass
        if not nodes:  # a path goes on from where the last one closed
            nodes = [(_point(segment.start), np.zeros(2), np.zeros(2), False)]
        start, arriving, _, _ = nodes[-1]
        nodes[-1] = (start, arriving, after, False)
        nodes.append((end, before, np.zeros(2), closes))
        if closes:
            yield nodes
            nodes = []
    yield nodes


def _ring(nodes: list[Node], same: float) -> tuple[Ring | None, bool]:
    """Close a curve, joining nodes that coincide; also return whether it was closed already."""
    merged: list[Node] = []
    for node in nodes:
        if merged and _coincide(merged[-1], node, same):
            merged[-1] = (merged[-1][0], merged[-1][1], node[2], node[3])
        else:
            merged.append(node)
    if not merged:
        return None, True
    first, last = merged[0], merged[-1]
    closed = last[3] or bool(np.hypot(*(last[0] - first[0])) <= same)
    if len(merged) > 1 and np.hypot(*(last[0] - first[0])) <= same:
        merged.pop()
        merged[0] = (first[0], last[1], first[2], False)
    points, before, after, _ = zip(*merged, strict=True)
    ring = Ring(np.array(points), np.array(before), np.array(after))
    if len(ring) < MIN_NODES and not ring.curved.any():
        return None, closed
    while len(ring) < MIN_NODES:  # a lens or a loop has fewer corners than a ring needs nodes
        ring = ring.with_node(int(np.flatnonzero(ring.curved)[-1]) + 0.5)
    return (ring if np.ptp(ring.points, axis=0).min() > 0 or ring.curved.any() else None), closed


def _coincide(a: Node, b: Node, same: float) -> bool:
    straight = not (a[2].any() or b[1].any())
    return straight and bool(np.hypot(*(b[0] - a[0])) <= same)


def _point(point: Any) -> Array:
    return np.array((point.x, point.y), dtype=float)
