"""Distortion of a map as a function of its source, when it is the source that moves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.fem.energies.density import Derivatives
from core.model.outline import Array


@dataclass(frozen=True)
class InverseDirichlet:
    """ψ = J (‖F‖² + ‖F⁻¹‖²) / 4: symmetric Dirichlet per area of the other end.

    With F = ∂X/∂x over the target's triangles Σ A ψ is Σ A ψ of ``SymmetricDirichlet`` over the
    source's, but for rounding: J is how much a triangle of the target grows, and the rest is the
    same for F and F⁻¹.
    """

    barrier: bool = True

    def value(self, s1: Array, s2: Array) -> Array:
        """Return ψ (m,); infinite where J ≤ 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            J = s1 * s2
            psi = (s1**2 + s2**2) * (J + 1 / J) / 4
        return np.where(s2 > 0, psi, np.inf)

    def derivatives(self, s1: Array, s2: Array) -> Derivatives:
        """Return the derivatives of ψ."""
        a, b, J = s1**2, s2**2, s1 * s2
        return Derivatives(
            d1=((3 * a + b) * s2 - s2 / a + 1 / s2) / 4,
            d2=((3 * b + a) * s1 - s1 / b + 1 / s1) / 4,
            d11=(3 * J + J / a**2) / 2,
            d12=(3 * (a + b) - 1 / a - 1 / b) / 4,
            d22=(3 * J + J / b**2) / 2,
        )
