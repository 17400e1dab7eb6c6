"""A mesh drawn twice, in the source and in the target: what the joint clean-up works on.

Points are complex numbers, one column an end, so that one line of arithmetic serves both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from core.geometry.rotation import Complex, to_complex
from core.geometry.triangulation import Indices, Mesh, split_edges, unique_edges
from core.model.outline import Array

EDGES = "tail", "head", "apex", "twins", "stars"
"""What depends on the triangles alone."""
TINY = 1e-300
"""Keeps the quality of a triangle without any extent 0."""


@dataclass(frozen=True, eq=False)
class JointMesh:
    """Triangles that are positive at both ends. Boundary vertices come first and never move.

    Its border may be cut into shorter edges, but stays where it is.
    """

    points: Complex
    """(n, 2) each vertex in the source and in the target."""
    triangles: Indices
    """(m, 3)"""
    boundary_size: int

    @classmethod
    def of(cls, mesh: Mesh, target: Array) -> Self:
        """Join a mesh of the source and target positions (n, 2)."""
        points = np.stack([to_complex(mesh.points), to_complex(target)], axis=1)
        return cls(points, mesh.triangles, mesh.boundary_size)

    def moved(self, points: Complex) -> JointMesh:
        """Return it with other points. What is known of its edges stays known."""
        other = JointMesh(points, self.triangles, self.boundary_size)
        other.__dict__.update(
            (name, self.__dict__[name]) for name in EDGES if name in self.__dict__
        )
        return other

    def rewired(self, triangles: Indices) -> JointMesh:
        """Return it with other triangles."""
        return JointMesh(self.points, triangles, self.boundary_size)

    def split(self, chosen: NDArray[np.bool_]) -> JointMesh:
        """Return it with edges (e,), as ``unique_edges`` numbers them, split at their midpoints.

        Vertices keep their numbers, but for inner ones where border edges are split.
        """
        n, b = len(self.points), self.boundary_size
        points, triangles = split_edges(self.points, self.triangles, chosen)
        _, _, count = unique_edges(self.triangles)
        border = count[chosen] == 1
        middle = np.arange(n, len(points))
        order = np.concatenate([np.arange(b), middle[border], np.arange(b, n), middle[~border]])
        number = np.empty_like(order)
        number[order] = np.arange(len(order))
        return JointMesh(points[order], number[triangles], b + int(np.count_nonzero(border)))

    def end(self, which: int) -> Array:
        """Return positions (n, 2) in the source (0) or the target (1)."""
        z = self.points[:, which]
        return np.column_stack([z.real, z.imag])

    def apart(self, rings: tuple[Indices, ...]) -> tuple[Mesh, Array]:
        """Return the mesh of the source and the target positions (n, 2).

        ``rings`` are those that it had before border edges were split.
        """
        if sum(map(len, rings)) < self.boundary_size:
            rings = self._rings([int(ring[0]) for ring in rings])
        return Mesh(self.end(0), self.triangles, rings), self.end(1)

    def _rings(self, starts: Sequence[int]) -> tuple[Indices, ...]:
        """Follow the border from vertices on it."""
        border = np.ones(len(self.tail), bool)
        border[self.twins] = False
        after = dict(zip(self.tail[border].tolist(), self.head[border].tolist(), strict=True))
        rings = []
        for start in starts:
            ring = [start]
            while (following := after[ring[-1]]) != start:
                ring.append(following)
            rings.append(np.array(ring))
        return tuple(rings)

    @cached_property
    def quality(self) -> Array:
        """(m, 2) of the triangles, see ``quality``."""
        return quality(self.points, self.triangles)

    @cached_property
    def worse(self) -> Array:
        """(m,) the lower quality of both ends."""
        return worse_end(self.quality)

    @cached_property
    def tail(self) -> Indices:
        """(3m,) start of each half-edge; number 3t + k leads from corner k of t to the next."""
        return self.triangles.ravel()

    @cached_property
    def head(self) -> Indices:
        """(3m,) end of each half-edge."""
        return self.triangles[:, [1, 2, 0]].ravel()

    @cached_property
    def apex(self) -> Indices:
        """(3m,) the corner opposite each half-edge."""
        return self.triangles[:, [2, 0, 1]].ravel()

    @cached_property
    def twins(self) -> Indices:
        """(k, 2) pairs of half-edges that are one inner edge."""
        low, high = np.minimum(self.tail, self.head), np.maximum(self.tail, self.head)
        key = low * len(self.points) + high
        order = _sorting(key)
        same = np.flatnonzero(key[order[1:]] == key[order[:-1]])
        return np.column_stack([order[same], order[same + 1]])

    @cached_property
    def stars(self) -> tuple[Indices, Indices]:
        """Half-edges (3m,) sorted by tail, and (n + 1,) where each vertex's begin."""
        order = _sorting(self.tail)
        return order, np.searchsorted(self.tail[order], np.arange(len(self.points) + 1))

    def worst_around(self, values: Array) -> Array:
        """Return (n, ...) the smallest of triangle values (m, ...) around each vertex."""
        order, start = self.stars
        return np.minimum.reduceat(values[order // 3], start[:-1])

    def lengths(self, i: Indices, j: Indices) -> Array:
        """Return distances between vertices (k,) and (k,): the root mean square of both ends."""
        away = self.points[i] - self.points[j]
        return np.sqrt((away.real**2 + away.imag**2).mean(axis=1))


def quality(points: Complex, triangles: Indices) -> Array:
    """Return (..., 2) how equilateral triangles (..., 3) are at each end.

    1 for an equilateral triangle, towards 0 for a flat one, negative for a folded one: the area
    over the sum of the squared sides, scaled.
    """
    return apex_quality(*(np.take(points, triangles[..., k], axis=0) for k in range(3)))


def apex_quality(a: Complex, b: Complex, c: Complex) -> Array:
    """Return ``quality`` (...) of triangles with the corners a, b and c."""
    u, v = b - a, c - a
    product = np.conj(u) * v
    sides = u.real**2 + u.imag**2 + v.real**2 + v.imag**2 - product.real
    return np.sqrt(3) * product.imag / np.maximum(sides, TINY)


def worse_end(values: Array) -> Array:
    """Return (...) the lower of both ends' values (..., 2)."""
    return np.minimum(values[..., 0], values[..., 1])


def _sorting(keys: Indices) -> Indices:
    """Return the indices (k,) that sort keys, equal ones by index.

    Key and index are sorted as one number, which is several times faster than a stable argsort.
    """
    count = len(keys)
    return np.sort(keys * count + np.arange(count)) % count
