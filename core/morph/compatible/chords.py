"""Diagonals of two polygons in correspondence: as many as can be had in both.

A diagonal of one polygon may be shared if its ends see each other in the other one, too. Two
diagonals of a simple polygon cross exactly when their ends interleave along the boundary, so
diagonals that do not cross in one polygon never cross in the other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from core.geometry.polyline import cross
from core.geometry.triangulation import Indices, triangulate_polygon, unique_edges
from core.model.outline import Array
from core.progress import Watch, unwatched

TURNS = 6
MOST_CORNERS = 120
"""Ends of unshared diagonals among which more shared ones are looked for at a time."""
CLEAR = 1e-6
"""A shared diagonal stays this far from all other vertices, at unit area."""


@dataclass(frozen=True, eq=False)
class ChordSets:
    """The diagonals of one triangulation of each polygon, as pairs (k, 2) of increasing indices."""

    shared: Indices
    source: Indices
    """What only the source's triangulation has: each crosses some of the target's."""
    target: Indices


def chord_sets(source: Array, target: Array, watch: Watch = unwatched) -> ChordSets:
    """Triangulate two polygons (b, 2) without inner points, sharing as many diagonals as found.

    First they take turns: what one has and the other can have, the other must have. Then diagonals
    that neither has, but both can have, are put where most others cross. ``watch(stage)`` is called
    before every round and may raise ``Cancelled``.
    """
    shared = _negotiated(source, target, np.empty((0, 2), np.int64))
    chords = _with_shared(source, target, shared)
    while len(fresh := _best_new(source, target, chords)):
        watch("joint mesh")
        shared = _negotiated(source, target, np.concatenate([chords.shared, fresh]))
        chords = _with_shared(source, target, shared)
    return chords


def crossing(chords: Indices, others: Indices) -> NDArray[np.bool_]:
    """Return (k, l) which diagonals cross: those whose ends interleave along the boundary."""
    a, z = chords.T[:, :, None]
    p, q = others.T[:, None, :]
    return ((a < p) & (p < z) & (z < q)) | ((p < a) & (a < q) & (q < z))


def _negotiated(source: Array, target: Array, shared: Indices) -> Indices:
    """Add to shared diagonals until neither polygon's triangulation has more for the other."""
    ends = (source, target)
    for turn in range(TURNS):
        here, there = ends[turn % 2], ends[1 - turn % 2]
        fresh = _without(_diagonals(triangulate_polygon([here], shared)), shared)
        fresh = fresh[sees(there, fresh)]
        if turn and not len(fresh):
            break
        shared = np.concatenate([shared, fresh])
    return shared


def _with_shared(source: Array, target: Array, shared: Indices) -> ChordSets:
    ours, theirs = (_diagonals(triangulate_polygon([end], shared)) for end in (source, target))
    only_ours = _without(ours, theirs)
    return ChordSets(_without(ours, only_ours), only_ours, _without(theirs, ours))


def _best_new(source: Array, target: Array, chords: ChordSets) -> Indices:
    """Return diagonals that both polygons can have and that cross no shared one nor each other.

    Those that cross most others come first.
    """
    corners = np.unique(np.concatenate([chords.source, chords.target]))
    corners = corners[:: 1 + len(corners) // MOST_CORNERS]
    i, j = np.triu_indices(len(corners), 1)
    pairs = np.column_stack([corners[i], corners[j]])
    gap = pairs[:, 1] - pairs[:, 0]
    pairs = pairs[(gap > 1) & (gap < len(source) - 1)]
    pairs = _without(pairs, np.concatenate([chords.shared, chords.source, chords.target]))
    pairs = pairs[~crossing(pairs, chords.shared).any(axis=1)]
    for polygon in (source, target):
        pairs = pairs[sees(polygon, pairs)]
    saved = [crossing(pairs, only).sum(axis=1) for only in (chords.source, chords.target)]
    pairs = pairs[np.argsort(-saved[0] * saved[1], kind="stable")]
    clash = crossing(pairs, pairs)
    fits = np.ones(len(pairs), bool)
    for k in range(len(pairs)):
        if fits[k]:
            fits &= ~clash[k]
    return pairs[fits]


def sees(polygon: Array, pairs: Indices) -> NDArray[np.bool_]:
    """Return (k,) whether the ends of index pairs (k, 2) see each other inside a polygon (b, 2).

    The line of sight must stay ``CLEAR`` of all other vertices. Vertices may coincide, where the
    polygon is a cut outline.
    """
    after, before = np.roll(polygon, -1, axis=0) - polygon, np.roll(polygon, 1, axis=0) - polygon
    i, j = pairs.T
    line = polygon[j] - polygon[i]
    seen = _inside(line, after[i], before[i]) & _inside(-line, after[j], before[j])
    seen[seen] = _clear(polygon, pairs[seen])
    return seen


def _clear(polygon: Array, pairs: Indices) -> NDArray[np.bool_]:
    """Whether the segments between vertices come near nothing but the edges at their ends."""
    lines = shapely.linestrings(polygon[pairs])
    corners = np.stack([polygon, np.roll(polygon, -1, axis=0)], axis=1)
    tree = shapely.STRtree(shapely.linestrings(corners))
    line, edge = tree.query(lines, predicate="dwithin", distance=CLEAR)
    own = (corners[edge][:, :, None] == polygon[pairs[line]][:, None]).all(axis=-1).any(axis=-1)
    blocked = ~own.any(axis=1)
    # an edge at an end of the segment may still lie along it
    mixed = np.flatnonzero(own[:, 0] != own[:, 1])
    far = np.where(own[mixed, :1], corners[edge[mixed], 1], corners[edge[mixed], 0])
    blocked[mixed] = shapely.dwithin(shapely.points(far), lines[line[mixed]], CLEAR)
    clear = np.ones(len(pairs), bool)
    clear[line[blocked]] = False
    return clear


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
