"""Widen the small angles of a map at both ends, by changing its mesh around poor triangles only."""

from __future__ import annotations

import numpy as np

from core.geometry.triangulation import split_edges, unique_edges
from core.morph.compatible.flips import flip
from core.morph.compatible.joint import JointMesh
from core.morph.compatible.nudging import nudge
from core.morph.compatible.removal import remove
from core.progress import Watch, unwatched

FAIR = 0.31
"""Quality that is aimed at. The best triangle with a smallest angle α has √3 sin α / (2 − cos α),
so no angle is below 10.4° then."""
ROUNDS, PASSES = 3, 4


def widen(mesh: JointMesh, watch: Watch = unwatched) -> JointMesh:
    """Return a mesh whose triangles are fair at both ends, or the best that was found.

    A fair mesh is returned as it is. Where flips and nudges do not suffice, vertices are taken out,
    and then long edges split. ``watch(stage)`` is called before every round and may raise
    ``Cancelled``.
    """
    best = mesh
    for _ in range(ROUNDS):
        for change in (_tended, _thinned):
            if _worst(best) >= FAIR:
                return best
            watch("angles")
            mesh = change(mesh)
            best = max(best, mesh, key=_worst)
        mesh = _split(mesh)
    return best


def _worst(mesh: JointMesh) -> float:
    return float(mesh.worse.min())


def _tended(mesh: JointMesh) -> JointMesh:
    return flip(nudge(flip(mesh, passes=3), FAIR, PASSES), passes=2)


def _thinned(mesh: JointMesh) -> JointMesh:
    """Take vertices out around poor triangles, where that leaves nothing worse."""
    poor = mesh.worst_around(mesh.worse)[mesh.tail] < FAIR
    return nudge(flip(remove(mesh, poor, np.full(len(poor), np.inf)), passes=2), FAIR, PASSES)


def _split(mesh: JointMesh) -> JointMesh:
    """Split the longest inner edge of each poor triangle."""
    edges, sides, count = unique_edges(mesh.triangles)
    length = np.where(count == 2, mesh.lengths(*edges.T), 0)
    poor = sides[mesh.worse < FAIR]
    longest = np.take_along_axis(poor, length[poor].argmax(axis=1)[:, None], axis=1)
    chosen = np.zeros(len(edges), bool)
    chosen[longest] = True
    points, triangles = split_edges(mesh.points, mesh.triangles, chosen & (count == 2))
    return JointMesh(points, triangles, mesh.boundary_size)
