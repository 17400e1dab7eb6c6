"""Triangles whose corners are complex numbers: their areas, and when they are flat on the way."""

from __future__ import annotations

import numpy as np

from core.geometry.rotation import Complex
from core.model.outline import Array


def areas(corners: Complex) -> Array:
    """Return signed areas (c,) of triangles (3, c)."""
    return _cross(*_edges(corners)) / 2


def times_of_flatness(corners: Complex, step: Complex) -> Array:
    """Return (2, c) when triangles (3, c) that take a step are flat, not finite where never."""
    (p, q), (dp, dq) = _edges(corners), _edges(step)
    a, b, c = _cross(dp, dq), _cross(p, dq) + _cross(dp, q), _cross(p, q)
    with np.errstate(divide="ignore", invalid="ignore"):
        half = -(b + np.copysign(np.sqrt(b * b - 4 * a * c), b)) / 2  # so that nothing cancels
        return np.stack([half / a, c / half])


def first_flatness(corners: Complex, step: Complex) -> float:
    """Return the first time t > 0 at which any of the triangles (3, c) is flat, or infinity."""
    times = times_of_flatness(corners, step)
    return float(times[times > 0].min(initial=np.inf))


def _edges(corners: Complex) -> tuple[Complex, Complex]:
    return corners[1] - corners[0], corners[2] - corners[0]


def _cross(p: Complex, q: Complex) -> Array:
    return p.real * q.imag - p.imag * q.real
