"""The paper's material (Song 2013, eq. 6, in its per-element form)."""

from __future__ import annotations

from dataclasses import dataclass

from core.fem.energies.density import Derivatives
from core.model.outline import Array


@dataclass(frozen=True)
class StVenantKirchhoff:
    """ψ = μ ‖E‖² + λ/2 (J − 1)², with the Green strain E = ½ (FᵀF − I) and J = det F.

    The material cannot tell F from a mirrored F, and crushes a triangle flat at finite cost.
    """

    mu: float = 1.0
    lam: float = 1.0
    barrier: bool = False

    def value(self, s1: Array, s2: Array) -> Array:
        """Return ψ (m,)."""
        strain = ((s1**2 - 1) ** 2 + (s2**2 - 1) ** 2) / 4
        return self.mu * strain + self.lam / 2 * (s1 * s2 - 1) ** 2

    def derivatives(self, s1: Array, s2: Array) -> Derivatives:
        """Return the derivatives of ψ."""
        growth = s1 * s2 - 1
        return Derivatives(
            d1=self.mu * s1 * (s1**2 - 1) + self.lam * growth * s2,
            d2=self.mu * s2 * (s2**2 - 1) + self.lam * growth * s1,
            d11=self.mu * (3 * s1**2 - 1) + self.lam * s2**2,
            d12=self.lam * (2 * s1 * s2 - 1),
            d22=self.mu * (3 * s2**2 - 1) + self.lam * s1**2,
        )
