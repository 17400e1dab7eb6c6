"""What a triangle costs for angles that are too narrow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.fem.energies.density import Derivatives
from core.model.outline import Array


@dataclass(frozen=True)
class Fairness:
    """ψ = w (√(1 + e²) − 1), e = max(0, 1/q − 1/q₀), q = 2 σ₁ σ₂ / (σ₁² + σ₂²).

    Over an equilateral rest shape q is the quality of the triangle, whatever its size. Nothing is
    asked of triangles with the quality q₀; a flat one costs infinitely much. Far from q₀ the cost
    grows no faster than 1/q: where no fair angle can be had, other aims count for more.
    """

    enough: float
    """q₀"""
    weight: float
    barrier: bool = True

    def value(self, s1: Array, s2: Array) -> Array:
        """Return ψ (m,); infinite where J ≤ 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            psi = self.weight * (np.hypot(1, self._excess(s1, s2)) - 1)
        return np.where(s2 > 0, psi, np.inf)

    def derivatives(self, s1: Array, s2: Array) -> Derivatives:
        """Return the derivatives of ψ."""
        excess = self._excess(s1, s2)
        root = np.hypot(1, excess)
        slope = self.weight * excess / root
        bend = self.weight * (excess > 0) / (root * root * root)
        a, b, J = s1**2, s2**2, s1 * s2
        d1, d2 = (1 / s2 - s2 / a) / 2, (1 / s1 - s1 / b) / 2  # of 1/q
        return Derivatives(
            d1=slope * d1,
            d2=slope * d2,
            d11=bend * d1 * d1 + slope * J / a**2,
            d12=bend * d1 * d2 - slope * (1 / a + 1 / b) / 2,
            d22=bend * d2 * d2 + slope * J / b**2,
        )

    def _excess(self, s1: Array, s2: Array) -> Array:
        return np.maximum((s1 / s2 + s2 / s1) / 2 - 1 / self.enough, 0)
