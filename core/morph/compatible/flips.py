"""Flip edges of a joint mesh, where that lifts the worse of the two triangles at both ends."""

from __future__ import annotations

import numpy as np

from core.morph.compatible.joint import JointMesh, quality, worse_end

GAIN = 0.02
"""A flip must improve by this fraction, so that flipping ends."""


def flip(mesh: JointMesh, passes: int) -> JointMesh:
    """Flip edges until nothing improves, at most ``passes`` times over all edges."""
    for _ in range(passes):
        flipped = _flip_once(mesh)
        if flipped is mesh:
            break
        mesh = flipped
    return mesh


def _flip_once(mesh: JointMesh) -> JointMesh:
    """Flip all edges that improve and that no better flip beside them forbids."""
    first, second = mesh.twins.T
    u, v = mesh.tail[first], mesh.head[first]
    left, right = mesh.apex[first], mesh.apex[second]
    before = np.minimum(mesh.worse[first // 3], mesh.worse[second // 3])
    near_u, near_v = np.column_stack([left, u, right]), np.column_stack([right, v, left])
    after = worse_end(np.minimum(quality(mesh.points, near_u), quality(mesh.points, near_v)))
    gain = after - before
    # a flip that is not convex at an end gives a negative triangle there, and is no gain
    wanted = np.flatnonzero(gain > GAIN * before)
    if not len(wanted):
        return mesh
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
    return mesh.rewired(triangles)
