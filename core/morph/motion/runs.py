"""A boundary in runs of edges, long ones of shorter ones: what is far apart is told at a glance.

Of each run a disc is known that holds it, and what turns it most closely to where it is at another
moment. Runs that by this cannot come near each other are left out with all that they are made of.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from core.geometry.rotation import Complex, to_points, unit
from core.geometry.triangulation import Indices
from core.model.outline import Array

FEW = 640
"""Runs among which neighbours are found without longer ones."""
FINER = 4
"""Runs that a longer one is made of."""

Pairs = tuple[Indices, Indices]
"""Runs (p,) of which a vertex, and runs (p,) of which an edge is meant."""
Test = Callable[[int, Pairs], NDArray[np.bool_]]
"""Called with a level, 0 for the longest runs, and pairs of its runs; returns (p,) which may come
near each other. Where a pair may, the longer runs that hold it must be said to, too.
"""


@dataclass(frozen=True, eq=False)
class Discs:
    """What holds each run."""

    centre: Complex
    """(r,)"""
    radius: Array

    @classmethod
    def of(cls, corners: Complex) -> Self:
        """Take them around corners (2, r, w) of runs of w edges."""
        centre = corners.mean(axis=(0, 2))
        return cls(centre, np.abs(corners - centre[:, None]).max(axis=(0, 2)))

    def within(self, distance: float) -> Pairs:
        """Return at least the pairs of runs with places within a distance."""
        tree = cKDTree(to_points(self.centre))
        found = tree.query_pairs(distance + 2 * self.radius.max(), output_type="ndarray")
        itself = np.arange(len(self.centre))
        one, other = found.T
        return np.concatenate([one, other, itself]), np.concatenate([other, one, itself])

    def apart(self, pairs: Pairs) -> Complex:
        """Return how the centres (p,) of the ones lie from the others'."""
        one, other = pairs
        return self.centre[one] - self.centre[other]

    def least(self, pairs: Pairs) -> Array:
        """Return distances (p,) that no places of two runs fall short of; below 0 they overlap."""
        return np.abs(self.apart(pairs)) - self._radii(pairs)

    def most(self, pairs: Pairs) -> Array:
        """Return distances (p,) that no places of two runs exceed."""
        return np.abs(self.apart(pairs)) + self._radii(pairs)

    def _radii(self, pairs: Pairs) -> Array:
        one, other = pairs
        return self.radius[one] + self.radius[other]


@dataclass(frozen=True, eq=False)
class Ways:
    """How each run gets from here to there: turned as one, as far as that goes."""

    here: Discs
    there: Discs
    turn: Complex
    """(r,)"""
    stray: Array
    """(r,) how far its vertices are from where that takes them, at most."""
    bend: Array
    """(r,) how far the directions of its edges are from that."""

    @classmethod
    def of(cls, before: Complex, after: Complex) -> Self:
        """Take them between corners (2, r, w) of runs of w edges."""
        here, there = Discs.of(before), Discs.of(after)
        out, back = before - here.centre[:, None], after - there.centre[:, None]
        turn = unit((back * out.conj()).sum(axis=(0, 2)))[:, None]
        edges, later = (unit(stop - start) for start, stop in (before, after))
        stray = np.abs(back - turn * out).max(axis=(0, 2))
        return cls(here, there, turn[:, 0], stray, np.abs(later - turn * edges).max(axis=1))

    def least(self, pairs: Pairs) -> Array:
        """Return sums (p,) of both ends' distances that no places of two runs fall short of."""
        return self.here.least(pairs).clip(0) + self.there.least(pairs).clip(0)

    def closing(self, pairs: Pairs) -> Array:
        """Return how far (p,) vertices of the ones get at most, as seen from the others' edges."""
        one, other = pairs
        turn = self.turn[other]
        return (
            np.abs(self.there.apart(pairs) - turn * self.here.apart(pairs))
            + np.abs(self.turn[one] - turn) * self.here.radius[one]
            + self.bend[other] * self.here.most(pairs)
            + self.stray[one]
            + self.stray[other]
        )


class Runs:
    """The edges of a boundary; where they are many, in runs that follow each other, too."""

    def __init__(self, starts: Indices, stops: Indices) -> None:
        """Prepare for edges between vertices (n,)."""
        width, edges = 1, np.stack([starts, stops])
        while len(starts) > FEW * width:
            width *= FINER
        self._longest = _in_runs(edges, width)
        self._levels = [self._longest] if width > 1 else []
        while width > 1:
            width //= FINER
            self._levels.append(_in_runs(edges, width))

    def discs(self, z: Complex) -> list[Discs]:
        """Return where runs are at positions z (n,), the longest first; none of a small boundary's.

        What they would spare it takes less time than they do.
        """
        return [Discs.of(z[corners]) for corners in self._levels]

    def ways(self, here: Complex, there: Complex) -> list[Ways]:
        """Return how those runs get from positions to others (n,)."""
        return [Ways.of(here[corners], there[corners]) for corners in self._levels]

    def find(self, z: Complex, distance: float, test: Test) -> Pairs:
        """Return the vertices and edges, by their places, that are neighbours and pass the test.

        At least those within a distance at positions z (n,) are neighbours.
        """
        one, other = Discs.of(z[self._longest]).within(distance)
        for level, corners in enumerate(self._levels):
            if level:
                one = (FINER * one[:, None] + np.repeat(range(FINER), FINER)).ravel()
                other = (FINER * other[:, None] + np.tile(range(FINER), FINER)).ravel()
                there = np.maximum(one, other) < corners.shape[1]
                one, other = one[there], other[there]
            passed = test(level, (one, other))
            one, other = one[passed], other[passed]
        return one, other


def _in_runs(edges: Indices, width: int) -> Indices:
    """Return edges (2, n) in runs (2, r, width); the last edge fills the last run."""
    runs = -(-edges.shape[1] // width)
    places = np.minimum(np.arange(runs * width), edges.shape[1] - 1)
    return edges[:, places].reshape(2, runs, width)
