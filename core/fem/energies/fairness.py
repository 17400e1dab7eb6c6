"""What a triangle costs for angles that are too narrow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.fem.energies.density import Derivatives
from core.model.outline import Array


@dataclass(frozen=True)
class Fairness:
    """ψ = w · max(0, 1/q − 1/q₀)², where q = 2 σ₁ σ₂ / (σ₁² + σ₂²) is 1 for a similarity.

    Over an equilateral rest shape q is the quality of the triangle, whatever its size. Nothing is
    asked of triangles with the quality q₀; a flat one costs infinitely much.
    """

    enough: float
    """q₀"""
    weight: float
    barrier: bool = True

    def value(self, s1: Array, s2: Array) -> Array:
        """Return ψ (m,); infinite where J ≤ 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            psi = self.weight * self._excess(s1, s2) ** 2
        return np.where(s2 > 0, psi, np.inf)

    def derivatives(self, s1: Array, s2: Array) -> Derivatives:
        """Return the derivatives of ψ."""
        excess = self._excess(s1, s2)
        poor = excess > 0
        d1, d2 = (1 / s2 - s2 / s1**2) / 2, (1 / s1 - s1 / s2**2) / 2
        mixed = -(s1**-2.0 + s2**-2.0) / 2
        w = 2 * self.weight
        return Derivatives(
            d1=w * excess * d1,
            d2=w * excess * d2,
            d11=w * (poor * d1 * d1 + excess * s2 / s1**3),
            d12=w * (poor * d1 * d2 + excess * mixed),
            d22=w * (poor * d2 * d2 + excess * s1 / s2**3),
        )

    def _excess(self, s1: Array, s2: Array) -> Array:
        return np.maximum((s1 / s2 + s2 / s1) / 2 - 1 / self.enough, 0)
