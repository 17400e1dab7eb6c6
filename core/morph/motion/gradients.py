"""Ideal gradients B(t): each triangle's F = R(θ) S turns evenly while its stretch grows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from core.geometry.rotation import polar, rotate, unwrap
from core.geometry.triangulation import Indices, adjacent_triangles
from core.model.outline import Array

Stretch = Callable[[float], Array]
"""S(t) (m, 2, 2) on the way from I to S."""


class IdealGradients:
    """B(t) = R(tθ) S(t), with θ unwrapped across neighbouring triangles."""

    def __init__(
        self, F: Array, triangles: Indices, areas: Array, stretch: Callable[[Array], Stretch]
    ) -> None:
        """Prepare for deformation gradients F (m, 2, 2) of triangles (m, 3) with rest areas (m,).

        ``stretch`` makes S(t) from S.
        """
        theta, S = polar(F)
        pairs = adjacent_triangles(triangles)
        self.theta = unwrap(theta, pairs, areas) if len(pairs) else theta
        """(m,) rotation of each triangle."""
        self._stretch = stretch(S)

    def __call__(self, t: float) -> Array:
        """Return B(t) (m, 2, 2)."""
        return rotate(t * self.theta, self._stretch(t))


class LinearStretch:
    """(1 − t) I + t S, as the paper has it."""

    def __init__(self, S: Array) -> None:
        self._S = S

    def __call__(self, t: float) -> Array:
        """Return S(t) (m, 2, 2)."""
        blend = t * self._S
        blend[:, [0, 1], [0, 1]] += 1 - t
        return blend


class LogStretch:
    """Sᵗ: the same in both directions of time. Needs J > 0 everywhere."""

    def __init__(self, S: Array) -> None:
        mean = (S[:, 0, 0] + S[:, 1, 1]) / 2
        half = np.hypot((S[:, 0, 0] - S[:, 1, 1]) / 2, S[:, 0, 1])
        deviator = S - mean[:, None, None] * np.eye(2)
        self._axes = deviator / np.where(half > 0, half, 1)[:, None, None]
        """(m, 2, 2) symmetric, with eigenvalues 1 and −1 along the axes of stretch."""
        self._logs = np.log(mean + half), np.log(mean - half)

    def __call__(self, t: float) -> Array:
        """Return S(t) (m, 2, 2), from its eigenvalues."""
        high, low = (np.exp(t * log) for log in self._logs)
        power = ((high - low) / 2)[:, None, None] * self._axes
        power[:, [0, 1], [0, 1]] += ((high + low) / 2)[:, None]
        return power
