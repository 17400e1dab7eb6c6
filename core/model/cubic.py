"""Cubic Bézier curves, as four control points (4, 2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def bernstein(u: ArrayLike) -> Array:
    """Return the weights (..., 4) of the control points at parameters u (...,)."""
    u = np.asarray(u, dtype=float)
    v = 1 - u
    return np.stack([v**3, 3 * v * v * u, 3 * v * u * u, u**3], axis=-1)


def points_on(controls: Array, u: ArrayLike) -> Array:
    """Return the points (..., 2) of a curve at parameters u (...,); those at 0 and 1 exactly."""
    return bernstein(u) @ controls


def split(controls: Array, u: float) -> tuple[Array, Array]:
    """Return the curve up to a parameter, and from there on (de Casteljau)."""
    ab, bc, cd = (1 - u) * controls[:-1] + u * controls[1:]
    abc, bcd = (1 - u) * ab + u * bc, (1 - u) * bc + u * cd
    middle = points_on(controls, u)
    return np.array([controls[0], ab, abc, middle]), np.array([middle, bcd, cd, controls[3]])


def turning_points(curves: Array) -> Array:
    """Return the points (j, 2) at which curves (k, 4, 2) are farthest left, up, right or down."""
    first, second, third = np.moveaxis(np.diff(curves, axis=1), 1, 0)
    a, b, c = first - 2 * second + third, second - first, first
    with np.errstate(all="ignore"):
        # the derivative's zeros, a u² + 2 b u + c = 0, so that nothing cancels
        half = -(b + np.copysign(np.sqrt(b * b - a * c), b))
        u = np.concatenate([half / a, c / half], axis=1)
    inside = (u > 0) & (u < 1)
    curve, _ = np.nonzero(inside)
    return np.einsum("jb,jbi->ji", bernstein(u[inside]), curves[curve])
