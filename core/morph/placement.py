"""Interior placement: where the inner vertices go when the boundary takes the target's shape.

A harmonic map to start from, untangled if it folds, then the material's energy is brought to a
minimum by projected Newton (Song 2013, eqs. 6 and 7).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.fem.elements import Elements, determinants
from core.fem.energies import Density, StVenantKirchhoff, SymmetricDirichlet
from core.fem.newton import FreeVertices, factorise, line_search, newton_step
from core.geometry.triangulation import Mesh
from core.model import Recipe
from core.model.outline import Array
from core.morph.report import Iteration
from core.morph.untangle import VALID, untangle

MAX_STEPS = 60
CONVERGED = 1e-4
"""Energy gained by a step, relative, below which the minimum is reached."""


@dataclass(frozen=True, eq=False)
class Placed:
    """The map and its history."""

    target: Array
    """(n, 2)"""
    iterations: tuple[Iteration, ...]


def place(
    mesh: Mesh, boundary: Array, recipe: Recipe, watch: Callable[[str], None] = lambda stage: None
) -> Placed:
    """Place the interior of ``mesh`` for boundary positions (b, 2), both at about unit area.

    ``watch(stage)`` is called before every step and may raise ``Cancelled``.
    """
    elements = Elements.of(mesh.points, mesh.triangles)
    free = np.arange(mesh.boundary_size, len(mesh.points))
    history: list[Iteration] = []

    def observe(stage: str) -> Callable[[float, Array], None]:
        def note(energy: float, x: Array) -> None:
            history.append(Iteration(stage, energy, folded(elements, x)))
            watch(stage)

        return note

    watch("harmonic map")
    x = harmonic(elements, boundary)
    if not len(free):
        return Placed(x, ())
    vertices = FreeVertices(elements, free)
    if _lowest(elements, x) <= VALID:
        x = untangle(vertices, x, observe("untangle"))
    valid = _lowest(elements, x) > 0
    density = material(recipe, barrier=valid)
    if valid or recipe.material == "st-venant-kirchhoff":
        x = relax(vertices, density, x, observe(recipe.material))
    return Placed(x, tuple(history))


def harmonic(elements: Elements, boundary: Array) -> Array:
    """Return the positions (n, 2) that minimise Σ A ‖F‖², the first b being given as boundary."""
    b = len(boundary)
    matrix = elements.laplacian.tocsc()
    inner = matrix[b:, b:]
    x = np.vstack([boundary, np.zeros((elements.vertices - b, 2))])
    if inner.shape[0]:
        x[b:] = factorise(inner).solve(-(matrix[b:, :b] @ boundary))
    return x


def material(recipe: Recipe, *, barrier: bool) -> Density:
    """Return the recipe's energy; with ``barrier`` its steps never fold a triangle."""
    if recipe.material == "st-venant-kirchhoff":
        return StVenantKirchhoff(recipe.mu, recipe.lam, barrier=barrier)
    return SymmetricDirichlet()


def relax(
    vertices: FreeVertices, density: Density, x: Array, observe: Callable[[float, Array], None]
) -> Array:
    """Minimise Σ A ψ from x (n, 2) by projected Newton until it gains no more."""
    for _ in range(MAX_STEPS):
        step = newton_step(vertices, density, x)
        x, energy = line_search(vertices.elements, density, x, step)
        observe(energy, x)
        if step.energy - energy <= CONVERGED * abs(energy):
            break
    return x


def folded(elements: Elements, x: Array) -> int:
    """Count the triangles with J ≤ 0."""
    return int(np.count_nonzero(determinants(elements.deformation_gradients(x)) <= 0))


def _lowest(elements: Elements, x: Array) -> float:
    return float(determinants(elements.deformation_gradients(x)).min())
