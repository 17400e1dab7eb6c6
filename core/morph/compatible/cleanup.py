"""Joint clean-up: from any mesh that fits source and target to one that fits them well.

An overlay is first coarsened as far as it goes. Then rounds of removing, splitting, flipping,
smoothing and relaxing make the mesh even. Every step keeps all triangles positive at both ends, and
the boundary as it is.
"""

from __future__ import annotations

import numpy as np

from core.fem.elements import Elements
from core.fem.energies import SymmetricDirichlet
from core.fem.newton import FreeVertices, line_search, newton_step
from core.geometry.triangulation import Indices, unique_edges
from core.model.outline import Array
from core.morph.compatible.flips import flip
from core.morph.compatible.joint import JointMesh
from core.morph.compatible.removal import remove
from core.morph.compatible.smoothing import smooth
from core.progress import Watch, unwatched

COARSENINGS = 12
ROUNDS, RELAX_STEPS = 2, 2
POOR = 0.3
"""Around triangles of less quality, any removal that does not harm is welcome."""
POOREST = 0.2
"""Quality that coarsening may leave behind."""
SHORT, LONG = 0.6, 1.5
"""Edges below and above these fractions of the wanted size are removed and split."""
GROWTH = 0.7
"""How much longer edges may be per distance from the boundary."""
SMALLEST = 0.03
"""Least wanted size, as a fraction of the largest."""
FLAT = 1e-12
"""Where a triangle's quality is less, Newton's method would drown in rounding errors."""


def coarsen(joint: JointMesh, watch: Watch = unwatched) -> JointMesh:
    """Return a mesh with few inner vertices.

    Made for overlays, whose crossings crowd where the shapes differ most. ``watch(stage)`` is
    called before every step and may raise ``Cancelled``.
    """
    joint = flip(joint, passes=20)
    for _ in range(COARSENINGS):
        watch("clean-up")
        inner = len(joint.points) - joint.boundary_size
        everywhere = np.ones(len(joint.tail), bool)
        joint = flip(remove(joint, everywhere, np.full(len(everywhere), POOREST)), passes=3)
        joint = flip(smooth(joint), passes=3)
        if len(joint.points) - joint.boundary_size > 0.98 * inner - 1:
            break
    return joint


def improve(joint: JointMesh, max_area: float, watch: Watch = unwatched) -> JointMesh:
    """Return a better mesh of the same boundary.

    Source and target have about unit area. Inside, triangles get about ``max_area``; near short
    boundary edges they are smaller. ``watch(stage)`` is called before every round and may raise
    ``Cancelled``.
    """
    size = float(np.sqrt(max_area * 4 / np.sqrt(3)))
    for _ in range(ROUNDS):
        watch("clean-up")
        joint = smooth(_refined(_thinned(joint, size), size))
        for _ in range(2):
            joint = smooth(flip(joint, passes=3))
        joint = flip(_relaxed(flip(joint, passes=2), size), passes=3)
    return joint


def _thinned(mesh: JointMesh, size: float) -> JointMesh:
    """Remove inner vertices at short edges and around poor triangles."""
    for _ in range(3):
        wanted = _wanted_sizes(mesh, size)
        length = mesh.lengths(mesh.tail, mesh.head)
        short = length < SHORT * (wanted[mesh.tail] + wanted[mesh.head]) / 2
        poor = mesh.worst_around(mesh.worse)[mesh.tail] < POOR
        thinner = remove(mesh, short | poor, np.where(short, POOR, np.inf))
        if len(thinner.points) == len(mesh.points):
            break
        mesh = thinner
    return flip(mesh, passes=3)


def _refined(mesh: JointMesh, size: float) -> JointMesh:
    """Split the long inner edges."""
    edges, _, count = unique_edges(mesh.triangles)
    wanted = _wanted_sizes(mesh, size)[edges].mean(axis=1)
    long = (count == 2) & (mesh.lengths(*edges.T) > LONG * wanted)
    return mesh.split(long)


def _wanted_sizes(mesh: JointMesh, size: float) -> Array:
    """Return (n,) the edge length wanted at each vertex: that of the boundary, growing inwards."""
    edges, _, count = unique_edges(mesh.triangles)
    length = mesh.lengths(*edges.T)
    border = count == 1
    wanted = np.full(len(mesh.points), size)
    for corner in edges[border].T:
        np.minimum.at(wanted, corner, np.maximum(length[border], SMALLEST * size))
    (i, j), grown = edges.T, GROWTH * length
    for _ in range(8):
        before = wanted.copy()
        np.minimum.at(wanted, i, before[j] + grown)
        np.minimum.at(wanted, j, before[i] + grown)
        if (wanted == before).all():
            break
    return wanted


def _relaxed(mesh: JointMesh, size: float) -> JointMesh:
    """Bring the triangles of both ends closer to equilateral ones of the wanted size."""
    if len(mesh.points) == mesh.boundary_size or mesh.worse.min() < FLAT:
        return mesh
    ideal = _equilateral(mesh.triangles, _wanted_sizes(mesh, size))
    free = FreeVertices(ideal, np.arange(mesh.boundary_size, len(mesh.points)))
    density = SymmetricDirichlet()
    points = mesh.points.copy()
    for end in (0, 1):
        x = mesh.end(end)
        for _ in range(RELAX_STEPS):
            x, _ = line_search(ideal, density, x, newton_step(free, density, x))
        points[:, end] = x[:, 0] + 1j * x[:, 1]
    return mesh.moved(points)


def _equilateral(triangles: Indices, sizes: Array) -> Elements:
    """Return elements whose rest shapes are equilateral, sized by the vertices' (n,) wishes.

    All have the same weight.
    """
    one = Elements.of(np.array([[0, 0], [1, 0], [0.5, np.sqrt(0.75)]]), np.array([[0, 1, 2]]))
    side = sizes[triangles].mean(axis=1)
    areas = np.full(len(triangles), one.areas[0])
    return Elements(triangles, len(sizes), areas, one.hats / side)
