"""Widen the small angles of a map at both ends, by changing its mesh around poor triangles only."""

from __future__ import annotations

import numpy as np

from core.geometry.triangulation import unique_edges
from core.morph.compatible.flips import flip
from core.morph.compatible.joint import JointMesh
from core.morph.compatible.nudging import nudge
from core.morph.compatible.removal import remove
from core.progress import Watch, unwatched

FAIR = 0.31
"""Quality that is aimed at. The best triangle with a smallest angle α has √3 sin α / (2 − cos α),
so no angle is below 10.4° then."""
ROUNDS, PASSES = 2, 4


def widen(mesh: JointMesh, aim: float = FAIR, watch: Watch = unwatched) -> JointMesh:
    """Return a mesh whose triangles all have the quality aimed at, or the best that was found.

    A mesh that has it is returned as it is. Where flips and nudges do not suffice, vertices are
    taken out, and then long edges split. ``watch(stage)`` is called before every round and may
    raise ``Cancelled``.
    """
    best = mesh
    for _ in range(ROUNDS):
        for change in (_tended, _thinned):
            if _worst(best) >= aim:
                return best
            watch("angles")
            mesh = change(mesh, aim)
            best = max(best, mesh, key=lambda each: (_worst(each), -_poor(each, aim)))
        mesh = _split(mesh, aim)
    return best


def _worst(mesh: JointMesh) -> float:
    return float(mesh.worse.min())


def _poor(mesh: JointMesh, aim: float) -> float:
    """By how much triangles miss the quality aimed at, in sum."""
    return float(np.maximum(aim - mesh.worse, 0).sum())


def _tended(mesh: JointMesh, aim: float) -> JointMesh:
    return flip(nudge(flip(mesh, 3, below=aim), aim, PASSES), 2, below=aim)


def _thinned(mesh: JointMesh, aim: float) -> JointMesh:
    """Take vertices out around poor triangles, where that leaves nothing worse."""
    poor = mesh.worst_around(mesh.worse)[mesh.tail] < aim
    thinner = remove(mesh, poor, np.full(len(poor), np.inf))
    return nudge(flip(thinner, 2, below=aim), aim, PASSES)


def _split(mesh: JointMesh, aim: float) -> JointMesh:
    """Split the edge of each poor triangle that is longest where the triangle is poorest."""
    edges, sides, _ = unique_edges(mesh.triangles)
    length = np.abs(mesh.points[edges[:, 0]] - mesh.points[edges[:, 1]])
    poor = mesh.worse < aim
    end = mesh.quality[poor].argmin(axis=1)[:, None]
    longest = length[sides[poor], end].argmax(axis=1)[:, None]
    chosen = np.zeros(len(edges), bool)
    chosen[np.take_along_axis(sides[poor], longest, axis=1)] = True
    return mesh.split(chosen)
