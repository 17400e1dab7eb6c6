"""Ideal gradients of a span whose ends the motion passes through at given velocities.

With E = log of a gradient's stretch and i times its angle, a span by itself has E(t) = t E. Where
its ends have rates of their own, E(t) is the cubic that has them (Hermite), and frames are fitted
and guarded as ever. As everywhere here, a matrix is its turn and its mirror: turn · z + mirror · z̄.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from core.geometry.rotation import Complex, phasor, stretches, turn_and_mirror, unit
from core.model.outline import Array

Rates = tuple[Complex | None, Complex | None]
"""Velocity gradients (2, m) at both ends, each in the shape it has there; None is as if the span
were by itself."""
BY_ITSELF: Rates = (None, None)


def bumps(t: float) -> tuple[float, float]:
    """Return what a rate too much at the start, and one at the end, adds to a cubic at t."""
    return t * (1 - t) ** 2, t * t * (t - 1)


@dataclass(frozen=True, eq=False)
class Exponent:
    """E of every triangle of a map: B(t) = R(t Im E₀) exp(t (Re E₀ + mirror E₁))."""

    value: Complex
    """(2, m)"""

    @classmethod
    def of(cls, F: Array, theta: Array) -> Self:
        """Take it from gradients F (m, 2, 2) without folds and their unwrapped angles (m,)."""
        turn, mirror = turn_and_mirror(F)
        high, low = np.log(stretches(np.abs(turn), np.abs(mirror)))
        axes = unit(mirror * np.exp(-1j * theta))
        return cls(np.stack([(high + low) / 2 + 1j * theta, (high - low) / 2 * axes]))

    @property
    def rate_at_start(self) -> Complex:
        """(2, m) the velocity gradient ∂v/∂x at t = 0 of a span by itself."""
        return self.value

    @property
    def rate_at_end(self) -> Complex:
        """(2, m) the velocity gradient ∂v/∂x at t = 1 of a span by itself, where it ends."""
        scale, mirror = self.value
        return np.stack([scale, mirror * np.exp(2j * scale.imag)])

    def change_at_end(self, rate: Complex) -> Complex:
        """Return dE/dt (2, m) at t = 1 for which the velocity gradient there is ``rate`` (2, m).

        With Ḃ = l B and B = R S: R's rate a makes Ṡ = (Rᵀ l R − a J) S symmetric; and d log S has,
        in the axes of S, the divided differences of the logarithm as factors.
        """
        scale, theta = self.value[0].real, self.value[0].imag
        shear, axes = np.abs(self.value[1]), unit(self.value[1])
        high, low = np.exp(scale + shear), np.exp(scale - shear)
        turn, mirror = (high + low) / 2, (high - low) / 2 * axes
        W = rate[0], rate[1] * np.exp(-2j * theta)  # Rᵀ l R
        spin = W[0].imag + (W[1] * np.conj(mirror)).imag / turn
        still = W[0] - 1j * spin
        grown = (still * turn + W[1] * np.conj(mirror)).real
        bent = (still * mirror + W[1] * turn) / axes
        first, second = (grown + bent.real) / high, (grown - bent.real) / low
        apart = high - low
        even = apart < 1e-9 * high
        factor = np.where(even, 1 / high, 2 * shear / np.where(even, 1, apart))
        return np.stack(
            [
                (first + second) / 2 + 1j * spin,
                axes * ((first - second) / 2 + 1j * factor * bent.imag),
            ]
        )


class PassingGradients:
    """B(t) with given velocity gradients at the ends, or at one of them."""

    def __init__(self, exponent: Exponent, start: Complex | None, end: Complex | None) -> None:
        """Prepare for velocity gradients (2, m) at the ends."""
        self._even = exponent.value
        self._start = None if start is None else start - exponent.value
        self._end = None if end is None else exponent.change_at_end(end) - exponent.value

    def __call__(self, t: float) -> Complex:
        """Return turn and mirror of B(t) (2, m)."""
        E = t * self._even
        for bump, rate in zip(bumps(t), (self._start, self._end), strict=True):
            if rate is not None:
                E += bump * rate
        shear, growth = np.abs(E[1]), np.exp(E[0].real)
        B = np.empty_like(E)
        B[:] = growth * phasor(E[0].imag)
        B[0] *= np.cosh(shear)
        B[1] *= np.sinh(shear) * unit(E[1])
        return B
