"""Take inner vertices out of a joint mesh, each by drawing it into a neighbour."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.compatible.joint import JointMesh, quality, worse_end


def remove(mesh: JointMesh, unwanted: NDArray[np.bool_], fair: Array) -> JointMesh:
    """Draw inner vertices along ``unwanted`` half-edges (3m,) into their heads.

    Done where the triangles left behind are no worse than those before, or at least ``fair`` (3m,).
    Of neighbours only one goes.
    """
    edge = np.flatnonzero(unwanted & (mesh.tail >= mesh.boundary_size))
    if not len(edge):
        return mesh
    before = mesh.worst_around(mesh.worse)[mesh.tail[edge]]
    after = _worst_after(mesh, edge)
    possible = after > np.maximum(np.minimum(before, fair[edge]), 0)
    edge, after = edge[possible], after[possible]
    # the best head for each tail, and the best tails first
    edge = edge[np.argsort(-after, kind="stable")]
    tail, first = np.unique(mesh.tail[edge], return_index=True)
    rank = np.full(len(mesh.points), len(mesh.tail))
    rank[tail] = first
    beside = rank.copy()
    np.minimum.at(beside, mesh.tail, rank[mesh.head])
    go = beside[tail] == first
    return _merged(mesh, tail[go], mesh.head[edge[first[go]]])


def _worst_after(mesh: JointMesh, edge: Indices) -> Array:
    """Return (k,) the smallest quality around each half-edge's tail, once that is at its head."""
    order, start = mesh.stars
    tail, head = mesh.tail[edge], mesh.head[edge]
    size = start[tail + 1] - start[tail]
    first = np.cumsum(size) - size
    spoke = order[np.arange(size.sum()) + np.repeat(start[tail] - first, size)]
    head = np.repeat(head, size)
    fan = np.column_stack([head, mesh.head[spoke], mesh.apex[spoke]])
    vanishes = (fan[:, 1] == head) | (fan[:, 2] == head)
    worst = np.where(vanishes, np.inf, worse_end(quality(mesh.points, fan)))
    return np.minimum.reduceat(worst, first)


def _merged(mesh: JointMesh, gone: Indices, into: Indices) -> JointMesh:
    """Replace vertices by others, and number those that are left anew."""
    n = len(mesh.points)
    stays = np.ones(n, bool)
    stays[gone] = False
    number = np.cumsum(stays) - 1
    number[gone] = number[into]
    a, b, c = triangles = number[mesh.triangles].T
    whole = (a != b) & (b != c) & (c != a)
    return JointMesh(mesh.points[stays], triangles.T[whole], mesh.boundary_size)
