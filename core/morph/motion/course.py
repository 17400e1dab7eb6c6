"""Where a frame lies: gradients say nothing of that."""

from __future__ import annotations

import numpy as np

from core.fem.elements import Elements
from core.model.outline import Array


class Course:
    """The centre of mass runs straight from end to end.

    A vertex's mass is its share of the area, averaged over both ends.
    """

    def __init__(self, before: Elements, after: Elements, rest: Array, target: Array) -> None:
        self._mass = (_mass(before) + _mass(after)) / 2
        self._centres = self._mass @ rest, self._mass @ target

    def place(self, x: Array, t: float) -> Array:
        """Return positions x (n, 2) moved to where they belong at t."""
        start, end = self._centres
        return x + ((1 - t) * start + t * end - self._mass @ x)


def _mass(elements: Elements) -> Array:
    """Return (n,) each vertex's share of the area, summing to 1."""
    corners, areas = elements.triangles.ravel(), np.repeat(elements.areas, 3)
    shares = np.bincount(corners, weights=areas, minlength=elements.vertices)
    return shares / shares.sum()
