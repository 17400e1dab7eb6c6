"""A mesh that fits two polygons at once without a fold, whatever their shapes.

Both polygons are triangulated without inner points, and the diagonals are laid over each other
(Aronov, Seidel and Souvaine 1993, "On compatible triangulations of simple polygons"). Which
diagonals cross, and in which order, follows from the order of their ends along the boundary alone.
Seen in either polygon, every cell of the overlay is a triangle of its own triangulation cut by
straight lines, hence convex, and any fan of triangles fills it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from core.geometry.polyline import cross
from core.geometry.triangulation import Indices, Mesh
from core.model.outline import Array
from core.morph.compatible.bridges import cut_open
from core.morph.compatible.chords import chord_sets, crossing
from core.progress import Watch, unwatched

MOST_SIDES = 6
"""Two triangles have at most a hexagon in common."""


def compatible_mesh(
    source: Sequence[Array], target: Sequence[Array], watch: Watch = unwatched
) -> tuple[Mesh, Array]:
    """Return a mesh of the source, and target positions (n, 2) of its vertices; every triangle is
    positive in both.

    The rings (k, 2) of both, exterior first, correspond vertex by vertex; exteriors run
    counter-clockwise, holes clockwise, around about unit area. Their vertices come first in the
    mesh, and its border edges are theirs. ``watch(stage)`` is called between steps and may raise
    ``Cancelled``.
    """
    watch("joint mesh")
    cut = cut_open(source, target)
    walk, b = cut.walk, len(cut.walk)
    ours, theirs = cut.source[walk], cut.target[walk]
    chords = chord_sets(ours, theirs, watch)
    watch("joint mesh")
    pairs = np.argwhere(crossing(chords.source, chords.target))
    along_source = _Crossed.of(chords.source, pairs[:, 0], chords.target[pairs[:, 1]], b)
    along_target = _Crossed.of(chords.target, pairs[:, 1], chords.source[pairs[:, 0]], b)
    points = np.vstack([cut.source, along_source.points(ours)])
    image = np.vstack([cut.target, along_target.points(theirs)])
    step = np.arange(b)
    uncrossed = np.concatenate([np.column_stack([step, np.roll(step, -1)]), chords.shared])
    halves = np.concatenate(
        [_both_ways(uncrossed, uncrossed), along_source.halves(b), along_target.halves(b)]
    )
    number = np.concatenate([walk, len(cut.source) + np.arange(len(pairs))])  # sews up the cut
    triangles = [_fans(number[cells], points, image) for cells in _cells(halves, b)]
    return Mesh(points, np.concatenate(triangles), cut.rings), image


@dataclass(frozen=True, eq=False)
class _Crossed:
    """The diagonals of one polygon with the other's crossings on them, in order."""

    chords: Indices
    """(k, 2)"""
    chord: Indices
    """(c,) the diagonal that each crossing lies on."""
    rank: Indices
    """(c,) its place on it, counted from the diagonal's first end."""

    @classmethod
    def of(cls, chords: Indices, chord: Indices, others: Indices, b: int) -> Self:
        """Sort crossings of the diagonals number ``chord`` (c,) with ``others`` (c, 2)."""
        (a, z), (p, q) = chords[chord].T, others.T
        within = (a < p) & (p < z)
        right, left = np.where(within, p, q), np.where(within, q, p)
        # the others do not cross each other, so both their ends move on from a to z
        order = np.lexsort(((a - left) % b, right, chord))
        rank = np.empty_like(chord)
        rank[order] = np.arange(len(chord)) - np.searchsorted(chord[order], chord[order])
        return cls(chords, chord, rank)

    def points(self, polygon: Array) -> Array:
        """Return the crossings (c, 2), evenly spread along the diagonals of a polygon (b, 2)."""
        count = np.bincount(self.chord, minlength=len(self.chords))
        fraction = ((self.rank + 1) / (count[self.chord] + 1))[:, None]
        start, end = polygon[self.chords[self.chord].T]
        return (1 - fraction) * start + fraction * end

    def halves(self, b: int) -> Indices:
        """Return the half-edges of the pieces, see ``_both_ways``. Crossings follow vertex b."""
        k, c = len(self.chords), len(self.chord)
        node = np.concatenate([self.chords[:, 0], b + np.arange(c), self.chords[:, 1]])
        chord = np.concatenate([np.arange(k), self.chord, np.arange(k)])
        place = np.concatenate([np.full(k, -1), self.rank, np.full(k, c)])
        order = np.lexsort((place, chord))
        node, chord = node[order], chord[order]
        piece = np.flatnonzero(chord[1:] == chord[:-1])
        return _both_ways(
            np.column_stack([node[piece], node[piece + 1]]), self.chords[chord[piece]]
        )


def _both_ways(edges: Indices, lines: Indices) -> Indices:
    """Return the half-edges (2e, 3) of edges (e, 2): tail, head, and the boundary vertex that one
    comes to going on along its line (e, 2).
    """
    return np.concatenate(
        [np.column_stack([edges, lines[:, 1]]), np.column_stack([edges[:, ::-1], lines[:, 0]])]
    )


def _cells(halves: Indices, b: int) -> list[Indices]:
    """Return the cells that half-edges enclose, as vertices (f, sides), by number of sides."""
    tail, head, leads_to = halves.T
    # lines cross at most once, so around a vertex they are in the order of their far ends
    order = np.lexsort((leads_to, tail))
    clockwise = np.empty_like(order)
    clockwise[order] = np.roll(order, 1)
    first = np.searchsorted(tail[order], np.arange(tail.max() + 2))
    clockwise[order[first[:-1]]] = order[first[1:] - 1]
    n = len(first)
    by_ends = np.argsort(tail * n + head)
    twin = by_ends[np.searchsorted((tail * n + head)[by_ends], head * n + tail)]
    following = clockwise[twin]
    inner = np.flatnonzero(~((tail == (head + 1) % b) & (tail < b) & (head < b)))
    walk = [inner]
    for _ in range(MOST_SIDES):
        walk.append(following[walk[-1]])
    path = np.column_stack(walk)
    sides = 1 + (path[:, 1:] == path[:, :1]).argmax(axis=1)
    cells = []
    for k in range(3, MOST_SIDES + 1):
        found = path[sides == k, :k]
        once = found[:, 0] == found.min(axis=1)
        cells.append(tail[found[once]])
    return cells


def _fans(cells: Indices, points: Array, image: Array) -> Indices:
    """Cut convex cells (f, k) into fans, each from the corner that leaves the largest smallest
    triangle in either polygon.
    """
    k = cells.shape[1]
    corner = np.arange(k)[:, None]
    second = np.arange(1, k - 1)
    fan = np.stack(np.broadcast_arrays(corner, corner + second, corner + second + 1), -1) % k
    triangles = cells[:, fan]  # (f, apex, k - 2, 3)
    smallest = np.minimum(_doubled(points, triangles), _doubled(image, triangles)).min(axis=2)
    best = smallest.argmax(axis=1)
    return triangles[np.arange(len(cells)), best].reshape(-1, 3)


def _doubled(points: Array, triangles: Indices) -> Array:
    a, b, c = (points[triangles[..., i]] for i in range(3))
    return cross(b - a, c - a)
