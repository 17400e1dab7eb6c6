"""The energy that harmonic maps minimise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.fem.energies.density import Derivatives
from core.model.outline import Array


@dataclass(frozen=True)
class Dirichlet:
    """ψ = ‖F‖² / 2: quadratic, so that Newton's first step is the whole way."""

    barrier: bool = False

    def value(self, s1: Array, s2: Array) -> Array:
        """Return ψ (m,)."""
        return (s1**2 + s2**2) / 2

    def derivatives(self, s1: Array, s2: Array) -> Derivatives:
        """Return the derivatives of ψ."""
        one = np.ones_like(s1)
        return Derivatives(d1=s1, d2=s2, d11=one, d12=np.zeros_like(s1), d22=one)
