"""An outline that can be computed with, and the way back to how it was drawn."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from core.errors import Repair
from core.geometry.origin import Origin
from core.geometry.polyline import arc_lengths, diagonal, signed_area
from core.model.outline import Array


@dataclass(frozen=True, eq=False)
class CleanOutline:
    """Rings (n, 2) that are simple, disjoint and nested: exterior first with positive area, holes
    with negative area.
    """

    rings: tuple[Array, ...]
    origins: tuple[Origin, ...]
    """Where each ring's vertices were on the ring as given."""
    repairs: tuple[Repair, ...]
    """What had to be changed."""

    @property
    def area(self) -> float:
        """Enclosed area, holes taken off."""
        return sum(signed_area(ring) for ring in self.rings)

    @cached_property
    def diagonal(self) -> float:
        """Diagonal of the bounds."""
        return diagonal(self.rings[0])

    @cached_property
    def lengths(self) -> tuple[Array, ...]:
        """The arc lengths (n + 1,) of each ring's vertices, and of the whole."""
        return tuple(map(arc_lengths, self.rings))

    def length_of(self, ring: int, at: float) -> float:
        """Return the arc length on a ring of a place on the given one, counted in its vertices.

        A place that was cut off counts as the one where it was cut.
        """
        return float(np.interp(self.origins[ring].run(at), *self._runs[ring]))

    def vertex_of(self, ring: int, length: float) -> float:
        """Return the place on the given ring, counted in its vertices, of an arc length."""
        runs, lengths = self._runs[ring]
        return self.origins[ring].place(float(np.interp(length % lengths[-1], lengths, runs)))

    @cached_property
    def _runs(self) -> tuple[tuple[Array, Array], ...]:
        """The runs and the arc lengths (2n + 1,) at which each ring's vertices arrive and leave."""
        return tuple(
            (origin.runs(), np.append(np.repeat(lengths[:-1], 2), lengths[-1]))
            for origin, lengths in zip(self.origins, self.lengths, strict=True)
        )
