"""Ideal gradients B(t): each triangle's F = R(θ) S turns evenly while its stretch grows.

A 2 x 2 matrix is kept as two complex numbers: it takes z to ``turn · z + mirror · z̄``. Rotating by
θ multiplies both by exp(iθ); a symmetric matrix has a real turn.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from core.geometry.rotation import Complex, phasor, turn_and_mirror, unwrap
from core.geometry.triangulation import Indices, adjacent_triangles
from core.model.outline import Array

Stretch = Callable[[float, Complex], None]
"""Multiplies S(t), on the way from I to S, into turns and mirrors (2, m) that hold rotations."""


class IdealGradients:
    """B(t) = R(tθ) S(t), with θ unwrapped across neighbouring triangles."""

    def __init__(
        self,
        F: Array,
        triangles: Indices,
        areas: Array,
        stretch: Callable[[Array, Complex], Stretch],
    ) -> None:
        """Prepare for deformation gradients F (m, 2, 2) of triangles (m, 3) with rest areas (m,).

        ``stretch`` makes S(t) from the turn and the mirror of S.
        """
        turn, mirror = turn_and_mirror(F)
        theta = np.angle(turn)
        pairs = adjacent_triangles(triangles)
        self.theta = unwrap(theta, pairs, areas) if len(pairs) else theta
        """(m,) rotation of each triangle."""
        self.turn = float(np.average(self.theta, weights=areas))
        """The mean rotation, in [-π, π)."""
        self._stretch = stretch(np.abs(turn), mirror * np.exp(-1j * theta))

    def __call__(self, t: float) -> Complex:
        """Return turn and mirror of B(t) (2, m)."""
        B = np.empty((2, len(self.theta)), dtype=complex)
        B[:] = phasor(t * self.theta)
        self._stretch(t, B)
        return B


class LinearStretch:
    """(1 − t) I + t S, as the paper has it."""

    def __init__(self, turn: Array, mirror: Complex) -> None:
        self._turn, self._mirror = turn, mirror

    def __call__(self, t: float, B: Complex) -> None:
        """Multiply S(t) into rotations B (2, m)."""
        B[0] *= (1 - t) + t * self._turn
        B[1] *= t * self._mirror


class LogStretch:
    """Sᵗ: the same in both directions of time. Needs J > 0 everywhere."""

    def __init__(self, turn: Array, mirror: Complex) -> None:
        half = np.abs(mirror)
        self._axes = mirror / np.where(half > 0, half, 1)
        """(m,) the axes of stretch: half the angle, as a unit complex number."""
        self._logs = np.log(turn + half), np.log(turn - half)

    def __call__(self, t: float, B: Complex) -> None:
        """Multiply Sᵗ, from its eigenvalues, into rotations B (2, m)."""
        high, low = (np.exp(t * log) / 2 for log in self._logs)
        B[0] *= high + low
        B[1] *= (high - low) * self._axes


def determinant(B: Complex) -> Array:
    """Return det B (m,) of turns and mirrors (2, m)."""
    squares = B.real**2 + B.imag**2
    return squares[0] - squares[1]
