"""Where rings meet themselves or each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from shapely import STRtree

from core.geometry.mending import BeyondRepair
from core.geometry.polyline import cross
from core.geometry.triangulation import Indices
from core.model.outline import Array

TOUCH = 1e-9
"""Parts of an outline that are closer than this touch."""
MOST_CROSSINGS = 64
"""Crossings beyond which an outline is a scribble."""
BATCH = 64
"""Edges that are looked at together, so that a scribble is known before all of it is."""

Pairs = tuple[Indices, Indices]
"""Two arrays (k,) of what belongs together."""


def separate(rings: Sequence[Array]) -> bool:
    """Whether no two parts of rings (n, 2) at unit size touch, unless as neighbours."""
    return len(Edges(rings).touches()[0]) == 0


def merged(points: Array) -> Indices:
    """Return (n,) the first of all points (n, 2) that touch each."""
    spots = shapely.points(points)
    pairs = STRtree(spots).query(spots, predicate="dwithin", distance=TOUCH)
    graph = coo_array((np.ones(pairs.shape[1]), tuple(pairs)), shape=(len(points),) * 2)
    _, label = connected_components(graph, directed=False)
    _, first = np.unique(label, return_index=True)
    return first[label]


class Edges:
    """The edges of all rings, numbered by the vertex they start from."""

    def __init__(self, rings: Sequence[Array]) -> None:
        self.start = np.concatenate(rings)
        """(n, 2)"""
        first = np.cumsum([0, *map(len, rings)])
        each = np.split(np.arange(first[-1]), first[1:-1])
        self.after = np.concatenate([np.roll(ring, -1) for ring in each])
        """(n,) the edge, or vertex, that follows each."""
        self._before = np.concatenate([np.roll(ring, 1) for ring in each])
        self.end = self.start[self.after]
        """(n, 2)"""
        self._segments = shapely.linestrings(np.stack([self.start, self.end], axis=1))
        self._tree = STRtree(self._segments)

    def touches(self) -> Pairs:
        """Return vertices (k,) and the edges (k,) of others that they touch."""
        points = shapely.points(self.start)
        vertex, edge = self._tree.query(points, predicate="dwithin", distance=TOUCH)
        apart = (edge != vertex) & (self.after[edge] != vertex)
        return vertex[apart], edge[apart]

    def crossings(self, touches: Pairs) -> Pairs:
        """Return pairs of edges that cross, each once, and touch with no end of either.

        BeyondRepair for a scribble.
        """
        found: list[Indices] = []
        for part in np.array_split(np.arange(len(self.start)), 1 + len(self.start) // BATCH):
            first, second = self._tree.query(self._segments[part], predicate="crosses")
            found.append(np.stack([part[first], second]))
            if sum(pairs.shape[1] for pairs in found) > 2 * MOST_CROSSINGS:
                raise BeyondRepair
        first, second = np.concatenate(found, axis=1)
        once = first < second
        first, second = first[once], second[once]
        vertex, edge = touches
        near = [self._pair(edge, end) for end in (vertex, self._before[vertex])]
        inner = ~np.isin(self._pair(first, second), np.concatenate(near))
        return first[inner], second[inner]

    def within(self, touches: Pairs) -> Pairs:
        """Return the touches that are not at an end of the edge."""
        vertex, edge = touches
        inner = np.ones(len(vertex), bool)
        for end in (self.start, self.end):
            inner &= np.hypot(*(self.start[vertex] - end[edge]).T) > TOUCH
        return vertex[inner], edge[inner]

    def along(self, touches: Pairs) -> Array:
        """Return (k,) at which fraction of its edge each vertex touches it."""
        vertex, edge = touches
        away, whole = self.start[vertex] - self.start[edge], self.end[edge] - self.start[edge]
        return np.einsum("ij,ij->i", away, whole) / np.einsum("ij,ij->i", whole, whole)

    def crossing_points(self, crossings: Pairs) -> tuple[Array, Array, Array]:
        """Return (k, 2) where pairs of edges cross, and at which fraction (k,) of either."""
        p, q = (self.start[edge] for edge in crossings)
        d, e = (self.end[edge] - self.start[edge] for edge in crossings)
        u, v = cross(q - p, e) / cross(d, e), cross(q - p, d) / cross(d, e)
        return p + u[:, None] * d, u, v

    def _pair(self, a: Indices, b: Indices) -> NDArray[np.int64]:
        """Return (k,) one number for each pair of edges, whichever comes first."""
        return np.minimum(a, b) * len(self.start) + np.maximum(a, b)
