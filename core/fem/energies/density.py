"""What an energy density is to the solver."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from core.model.outline import Array


@dataclass(frozen=True, eq=False)
class Derivatives:
    """First and second derivatives of a density by σ₁ and σ₂, each (m,)."""

    d1: Array
    d2: Array
    d11: Array
    d12: Array
    d22: Array


class Density(Protocol):
    """An isotropic energy per rest area: ψ(σ₁, σ₂), symmetric, of signed singular values (m,)."""

    @property
    def barrier(self) -> bool:
        """Whether ψ is infinite at J = 0, so that a step must stop short of it."""
        ...

    def value(self, s1: Array, s2: Array) -> Array:
        """Return ψ (m,)."""
        ...

    def derivatives(self, s1: Array, s2: Array) -> Derivatives:
        """Return the derivatives of ψ."""
        ...
