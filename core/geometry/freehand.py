"""A freehand stroke to a closed ring with few nodes and smooth handles.

The fit is the classic one: least-squares cubics with given end tangents, cut in two where they miss
(P. J. Schneider, "An Algorithm for Automatically Fitting Digitized Curves", Graphics Gems, 1990).
Around it stands what closed hand-drawn shapes need: ends that overshoot or do not quite meet,
corners that must stay corners, and a smooth passage where the stroke began.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from core.errors import OutlineError
from core.geometry.polyline import arc_lengths, cross, resample, signed_area
from core.model.cubic import bernstein, points_on
from core.model.outline import Array, Ring

CORNER_ANGLE = np.radians(55)
"""Turns sharper than this within a few tolerances are corners."""
CORNER_REACH = 4.0
"""How far to each side a corner is looked for, in tolerances."""
MEETING_GAP = 0.08
"""Ends that miss each other by less than this fraction of the stroke are drawn together."""
TAIL = 0.25
"""Fraction of the stroke at either end in which a crossing counts as an overshoot."""
REFITS = 4
"""Times the curve parameters are improved before a piece is cut in two."""
MAX_POINTS = 1200
"""Points that a stroke is reduced to at most."""
FEWEST_NODES = 3
"""Nodes that a ring has at least, though two cubics can make an egg."""


def fit_stroke(stroke: ArrayLike, tolerance: float) -> Ring:
    """Return the ring that a stroke (n, 2) meant, staying within about ``tolerance`` of it.

    Raises ``OutlineError`` when the stroke encloses nothing.
    """
    points = _without_repeats(np.asarray(stroke, dtype=float).reshape(-1, 2), tolerance / 4)
    if len(points) >= 3:
        points = _meeting(_without_overshoot(points))
    if len(points) < 3 or _thickness(points) < tolerance:
        raise OutlineError(
            "The stroke encloses no area.", hint="Draw around the whole shape in one stroke."
        )
    perimeter = arc_lengths(points)[-1]
    points = resample(points, int(np.clip(perimeter / (0.5 * tolerance), 24, MAX_POINTS)))
    step = perimeter / len(points)
    corners = _corners(points, max(1, round(CORNER_REACH * tolerance / step)))
    ring = joined(_fit_pieces(points, corners, tolerance))
    while len(ring) < FEWEST_NODES:
        ring = ring.with_node(0.5)
    return ring


# -- the stroke --------------------------------------------------------------------------------


def _without_repeats(points: Array, distance: float) -> Array:
    """Drop points that lie closer than ``distance`` to the one kept before them."""
    kept = [points[0]] if len(points) else []
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) > distance:
            kept.append(point)
    return np.array(kept).reshape(-1, 2)


def _thickness(points: Array) -> float:
    """Return about how wide a shape is where it is long; 0 where it encloses nothing."""
    return 2 * abs(signed_area(points)) / float(arc_lengths(points)[-1])


def _without_overshoot(points: Array) -> Array:
    """Cut both ends off where the tail of the stroke crosses its head."""
    count = max(2, int(TAIL * len(points)))
    head, tail = points[:count], points[-count:]
    p, r = head[:-1, None], np.diff(head, axis=0)[:, None]
    q, s = tail[None, :-1], np.diff(tail, axis=0)[None]
    turn = cross(r, s)
    with np.errstate(divide="ignore", invalid="ignore"):
        u, v = cross(q - p, s) / turn, cross(q - p, r) / turn
    crossing = (turn != 0) & (u >= 0) & (u <= 1) & (v >= 0) & (v <= 1)
    if not crossing.any() or len(points) < 8:
        return points
    i, j = np.argwhere(crossing)[-1]
    place = head[i] + u[i, j] * (head[i + 1] - head[i])
    return np.vstack([place, points[i + 1 : len(points) - count + j + 1]])


def _meeting(points: Array) -> Array:
    """Draw nearly closed ends together, so that closing leaves no kink."""
    gap = points[0] - points[-1]
    length = arc_lengths(points)
    if np.hypot(*gap) > MEETING_GAP * length[-2]:
        return points
    t = length[:-1] / length[-2]
    weight = np.clip(1 - t / TAIL, 0, 1) ** 2 - np.clip(1 - (1 - t) / TAIL, 0, 1) ** 2
    return (points - 0.5 * weight[:, None] * gap)[:-1]


def _corners(points: Array, reach: int) -> list[int]:
    """Return the indices of the corners, sharpest within ``reach`` points to either side."""
    before = points - np.roll(points, reach, axis=0)
    after = np.roll(points, -reach, axis=0) - points
    turn = np.abs(np.arctan2(cross(before, after), np.einsum("ij,ij->i", before, after)))
    shifts = (shift for shift in range(-2 * reach, 2 * reach + 1) if shift)
    highest = turn >= np.max([np.roll(turn, shift) for shift in shifts], axis=0)
    return np.flatnonzero(highest & (turn > CORNER_ANGLE)).tolist()


# -- the curves --------------------------------------------------------------------------------


def _fit_pieces(points: Array, corners: list[int], tolerance: float) -> list[Array]:
    """Return the cubics (4, 2) around the ring, in order: from corner to corner.

    A ring without corners is cut at its extremes instead, and passes them smoothly.
    """
    look = max(2, len(points) // 100)
    extremes = [*points.argmin(axis=0), *points.argmax(axis=0)]
    cuts = corners or np.unique(extremes).tolist()
    curves = []
    for start, end in zip(cuts, [*cuts[1:], cuts[0] + len(points)], strict=True):
        piece = points[np.arange(start, end + 1) % len(points)]
        ahead = min(look, len(piece) - 1)
        leaving, arriving = unit(piece[ahead] - piece[0]), unit(piece[-1 - ahead] - piece[-1])
        if not corners:
            leaving, arriving = _along(points, start, look), -_along(points, end, look)
        curves += fit_run(piece, leaving, arriving, tolerance)
    return curves


def _along(points: Array, index: int, look: int) -> Array:
    """Return the direction in which a ring passes a point."""
    n = len(points)
    return unit(points[(index + look) % n] - points[(index - look) % n])


def fit_run(points: Array, leaving: Array, arriving: Array, tolerance: float) -> list[Array]:
    """Return cubics (4, 2) along an open run of points (n, 2), within ``tolerance`` of them.

    The unit tangents at both ends point into the run.
    """
    if len(points) < 4 or _off_line(points) < tolerance / 2:
        return [points[[0, 0, -1, -1]]]
    u = arc_lengths(points)[:-1]
    u = u / u[-1]
    for _ in range(REFITS):
        curve = _least_squares(points, u, leaving, arriving)
        miss = np.hypot(*(points_on(curve, u) - points).T)
        if miss.max() < tolerance:
            return [curve]
        u = _nearer_parameters(curve, points, u)
    cut = int(np.clip(np.argmax(miss), 2, len(points) - 3)) if len(points) > 5 else 2
    width = min(cut, len(points) - 1 - cut, max(2, len(points) // 16))
    tangent = unit(points[cut - width] - points[cut + width])
    return [
        *fit_run(points[: cut + 1], leaving, tangent, tolerance),
        *fit_run(points[cut:], -tangent, arriving, tolerance),
    ]


def _least_squares(points: Array, u: Array, leaving: Array, arriving: Array) -> Array:
    """Return the cubic through both ends, with these tangents, closest to the points at ``u``."""
    b = bernstein(u)
    first, last = points[0], points[-1]
    A = np.stack([b[:, 1:2] * leaving, b[:, 2:3] * arriving], axis=1)  # (n, 2, 2)
    rest = points - (b[:, 0] + b[:, 1])[:, None] * first - (b[:, 2] + b[:, 3])[:, None] * last
    normal = np.einsum("nik,njk->ij", A, A)
    right = np.einsum("nik,nk->i", A, rest)
    chord = float(np.hypot(*(last - first)))
    length = float(np.hypot(*np.diff(points, axis=0).T).sum())
    alpha = np.full(2, length / 3)
    if abs(np.linalg.det(normal)) > 1e-12 * np.trace(normal) ** 2:
        alpha = np.linalg.solve(normal, right)
    if np.any(alpha < 1e-3 * max(chord, length / 10)) or np.any(alpha > 2 * length):
        alpha = np.full(2, length / 3)  # Wu and Barsky's fallback
    return np.array([first, first + alpha[0] * leaving, last + alpha[1] * arriving, last])


def _nearer_parameters(curve: Array, points: Array, u: Array) -> Array:
    """Return parameters improved by one Newton step towards the closest points on the curve."""
    away = points_on(curve, u) - points
    first, second = 3 * np.diff(curve, axis=0), 6 * np.diff(curve, n=2, axis=0)
    v = 1 - u
    d1 = np.stack([v * v, 2 * v * u, u * u], axis=1) @ first
    d2 = np.stack([v, u], axis=1) @ second
    slope = np.einsum("ij,ij->i", d1, d1) + np.einsum("ij,ij->i", away, d2)
    step = np.divide(np.einsum("ij,ij->i", away, d1), slope, out=np.zeros_like(u), where=slope > 0)
    return np.maximum.accumulate(np.clip(u - step, 0, 1))


def _off_line(points: Array) -> float:
    """Return how far the run strays from its chord; infinite when it turns back on itself."""
    chord = points[-1] - points[0]
    length = float(np.hypot(*chord))
    if length == 0:
        return np.inf
    along = (points - points[0]) @ chord / length
    if along.min() < -1e-9 * length or along.max() > length * (1 + 1e-9):
        return np.inf
    return float(np.abs(cross(points - points[0], chord)).max() / length)


def unit(vector: Array) -> Array:
    """Return a vector (2,) at length 1; of none, one to the right."""
    length = float(np.hypot(*vector))
    return vector / length if length > 0 else np.array([1.0, 0.0])


def joined(curves: list[Array]) -> Ring:
    """Join cubics (4, 2) end to end to a ring; a node where two meet."""
    b = np.array(curves)
    return Ring(b[:, 0], np.roll(b[:, 2] - b[:, 3], 1, axis=0), b[:, 1] - b[:, 0])
