"""On which side of a line a point lies: decided exactly, however close.

The determinant in floating point is trusted where it exceeds its own largest possible error
(Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric
predicates"); the few others are computed anew in rational numbers, without any error.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from core.model.outline import Array

ROUNDING = 2.0**-53
MARGIN = (3 + 16 * ROUNDING) * ROUNDING
"""Largest error of a difference of products of differences, relative to the products' sizes (there:
ccwerrboundA)."""
UNDERFLOW = 1e-290
"""Products below this may have lost more than rounding takes."""


def orientations(points: Array, triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return (m,) 1 for triangles (m, 3) that run counter-clockwise, -1 for clockwise ones, and 0
    for those without area or with corners that are no numbers.
    """
    a, b, c = (points[triangles[:, k]] for k in range(3))
    with np.errstate(over="ignore", invalid="ignore"):
        left = (a[:, 0] - c[:, 0]) * (b[:, 1] - c[:, 1])
        right = (a[:, 1] - c[:, 1]) * (b[:, 0] - c[:, 0])
        determinant, size = left - right, np.abs(left) + np.abs(right)
        certain: NDArray[np.bool_] = np.abs(determinant) > MARGIN * size + UNDERFLOW
    signs = np.where(certain, np.sign(determinant), 0).astype(np.int64)
    for k in np.flatnonzero(~certain):
        signs[k] = _exactly(a[k], b[k], c[k])
    return signs


def _exactly(*corners: Array) -> int:
    if not np.isfinite(corners).all():
        return 0
    (ax, ay), (bx, by), (cx, cy) = (map(Fraction, corner.tolist()) for corner in corners)
    left, right = (ax - cx) * (by - cy), (ay - cy) * (bx - cx)
    return (left > right) - (left < right)
