"""Bring a joint mesh to rest: as little distorted between its ends as fair angles at both allow.

The map is the same function whichever of its ends is moved, so the ends take turns and the energy
never rises. What moving the target alone leaves to a mesh that was made for the source, narrow
triangles in the target, both ends share.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core.fem.elements import Elements
from core.fem.energies import Density, Fairness, InverseDirichlet, SymmetricDirichlet
from core.fem.newton import (
    FreeVertices,
    backtrack,
    density_terms,
    energy,
    safe_length,
    step_of,
)
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.compatible.joint import JointMesh
from core.progress import Watch, unwatched

ENOUGH = 0.36
"""Quality at which a triangle asks for no more: somewhat above what is fair."""
FAIRNESS = Fairness(ENOUGH, weight=20.0)
RINGS = 3
"""How far around poor triangles vertices may move."""
TURNS, STEPS = 2, 4
"""How often each end moves, and by how many of Newton's steps."""
CONVERGED = 1e-4
"""Energy gained by a step, relative, below which an end rests."""


def settle_both(
    mesh: JointMesh, around: NDArray[np.bool_] | None = None, watch: Watch = unwatched
) -> JointMesh:
    """Return a mesh with its inner vertices at rest at both ends; it must have no fold.

    If triangles ``around`` (m,) are given, only vertices within ``RINGS`` of them move.
    ``watch(stage)`` is called before every step and may raise ``Cancelled``.
    """
    near = np.ones(len(mesh.points), bool) if around is None else _neighbourhood(mesh, around)
    near[: mesh.boundary_size] = False
    free = np.flatnonzero(near)
    if not len(free):
        return mesh
    source, target = mesh.end(0), mesh.end(1)
    triangles = mesh.triangles[near[mesh.triangles].any(axis=1)]
    vertices = FreeVertices(Elements.of(source, triangles), free)
    for _ in range(TURNS):
        target = _settled(vertices, target, source, SymmetricDirichlet(), watch)
        source = _settled(vertices, source, target, InverseDirichlet(), watch)
    return mesh.moved(np.stack([end @ [1, 1j] for end in (source, target)], axis=1))


def _neighbourhood(mesh: JointMesh, around: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return (n,) which vertices lie within a few rings of triangles (m,)."""
    near = np.zeros(len(mesh.points), bool)
    near[mesh.triangles[around]] = True
    for _ in range(RINGS):
        near[mesh.triangles[near[mesh.triangles].any(axis=1)]] = True
    return near


def _settled(
    vertices: FreeVertices, x: Array, other: Array, density: Density, watch: Watch
) -> Array:
    """Move an end's free vertices x (n, 2) while the other end (n, 2) stays."""
    triangles = vertices.elements.triangles
    rest, ideal = Elements.of(other, triangles), _equilateral(x, other, triangles)

    def objective(y: Array) -> float:
        return energy(rest, density, y) + energy(ideal, FAIRNESS, y)

    for _ in range(STEPS):
        watch("polish")
        terms = density_terms(rest, density, x) + density_terms(ideal, FAIRNESS, x)
        step = step_of(vertices, terms)
        x, after = backtrack(objective, x, step, safe_length(rest, x, step))
        if step.energy - after <= CONVERGED * abs(after):
            break
    return x


def _equilateral(x: Array, other: Array, triangles: Indices) -> Elements:
    """Return elements with equilateral rest shapes, as heavy as the triangles are at both ends."""
    one = Elements.of(np.array([[0, 0], [1, 0], [0.5, np.sqrt(0.75)]]), np.array([[0, 1, 2]]))
    areas = (Elements.of(x, triangles).areas + Elements.of(other, triangles).areas) / 2
    return Elements(triangles, len(x), areas, np.repeat(one.hats, len(triangles), axis=1))
