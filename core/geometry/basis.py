"""An outline's own coordinates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from core.geometry.clean_outline import CleanOutline
from core.model.outline import Array


@dataclass(frozen=True, eq=False)
class Basis:
    """Coordinates in which tolerances, predicates and energies mean the same for all outlines."""

    origin: Array
    """(2,) where they have their zero."""
    unit: float
    """Their length unit."""

    @classmethod
    def of(cls, end: CleanOutline) -> Self:
        """Take the coordinates in which an outline has unit area."""
        return cls(end.rings[0].mean(axis=0), float(np.sqrt(end.area)))

    def amid(self, other: Basis) -> Self:
        """Return coordinates of a size midway to another's, whichever of them comes first."""
        return replace(self, unit=float(np.sqrt(self.unit * other.unit)))

    def inside(self, points: Array) -> Array:
        """Return points (n, 2) in these coordinates."""
        return (points - self.origin) / self.unit

    def outside(self, points: Array) -> Array:
        """Return points (n, 2) as they were drawn."""
        return self.origin + self.unit * points
