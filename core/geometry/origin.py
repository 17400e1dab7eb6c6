"""Where a repaired ring's vertices were on the ring as it was drawn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from core.model.outline import Array


@dataclass(frozen=True, eq=False)
class Origin:
    """Places on a drawn ring, counted in its vertices, cyclic."""

    at: Array
    """(n, 2) where each vertex arrives and leaves; they differ where something between was left
    out."""
    size: int
    """Vertices of the drawn ring."""
    backwards: bool = False
    """Whether the places fall rather than rise."""

    @classmethod
    def of_kept(cls, kept: NDArray[np.int64], size: int) -> Self:
        """Describe a ring of which the vertices ``kept`` are left, each the last of its repeats."""
        first = (np.roll(kept, 1) + 1) % size
        return cls(np.column_stack([first, kept]).astype(float), size)

    def reversed(self) -> Self:
        """Describe the ring run through the other way, vertex 0 staying first."""
        at = np.roll(self.at[::-1, ::-1], 1, axis=0)
        return type(self)(at, self.size, not self.backwards)

    def run(self, at: float | Array) -> Array:
        """Return how far places (...) lie from where vertex 0 arrives, in [0, size)."""
        away = np.asarray(at) - self.at[0, 0]
        return (-away if self.backwards else away) % self.size

    def place(self, run: float) -> float:
        """Return the place at a run."""
        return float((self.at[0, 0] + (-run if self.backwards else run)) % self.size)

    def runs(self) -> Array:
        """Return (2n + 1,) the runs at which vertices arrive and leave, and the whole."""
        return np.append(self.run(self.at).ravel(), self.size)

    def between(self, vertex: int, u: float) -> float:
        """Return the place at a fraction u > 0 of the way from a vertex to the next."""
        leave = self.at[vertex, 1]
        gap = (self.at[(vertex + 1) % len(self.at), 0] - leave) % self.size
        return float((leave + u * gap) % self.size)
