"""Triangulation of the inside of an outline: the one door to the ``triangle`` library.

Only rings that have passed ``core.geometry.validate`` may come here: on repeated vertices, crossing
segments or numbers that are not finite the library crashes or answers nonsense.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from shapely import Polygon

from core.errors import SolveError
from core.geometry.orientation import orientations
from core.model.outline import Array

Indices = NDArray[np.int64]
Points = TypeVar("Points", NDArray[np.float64], NDArray[np.complex128])

MIN_ANGLE = 30
"""Degrees. The refinement is proved to end up to 20.7 and ends in practice to 33."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles, all positively oriented; boundary vertices come first, ring after ring."""

    points: Array
    """(n, 2)"""
    triangles: Indices
    """(m, 3)"""
    rings: tuple[Indices, ...]
    """Each ring as vertex indices, in order."""

    @property
    def boundary_size(self) -> int:
        """How many vertices lie on the boundary: they are the first ones."""
        return sum(len(ring) for ring in self.rings)


def triangulate(rings: Sequence[Array], max_area: float) -> Mesh:
    """Triangulate the inside of clean rings (exterior first), by constrained Delaunay refinement.

    Boundary vertices and edges stay as given. ``max_area`` bounds the triangles.
    """
    import triangle  # loading it is slow, and only solving needs it

    boundary = np.concatenate(rings)
    indices, segments, start = [], [], 0
    for ring in rings:
        index = np.arange(start, start + len(ring))
        indices.append(index)
        segments.append(np.column_stack([index, np.roll(index, -1)]))
        start += len(ring)
    planar = {"vertices": boundary, "segments": np.concatenate(segments)}
    if len(rings) > 1:
        planar["holes"] = np.array(
            [Polygon(ring).representative_point().coords[0] for ring in rings[1:]]
        )
    result = triangle.triangulate(planar, f"pYYq{MIN_ANGLE}a{max_area:.15f}")
    points, triangles = result["vertices"], result["triangles"].astype(np.int64)
    if not np.array_equal(points[: len(boundary)], boundary):
        raise _untriangulable()
    return Mesh(points, _oriented(points, triangles), tuple(indices))


def triangulate_polygon(rings: Sequence[Array], diagonals: Indices) -> Indices:
    """Triangulate the inside of rings without new vertices, by constrained Delaunay.

    Returns (m, 3) numbers of ring vertices, counted through all rings. ``diagonals`` (k, 2) are
    pairs of them that must become edges. A ring may run along an edge twice, there and back, as one
    does that cuts an outline open: a triangle then has the corners of its own side of the cut.
    """
    import triangle  # loading it is slow, and only solving needs it

    places, number = np.unique(np.concatenate(rings), axis=0, return_inverse=True)
    ends = np.split(number, np.cumsum([len(ring) for ring in rings])[:-1])
    edges = np.concatenate([np.column_stack([end, np.roll(end, -1)]) for end in ends])
    segments = np.unique(np.sort(np.concatenate([edges, number[diagonals]]), axis=1), axis=0)
    result = triangle.triangulate({"vertices": places, "segments": segments}, "p")
    corners = _ring_corners(result["triangles"].astype(np.int64), edges)
    corners = corners[(corners >= 0).all(axis=1)]
    if len(result["vertices"]) != len(places) or len(corners) != len(number) + 2 * len(rings) - 4:
        raise _untriangulable()
    return corners


def _ring_corners(triangles: Indices, edges: Indices) -> Indices:
    """Return (m, 3) at which ring vertex each triangle's corners lie; -1 outside.

    ``edges`` (b, 2) are the rings' directed edges, one from each ring vertex, by the vertex numbers
    that ``triangles`` use. Corners belong together when they meet across any other edge.
    """
    n = int(triangles.max()) + 1
    tail = triangles.ravel()
    head = np.roll(triangles, -1, axis=1).ravel()
    key = tail * n + head
    order = np.argsort(key)
    border = np.concatenate([edges @ [n, 1], edges @ [1, n]])
    inner = np.flatnonzero(~np.isin(key, border) & np.isin(head * n + tail, key))
    twin = order[np.searchsorted(key, (head * n + tail)[inner], sorter=order)]
    following = np.arange(len(tail)) + np.tile([1, 1, -2], len(triangles))
    # across an edge its tail meets the twin's head
    graph = coo_array((np.ones(len(inner)), (inner, following[twin])), shape=(len(tail),) * 2)
    count, corner = connected_components(graph, directed=False)
    index = np.full(count, -1)
    _, start, side = np.intersect1d(edges @ [n, 1], key, return_indices=True)
    index[corner[side]] = start
    return index[corner].reshape(-1, 3)


def split_chords(mesh: Mesh) -> Mesh:
    """Split every interior edge between two boundary vertices at its midpoint.

    A chord's image is fixed by the boundary alone and may leave the target; and a corner that
    becomes reflex needs two triangles. Split, both are free to move.
    """
    edges, _, count = unique_edges(mesh.triangles)
    chord = (count == 2) & (edges < mesh.boundary_size).all(axis=1)
    return Mesh(*split_edges(mesh.points, mesh.triangles, chord), mesh.rings)


def split_edges(
    points: Points, triangles: Indices, chosen: NDArray[np.bool_]
) -> tuple[Points, Indices]:
    """Split edges at their midpoints: new points and triangles.

    ``chosen`` (e,) marks the edges as ``unique_edges`` numbers them. Points (n, d) may be of any
    dimension, also complex.
    """
    edges, sides, _ = unique_edges(triangles)
    middle = np.full(len(edges), -1)
    middle[chosen] = len(points) + np.arange(np.count_nonzero(chosen))
    points = np.concatenate([points, points[edges[chosen]].mean(axis=1)])
    return points, _split(points, triangles, middle[sides])


def _untriangulable() -> SolveError:
    return SolveError(
        "The outline could not be triangulated with its own vertices.",
        hint="Look for nodes that almost touch another edge and move them apart.",
    )


def unique_edges(triangles: Indices) -> tuple[Indices, Indices, Indices]:
    """Return edges (e, 2), each triangle's edges (m, 3), and triangles per edge (e,).

    Edge j of a triangle lies opposite its corner j.
    """
    i, j = triangles[:, [1, 2, 0]].ravel(), triangles[:, [2, 0, 1]].ravel()
    low, high = np.minimum(i, j), np.maximum(i, j)
    sides = len(low)
    # an edge and the place of each of its sides are sorted as one number: faster than np.unique
    number = np.sort((low * (int(triangles.max()) + 1) + high) * sides + np.arange(sides))
    edge, place = np.divmod(number, sides)
    new = np.append(True, edge[1:] != edge[:-1])
    first = np.flatnonzero(new)
    inverse = np.empty(sides, np.int64)
    inverse[place] = np.cumsum(new) - 1
    edges = np.column_stack([low[place[first]], high[place[first]]])
    return edges, inverse.reshape(-1, 3), np.diff(first, append=sides)


def adjacent_triangles(triangles: Indices) -> Indices:
    """Return (k, 2) the pairs of triangles that share an edge."""
    _, sides, count = unique_edges(triangles)
    order = np.argsort(sides.ravel(), kind="stable")
    shared = order[np.repeat(count == 2, count)]
    return (shared // 3).reshape(-1, 2)


def boundary_rings(triangles: Indices) -> list[Indices]:
    """Return the rings of vertices (k,) around triangles (m, 3), with the inside to their left."""
    tail, head = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    n = int(triangles.max()) + 1
    single = ~np.isin(tail * n + head, head * n + tail)
    after = dict(zip(tail[single].tolist(), head[single].tolist(), strict=True))
    rings = []
    while after:
        start, following = after.popitem()
        ring = [start]
        while following != start:
            ring.append(following)
            following = after.pop(following)
        rings.append(np.array(ring))
    return rings


def _split(points: Points, triangles: Indices, middle: Indices) -> Indices:
    """Cut triangles at the midpoints of their edges; ``middle`` (m, 3) holds -1 for uncut ones."""
    cuts = (middle >= 0).sum(axis=1)
    parts = [triangles[cuts == 0]]
    for number in (1, 2, 3):
        rows = np.flatnonzero(cuts == number)
        # turn each triangle so that the odd edge out is the one opposite corner 0
        odd = (middle[rows] >= 0) if number == 1 else (middle[rows] < 0)
        turn = odd.argmax(axis=1)[:, None]
        corner = np.take_along_axis(triangles[rows], (turn + np.arange(3)) % 3, axis=1)
        cut = np.take_along_axis(middle[rows], (turn + np.arange(3)) % 3, axis=1)
        (a, b, c), (p, q, r) = corner.T, cut.T  # p lies on bc, q on ca, r on ab
        if number == 1:
            pieces = [(a, b, p), (a, p, c)]
        elif number == 2:
            # the quadrilateral r b c q takes its shorter diagonal
            short = _distance(points, r, c) <= _distance(points, b, q)
            pieces = [
                (a, r, q),
                (r, b, np.where(short, c, q)),
                (np.where(short, r, b), c, q),
            ]
        else:
            pieces = [(a, r, q), (r, b, p), (q, p, c), (p, q, r)]
        parts += [np.column_stack(piece) for piece in pieces]
    return np.concatenate(parts)


def _distance(points: Points, i: Indices, j: Indices) -> Array:
    away = points[i] - points[j]
    return np.sqrt((away * away.conj()).real.sum(axis=1))


def _oriented(points: Array, triangles: Indices) -> Indices:
    sign = orientations(points, triangles)
    triangles[sign < 0] = triangles[sign < 0][:, [0, 2, 1]]
    return triangles[sign != 0]
