"""Runs of points to cubic Bézier curves with few nodes.

The fit is the classic one: least-squares cubics with given end tangents, cut in two where they miss
(P. J. Schneider, "An Algorithm for Automatically Fitting Digitized Curves", Graphics Gems, 1990).
"""

from __future__ import annotations

import numpy as np

from core.geometry.polyline import arc_lengths, cross
from core.model.cubic import bernstein, points_on
from core.model.outline import Array, Ring

REFITS = 4
"""Times the curve parameters are improved before a piece is cut in two."""


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
    tangent = direction(points[cut - width] - points[cut + width])
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


def direction(vector: Array) -> Array:
    """Return a vector (2,) at length 1; of none, one to the right."""
    length = float(np.hypot(*vector))
    return vector / length if length > 0 else np.array([1.0, 0.0])


def joined(curves: list[Array]) -> Ring:
    """Join cubics (4, 2) end to end to a ring; a node where two meet."""
    b = np.array(curves)
    return Ring(b[:, 0], np.roll(b[:, 2] - b[:, 3], 1, axis=0), b[:, 1] - b[:, 0])
