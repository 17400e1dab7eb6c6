"""Diagonals of two polygons in correspondence: as many as can be had in both.

A diagonal of one polygon may be shared if its ends see each other in the other one, too. Two
diagonals of a simple polygon cross exactly when their ends interleave along the boundary, so
diagonals that do not cross in one polygon never cross in the other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.geometry.polyline import cross
from core.geometry.triangulation import Indices, triangulate_polygon, unique_edges
from core.model.outline import Array

TURNS = 6
CLEAR = 1e-6
"""A shared diagonal stays this far from all other vertices, at unit area."""


@dataclass(frozen=True, eq=False)
class ChordSets:
    """The diagonals of one triangulation of each polygon, as pairs (k, 2) of increasing indices."""

    shared: Indices
    source: Indices
    """What only the source's triangulation has; each crosses some of the target's."""
    target: Indices


def chord_sets(source: Array, target: Array) -> ChordSets:
    """Triangulate two polygons (b, 2) without inner points, with as many shared diagonals as found.

    They take turns: what one has and the other can have, the other must have.
    """
    ends = (source, target)
    shared = np.empty((0, 2), np.int64)
    chords = [_diagonals(triangulate_polygon(end, shared)) for end in ends]
    for turn in range(TURNS):
        here, there = turn % 2, 1 - turn % 2
        fresh = _without(chords[here], shared)
        fresh = fresh[sees(ends[there], fresh)]
        if turn > 1 and not len(fresh):
            break
        shared = np.concatenate([shared, fresh])
        chords[there] = _diagonals(triangulate_polygon(ends[there], shared))
    only_source, only_target = (_without(chords[i], chords[1 - i]) for i in (0, 1))
    return ChordSets(_without(chords[0], only_source), only_source, only_target)


def sees(polygon: Array, pairs: Indices) -> NDArray[np.bool_]:
    """Return (k,) whether the ends of index pairs (k, 2) see each other inside a polygon (b, 2).

    The line of sight must stay ``CLEAR`` of all other vertices. Vertices may coincide, where the
    polygon is a cut outline.
    """
    after, before = np.roll(polygon, -1, axis=0), np.roll(polygon, 1, axis=0)
    i, j = pairs.T
    a, c = polygon[i], polygon[j]
    line = c - a
    length = np.hypot(line[:, 0], line[:, 1])[:, None]
    from_a, from_c = polygon - a[:, None], polygon - c[:, None]
    height = cross(line[:, None], from_a) / length
    along = (line[:, None] * from_a).sum(axis=-1) / length
    own = ~from_a.any(axis=-1) | ~from_c.any(axis=-1)
    touched = (np.abs(height) < CLEAR) & (along > -CLEAR) & (along < length + CLEAR) & ~own
    # two segments cross if each lies on both sides of the other; edge k runs from vertex k
    edge = after - polygon
    beside = height * np.roll(height, -1, axis=1) <= 0
    crossed = beside & (cross(edge, from_a) * cross(edge, from_c) <= 0)
    crossed &= ~(own | np.roll(own, -1, axis=1))
    leaves = _inside(line, after[i] - a, before[i] - a)
    arrives = _inside(-line, after[j] - c, before[j] - c)
    return leaves & arrives & ~(touched | crossed).any(axis=1)


def _inside(direction: Array, after: Array, before: Array) -> NDArray[np.bool_]:
    """Whether directions (k, 2) point between the edges to the next and the previous vertex."""
    left, right = cross(after, direction) > 0, cross(direction, before) > 0
    return np.where(cross(after, before) > 0, left & right, left | right)


def _diagonals(triangles: Indices) -> Indices:
    """Return the edges (k, 2) of triangles that are not edges of the polygon."""
    edges, _, count = unique_edges(triangles)
    return edges[count == 2]


def _without(chords: Indices, others: Indices) -> Indices:
    n = int(chords.max(initial=0)) + 1
    known = others[(others < n).all(axis=1)]
    return chords[~np.isin(chords @ [n, 1], known @ [n, 1])]
