"""A barrier that is felt only close to a fold."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.fem.energies.density import Derivatives
from core.model.outline import Array

REACH = 0.3
"""Fraction of a triangle's ideal area below which it is felt."""


@dataclass(frozen=True, eq=False)
class FoldBarrier:
    """ψ = k b(J / J₀), with b(s) = −(s/r − 1)² ln(s/r) below r = REACH and 0 above.

    Twice continuously differentiable where it sets in, infinite at J = 0.
    """

    ideal: Array
    """(m,) J₀ > 0."""
    stiffness: Array
    """(m,) k."""
    barrier: bool = True

    def value(self, s1: Array, s2: Array) -> Array:
        """Return ψ (m,); infinite where J ≤ 0."""
        u = s1 * s2 / (REACH * self.ideal)
        inside = np.clip(u, 1e-300, 1)
        return np.where(u > 0, -self.stiffness * (inside - 1) ** 2 * np.log(inside), np.inf)

    def derivatives(self, s1: Array, s2: Array) -> Derivatives:
        """Return the derivatives of ψ."""
        scale = REACH * self.ideal
        u = np.clip(s1 * s2 / scale, 1e-300, 1)
        log = np.log(u)
        slope = -self.stiffness / scale * (2 * (u - 1) * log + (u - 1) ** 2 / u)
        bend = -self.stiffness / scale**2 * (2 * log + 4 * (u - 1) / u - (u - 1) ** 2 / u**2)
        return Derivatives(
            d1=slope * s2,
            d2=slope * s1,
            d11=bend * s2**2,
            d12=bend * s1 * s2 + slope,
            d22=bend * s1**2,
        )
