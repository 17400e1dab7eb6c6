"""The energy that unfolds (Garanzha et al. 2021, "Foldover-free maps in 50 lines of code")."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.fem.energies.density import Derivatives
from core.model.outline import Array


def regularised(J: Array, epsilon: float) -> Array:
    """Return χ = (J + √(ε² + J²)) / 2: close to J where J ≫ ε, and always positive.

    Written so that nothing cancels where J is negative.
    """
    root = np.hypot(epsilon, J)
    return np.where(J > 0, (J + root) / 2, epsilon**2 / (2 * (root - np.minimum(J, 0))))


@dataclass(frozen=True)
class FoldoverFree:
    """ψ = (‖F‖² + J² + 1) / χ(J, ε): finite for folded triangles, and steep enough to unfold."""

    epsilon: float
    barrier: bool = False

    def value(self, s1: Array, s2: Array) -> Array:
        """Return ψ (m,)."""
        J = s1 * s2
        return (s1**2 + s2**2 + J**2 + 1) / regularised(J, self.epsilon)

    def derivatives(self, s1: Array, s2: Array) -> Derivatives:
        """Return the derivatives of ψ = N(σ₁, σ₂) / χ(J), J = σ₁ σ₂."""
        J = s1 * s2
        root = np.hypot(self.epsilon, J)
        chi = regularised(J, self.epsilon)
        N = s1**2 + s2**2 + J**2 + 1
        slope = chi / root  # χ′
        bend = self.epsilon**2 / (2 * root * root * root)  # χ″
        by_J = -N * slope / chi**2
        by_JJ = N * (2 * slope**2 / chi - bend) / chi**2
        n1, n2 = 2 * s1 + 2 * J * s2, 2 * s2 + 2 * J * s1
        mixed = -slope / chi**2
        return Derivatives(
            d1=n1 / chi + by_J * s2,
            d2=n2 / chi + by_J * s1,
            d11=(2 + 2 * s2**2) / chi + 2 * mixed * n1 * s2 + by_JJ * s2**2,
            d12=4 * J / chi + mixed * (n1 * s1 + n2 * s2) + by_J + by_JJ * J,
            d22=(2 + 2 * s1**2) / chi + 2 * mixed * n2 * s1 + by_JJ * s1**2,
        )
