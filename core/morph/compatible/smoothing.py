"""Move the inner vertices of a joint mesh among their neighbours, at each end by itself."""

from __future__ import annotations

import numpy as np

from core.morph.compatible.joint import JointMesh, quality

GOOD = 0.4
"""Triangles may get worse down to this quality; below it, none worse than the worst beside it."""
HALVINGS = 4


def smooth(mesh: JointMesh) -> JointMesh:
    """Move each inner vertex towards the mean of its neighbours, as far as quality allows."""
    n, b = len(mesh.points), mesh.boundary_size
    towards = np.empty_like(mesh.points)
    # an inner vertex meets each neighbour once as the head of a half-edge
    count = np.bincount(mesh.tail, minlength=n)
    for end in (0, 1):
        z = mesh.points[mesh.head, end]
        towards[:, end] = np.bincount(mesh.tail, z.real, n) + 1j * np.bincount(mesh.tail, z.imag, n)
    step = towards / count[:, None] - mesh.points
    step[:b] = 0
    around = mesh.worst_around(mesh.quality)
    allowed = np.minimum(GOOD, around[mesh.triangles].min(axis=1))
    fraction = np.ones((n, 2))
    halvings = 0
    while True:
        points = mesh.points + fraction * step
        spoilt, at = np.nonzero(quality(points, mesh.triangles) < allowed)
        if not len(spoilt):
            return mesh.moved(points)
        corners = mesh.triangles[spoilt].ravel()
        ends = np.repeat(at, 3)
        if halvings < HALVINGS:
            fraction[corners, ends] /= 2
        else:
            fraction[corners, ends] = 0
        halvings += 1
