"""Distortion of a map and of its inverse alike (Smith and Schaefer 2015)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.fem.energies.density import Derivatives
from core.model.outline import Array


@dataclass(frozen=True)
class SymmetricDirichlet:
    """ψ = (‖F‖² + ‖F⁻¹‖²) / 4: 1 for an isometry, infinite for a flat triangle."""

    barrier: bool = True

    def value(self, s1: Array, s2: Array) -> Array:
        """Return ψ (m,); infinite where J ≤ 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            J = s1 * s2
            psi = (s1**2 + s2**2) * (1 + 1 / J**2) / 4
        return np.where(s2 > 0, psi, np.inf)

    def derivatives(self, s1: Array, s2: Array) -> Derivatives:
        """Return the derivatives of ψ."""
        q1, q2 = 1 / s1**2, 1 / s2**2
        return Derivatives(
            d1=(s1 - q1 / s1) / 2,
            d2=(s2 - q2 / s2) / 2,
            d11=(1 + 3 * q1 * q1) / 2,
            d12=np.zeros_like(s1),
            d22=(1 + 3 * q2 * q2) / 2,
        )
