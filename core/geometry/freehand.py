"""A freehand stroke to a closed ring with few nodes and smooth handles.

Around the fit stands what closed hand-drawn shapes need: ends that overshoot or do not quite meet,
corners that must stay corners, and a smooth passage where the stroke began.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from core.errors import OutlineError
from core.geometry.fitting import direction, fit_run, joined
from core.geometry.polyline import arc_lengths, cross, resample, signed_area
from core.model.outline import MIN_NODES, Array, Ring

CORNER_ANGLE = np.radians(55)
"""Turns sharper than this within a few tolerances are corners."""
CORNER_REACH = 4.0
"""How far to each side a corner is looked for, in tolerances."""
MEETING_GAP = 0.08
"""Ends that miss each other by less than this fraction of the stroke are drawn together."""
TAIL = 0.25
"""Fraction of the stroke at either end in which a crossing counts as an overshoot."""
MAX_POINTS = 1200
"""Points that a stroke is reduced to at most."""


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
    while len(ring) < MIN_NODES:  # two cubics can make an egg
        ring = ring.with_node(0.5)
    return ring


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
        leaving, arriving = (
            direction(piece[ahead] - piece[0]),
            direction(piece[-1 - ahead] - piece[-1]),
        )
        if not corners:
            leaving, arriving = _along(points, start, look), -_along(points, end, look)
        curves += fit_run(piece, leaving, arriving, tolerance)
    return curves


def _along(points: Array, index: int, look: int) -> Array:
    """Return the direction in which a ring passes a point."""
    n = len(points)
    return direction(points[(index + look) % n] - points[(index - look) % n])
