"""Move single inner vertices of a joint mesh to better places, at each end by itself.

Around a vertex, the places where all triangles have at least some quality are the common part of
discs, hence convex (Amenta, Bern and Eppstein 1999, "Optimal point placement for mesh smoothing"):
whatever lifts the worst triangle leads on to the best place.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core.geometry.rotation import Complex
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.compatible.joint import JointMesh, apex_quality

STRIDES = (0.125, 0.25, 0.5, 1.0)
"""Parts of the way that are tried."""
SIXTY = np.exp(1j * np.pi / 3)


def nudge(mesh: JointMesh, fair: float, passes: int) -> JointMesh:
    """Move inner vertices beside triangles of less than ``fair`` quality, until those are fair.

    No vertex goes further than needed, and none lets the worst triangle around it get worse.
    """
    stuck = np.zeros(len(mesh.points), bool)
    for _ in range(passes):
        around = mesh.worst_around(mesh.quality)
        chosen = _chosen(mesh, around.min(axis=1), (around < fair).any(axis=1) & ~stuck)
        if not len(chosen):
            break
        points = mesh.points.copy()
        points[chosen] = _better(points[chosen], _Star(mesh, chosen), around[chosen], fair)
        stuck[chosen] = (points[chosen] == mesh.points[chosen]).all(axis=1)
        mesh = mesh.moved(points)
    return mesh


def _chosen(mesh: JointMesh, around: Array, movable: NDArray[np.bool_]) -> Indices:
    """Return the movable inner vertices (k,) that are worse off than their movable neighbours."""
    inner = mesh.boundary_size + np.flatnonzero(movable[mesh.boundary_size :])
    inner = inner[np.argsort(around[inner], kind="stable")]
    rank = np.full(len(mesh.points), len(mesh.points))
    rank[inner] = np.arange(len(inner))
    beside = rank.copy()
    np.minimum.at(beside, mesh.tail, rank[mesh.head])
    return inner[beside[inner] == rank[inner]]


class _Star:
    """The triangles around some vertices (k,), one after the other (s,)."""

    def __init__(self, mesh: JointMesh, vertices: Indices) -> None:
        order, start = mesh.stars
        size = start[vertices + 1] - start[vertices]
        self.first = np.cumsum(size) - size
        self.owner = np.repeat(np.arange(len(size)), size)
        """(s,) number of the vertex that each triangle is around."""
        spoke = order[np.arange(size.sum()) + (start[vertices] - self.first)[self.owner]]
        self.next, self.last = mesh.points[mesh.head[spoke]], mesh.points[mesh.apex[spoke]]
        self.quality = mesh.quality[spoke // 3]

    def worst(self, places: Complex) -> Array:
        """Return (k, 2) the smallest quality around vertices if they were at places (k, 2)."""
        values = apex_quality(places[self.owner], self.next, self.last)
        return np.minimum.reduceat(values, self.first)

    def mean(self, values: Complex, of: NDArray[np.bool_]) -> Complex:
        """Return (k, 2) the mean of some of the values (s, 2) around each vertex."""
        total: Complex = np.add.reduceat(np.where(of, values, 0), self.first)
        return total / np.add.reduceat(of.astype(float), self.first)


def _better(places: Complex, star: _Star, best: Array, fair: float) -> Complex:
    """Return the first places (k, 2) that are fair, or the best seen; ``best`` (k, 2) is now's.

    Vertices go towards the middle of their neighbours, and to where their worst triangle is
    equilateral.
    """
    middle = star.mean(star.next, np.ones(star.next.shape, bool))
    upright = star.next + (star.last - star.next) * SIXTY
    goals = middle, star.mean(upright, star.quality == best[star.owner])
    found = places
    for stride in STRIDES:
        for goal in goals:
            candidate = places + stride * (goal - places)
            worst = star.worst(candidate)
            lifted = (worst > best) & (best < fair)
            best, found = np.where(lifted, worst, best), np.where(lifted, candidate, found)
    return found
