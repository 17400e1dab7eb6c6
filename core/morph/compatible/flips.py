"""Flip edges of a joint mesh, where that lifts the worse of the two triangles at both ends."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core.morph.compatible.joint import JointMesh, quality, worse_end

GAIN = 0.02
"""A flip must improve by this fraction, so that flipping ends."""


def flip(mesh: JointMesh, passes: int, below: float = np.inf) -> JointMesh:
    """Flip edges until nothing improves, at most ``passes`` times over all that may.

    It starts at triangles of less quality than ``below``, and goes on from those that it changed.
    """
    unsettled = mesh.worse < below
    for _ in range(passes):
        mesh, unsettled = _flip_once(mesh, unsettled)
        if not unsettled.any():
            break
    return mesh


def _flip_once(
    mesh: JointMesh, unsettled: NDArray[np.bool_]
) -> tuple[JointMesh, NDArray[np.bool_]]:
    """Flip all edges beside ``unsettled`` triangles (m,) that improve and that no better flip next
    to them forbids. Returns the triangles (m,) that this leaves unsettled, too.
    """
    first, second = mesh.twins[unsettled[mesh.twins // 3].any(axis=1)].T
    u, v = mesh.tail[first], mesh.head[first]
    left, right = mesh.apex[first], mesh.apex[second]
    before = np.minimum(mesh.worse[first // 3], mesh.worse[second // 3])
    near_u, near_v = np.column_stack([left, u, right]), np.column_stack([right, v, left])
    after = worse_end(np.minimum(quality(mesh.points, near_u), quality(mesh.points, near_v)))
    gain = after - before
    # a flip that is not convex at an end gives a negative triangle there, and is no gain
    wanted = np.flatnonzero(gain > GAIN * before)
    unsettled = np.zeros(len(mesh.triangles), bool)
    if not len(wanted):
        return mesh, unsettled
    wanted = wanted[np.argsort(-gain[wanted], kind="stable")]
    one, other = first[wanted] // 3, second[wanted] // 3
    rank = np.arange(len(wanted))
    best = np.full(len(mesh.triangles), len(wanted))
    np.minimum.at(best, one, rank)
    np.minimum.at(best, other, rank)
    free = (best[one] == rank) & (best[other] == rank)
    triangles = mesh.triangles.copy()
    triangles[one[free]] = near_u[wanted[free]]
    triangles[other[free]] = near_v[wanted[free]]
    unsettled[one] = unsettled[other] = True
    return mesh.rewired(triangles), unsettled
