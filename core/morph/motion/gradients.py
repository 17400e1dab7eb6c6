"""Ideal gradients B(t): each triangle's F = R(θ) S turns evenly while its stretch grows.

A 2 x 2 matrix is kept as two complex numbers: it takes z to ``turn · z + mirror · z̄``. Rotating by
θ multiplies both by exp(iθ); a symmetric matrix has a real turn.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from core.geometry.rotation import Complex, phasor, stretches, turn_and_mirror, unwrap
from core.geometry.triangulation import Indices, adjacent_triangles
from core.model.outline import Array

Stretch = Callable[[float], tuple[Array, Complex]]
"""Returns turn (m,) and mirror (m,) of S(t), on the way from I to S."""


class IdealGradients:
    """B(t) = R(tθ) S(t), with θ unwrapped across neighbouring triangles."""

    def __init__(
        self,
        F: Array,
        triangles: Indices,
        weights: Array,
        stretch: Callable[[Array, Complex], Stretch],
    ) -> None:
        """Prepare for deformation gradients F (m, 2, 2) of triangles (m, 3).

        ``weights`` (m,) are how much triangles count for the mean rotation. ``stretch`` makes S(t)
        from the turn and the mirror of S.
        """
        turn, mirror = turn_and_mirror(F)
        theta = np.angle(turn)
        pairs = adjacent_triangles(triangles)
        self.theta = unwrap(theta, pairs, weights) if len(pairs) else theta
        """(m,) rotation of each triangle."""
        self.turn = float(np.average(self.theta, weights=weights))
        """The mean rotation, in [-π, π)."""
        self._stretch = stretch(np.abs(turn), mirror * np.exp(-1j * theta))

    def __call__(self, t: float) -> Complex:
        """Return turn and mirror of B(t) (2, m)."""
        rotation = phasor(t * self.theta)
        B = np.empty((2, len(rotation)), dtype=complex)
        for part, out in zip(self._stretch(t), B, strict=True):
            np.multiply(rotation, part, out=out)
        return B


class LinearStretch:
    """(1 − t) I + t S, as the paper has it."""

    def __init__(self, turn: Array, mirror: Complex) -> None:
        self._turn, self._mirror = turn, mirror

    def __call__(self, t: float) -> tuple[Array, Complex]:
        """Return turn and mirror of S(t) (m,)."""
        return (1 - t) + t * self._turn, t * self._mirror


class LogStretch:
    """Sᵗ: the same in both directions of time. Needs J > 0 everywhere."""

    def __init__(self, turn: Array, mirror: Complex) -> None:
        half = np.abs(mirror)
        self._half_axes = mirror / np.where(half > 0, 2 * half, 1)
        """(m,) the axes of stretch: half the angle, as a complex number, of length ½."""
        self._logs = np.log(stretches(turn, half))

    def __call__(self, t: float) -> tuple[Array, Complex]:
        """Return turn and mirror of Sᵗ (m,), from its eigenvalues."""
        high, low = np.exp(t * self._logs)
        return 0.5 * (high + low), (high - low) * self._half_axes


def determinant(B: Complex) -> Array:
    """Return det B (m,) of turns and mirrors (2, m)."""
    squares = B.real**2 + B.imag**2
    return squares[0] - squares[1]
