"""Cut two outlines with holes open along corresponding bridges, so that each is one polygon.

A bridge leads from the polygon cut so far to a hole, inside the outline; the polygon then goes over
it, round the hole, and back. Where it has to go round corners it gets vertices of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order

from core.geometry.triangulation import Indices, adjacent_triangles, triangulate_polygon
from core.model.outline import Array


@dataclass(frozen=True, eq=False)
class CutOutlines:
    """Corresponding outlines, each cut open to one polygon."""

    source: Array
    """(n, 2) the rings' vertices, then those of the bridges."""
    target: Array
    """(n, 2)"""
    rings: tuple[Indices, ...]
    """Each ring as vertex indices."""
    walk: Indices
    """(w,) vertex indices of the polygon: those at bridges occur more than once."""


def cut_open(source: Sequence[Array], target: Sequence[Array]) -> CutOutlines:
    """Cut corresponding rings (k, 2) open: exterior first, holes clockwise."""
    ends = [np.concatenate(source), np.concatenate(target)]
    starts = np.cumsum([len(ring) for ring in source])[:-1]
    rings = tuple(np.split(np.arange(len(ends[0])), starts))
    walk, left = rings[0], list(rings[1:])
    while left:
        number, i, j = _nearest_hole(ends, walk, left)
        goal = len(walk) + sum(map(len, left[:number])) + j
        paths = [_path([points[ring] for ring in (walk, *left)], i, goal) for points in ends]
        count = max(map(len, paths))
        bridge = len(ends[0]) + np.arange(count - 2)
        ends = [
            np.vstack([points, _divided(path, count)[1:-1]])
            for points, path in zip(ends, paths, strict=True)
        ]
        hole = np.roll(left.pop(number), -j)
        around = [walk[: i + 1], bridge, hole, hole[:1], bridge[::-1], walk[i:]]
        walk = np.concatenate(around)
    return CutOutlines(ends[0], ends[1], rings, walk)


def _nearest_hole(
    ends: Sequence[Array], walk: Indices, holes: Sequence[Indices]
) -> tuple[int, int, int]:
    """Return a hole, and the places on the polygon and on the hole, closest at both ends."""
    best = (np.inf, 0, 0, 0)
    for number, hole in enumerate(holes):
        here, there = (
            np.linalg.norm(points[walk][:, None] - points[hole], axis=-1) for points in ends
        )
        distance = here + there
        i, j = np.unravel_index(np.argmin(distance), distance.shape)
        best = min(best, (float(distance[i, j]), number, int(i), int(j)))
    return best[1:]


def _path(rings: Sequence[Array], start: int, goal: int) -> Array:
    """Return (k, 2) a way inside rings from one of their vertices to another, ends included.

    It runs through as few triangles as possible, from the middle of one edge to the next.
    """
    triangles = triangulate_polygon(rings, np.empty((0, 2), np.int64))
    vertices = np.concatenate(rings)
    pairs = adjacent_triangles(triangles)
    at_start, at_goal = ((triangles == k).any(axis=1) for k in (start, goal))
    # one more node stands for the start, so that one search serves all triangles around it
    root = len(triangles)
    first = np.flatnonzero(at_start)
    links = np.vstack([pairs, np.column_stack([np.full(len(first), root), first])])
    graph = coo_array((np.ones(len(links)), links.T), shape=(root + 1, root + 1)).tocsr()
    order, before = breadth_first_order(graph, root, directed=False)
    node = order[at_goal[np.minimum(order, root - 1)] & (order < root)][0]
    way = [vertices[goal]]
    while (previous := before[node]) != root:
        edge = np.intersect1d(triangles[node], triangles[previous])
        way.append(vertices[edge].mean(axis=0))
        node = previous
    way.append(vertices[start])
    return np.array(way[::-1])


def _divided(path: Array, count: int) -> Array:
    """Halve the longest steps of a path (k, 2) until it has ``count`` points."""
    while len(path) < count:
        step = np.diff(path, axis=0)
        longest = int(np.argmax(np.hypot(step[:, 0], step[:, 1])))
        path = np.insert(path, longest + 1, path[longest] + step[longest] / 2, axis=0)
    return path
