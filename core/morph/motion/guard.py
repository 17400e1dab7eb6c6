"""Triangles that near a fold: their areas are gaps that must not close."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from core.fem.elements import Elements
from core.geometry.flatness import areas, first_flatness
from core.geometry.rotation import Complex
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.motion.barrier import LEFT_ALONE, Derivatives

REACH = 0.3
"""Fraction of a triangle's ideal area below which the guard is felt."""
STIFFNESS = 0.1
SHORT_OF_FLAT = 0.9
"""Fraction of the way to the first flat triangle that a step may go."""

AREA_BEND = np.kron([[0, 1, -1], [-1, 0, 1], [1, -1, 0]], [[0, 1], [-1, 0]]) / 2
"""(6, 6) second derivative of a triangle's area by its corners' coordinates."""


class FoldGuard:
    """Weighs folds against the fit: Σ w det B b(det F / (reach · det B)), the ideal being B.

    It is felt only close to a fold: elsewhere frames are the plain fit's. A triangle's reach is but
    a part of its smallest margin in frames to be left alone.
    """

    def __init__(self, before: Elements, after: Elements) -> None:
        """Prepare for rest and target elements."""
        self.triangles, self._areas = before.triangles, before.areas
        self._weights = STIFFNESS * (before.areas + after.areas) / 2
        self._reach = np.full(len(self._areas), REACH)

    def leaving(self, *margins: Array) -> Self:
        """Return the guard that is not felt in frames with some margins (m,) either."""
        other = copy(self)
        other._reach = np.min([self._reach, *(LEFT_ALONE * margin for margin in margins)], axis=0)
        return other

    def near(self, z: Complex, ideal: Array, within: float) -> Indices:
        """Return the triangles with a gap below ``within``, in order."""
        return np.flatnonzero(self.margins(z, ideal) < within * self._reach)

    def margins(self, z: Complex, ideal: Array) -> Array:
        """Return det F / det B (m,) at positions z (n,), for ideal determinants (m,)."""
        return areas(z[self.triangles.T]) / (self._areas * ideal)

    def gaps(self, which: Indices, vertices: Indices, ideal: Array) -> TriangleGaps:
        """Return some triangles as gaps between the vertices held, which come in order."""
        corners = np.searchsorted(vertices, self.triangles[which])
        weights, felt = self._weights * ideal, self._reach * self._areas * ideal
        return TriangleGaps(corners, weights[which], felt[which])


@dataclass(frozen=True, eq=False)
class TriangleGaps:
    """Areas of triangles, in units of those below which they are felt."""

    bent: ClassVar = True
    corners: Indices
    weights: Array
    felt: Array
    """(c,) areas."""

    def __call__(self, z: Complex) -> Array:
        """Return the gaps (c,) at positions z (k,)."""
        return areas(z[self.corners.T]) / self.felt

    def derivatives(self, z: Complex, which: Indices) -> Derivatives:
        """Return some of the gaps with their derivatives."""
        corners, felt = z[self.corners[which]], self.felt[which]
        opposite = np.roll(corners, -1, axis=1) - np.roll(corners, 1, axis=1)
        slopes = (-0.5j * opposite / felt[:, None]).view(float)
        return Derivatives(areas(corners.T) / felt, slopes, AREA_BEND / felt[:, None, None])

    def free_way(self, z: Complex, step: Complex) -> float:
        """Return a part of a step that stops short of the first flat triangle."""
        return SHORT_OF_FLAT * first_flatness(z[self.corners.T], step[self.corners.T])
