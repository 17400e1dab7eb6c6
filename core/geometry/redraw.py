"""A polygon drawn again with few nodes: those that mean something, and curves in between."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from core.geometry.fitting import direction, fit_run, joined
from core.geometry.polyline import cross
from core.model.outline import Array, Ring

CORNER = np.radians(12)
"""A node with a sharper turn stays a corner; through others the curve passes smoothly."""
LEAST_POINTS = 9
"""Points that a run between two nodes is fitted to at least."""


def corners(points: Array) -> NDArray[np.bool_]:
    """Return (n,) whether a closed polygon (n, 2) turns sharply at each vertex."""
    before, after = points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points
    turns = np.arctan2(cross(before, after), np.einsum("ij,ij->i", before, after))
    return np.abs(turns) > CORNER


def redraw(points: Array, nodes: Sequence[int], tolerance: float) -> Ring:
    """Return a ring through these vertices of a closed polygon (n, 2), in ascending order.

    It stays within about ``tolerance`` of the polygon; nodes are added where that takes more.
    """
    sharp = corners(points)
    curves: list[Array] = []
    for start, end in zip(nodes, [*nodes[1:], nodes[0] + len(points)], strict=True):
        run, last = points[np.arange(start, end + 1) % len(points)], end % len(points)
        leaving = direction(run[1] - run[0]) if sharp[start] else _passing(points, start)
        arriving = direction(run[-2] - run[-1]) if sharp[last] else -_passing(points, last)
        curves += fit_run(_refined(run), leaving, arriving, tolerance)
    return joined(curves)


def _refined(run: Array) -> Array:
    """Halve the sides of an open run until it has points enough."""
    while len(run) < LEAST_POINTS:
        middles = (run[:-1] + run[1:]) / 2
        run = np.insert(run, np.arange(1, len(run)), middles, axis=0)
    return run


def _passing(points: Array, node: int) -> Array:
    """Return the direction of the parabola through a vertex and its neighbours."""
    before = points[node] - points[node - 1]
    after = points[(node + 1) % len(points)] - points[node]
    h, k = np.hypot(*before), np.hypot(*after)
    return direction(before * k**2 + after * h**2)
