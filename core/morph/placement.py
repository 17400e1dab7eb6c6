"""Interior placement: where the inner vertices go when the boundary takes the target's shape.

A harmonic map to start from, untangled if it folds, then the material's energy is brought to a
minimum by projected Newton (Song 2013, eqs. 6 and 7).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from core.fem.elements import Elements
from core.fem.energies import Density, Dirichlet, StVenantKirchhoff, SymmetricDirichlet
from core.fem.newton import FreeVertices, line_search, newton_step
from core.geometry.triangulation import Mesh
from core.model import Recipe
from core.model.outline import Array
from core.morph.report import Iteration
from core.morph.untangle import VALID, untangle
from core.progress import Watch, unwatched

MAX_STEPS = 60
CONVERGED = 1e-4
"""Energy gained by a step, relative, below which the minimum is reached."""


@dataclass(frozen=True, eq=False)
class Placed:
    """The map and its history."""

    target: Array
    """(n, 2)"""
    iterations: tuple[Iteration, ...]


def place(mesh: Mesh, boundary: Array, recipe: Recipe, watch: Watch = unwatched) -> Placed:
    """Place the interior of ``mesh`` for boundary positions (b, 2), both at about unit area.

    ``watch(stage)`` is called before every step and may raise ``Cancelled``.
    """
    watch("harmonic map")
    problem = _Problem(mesh, watch)
    if not len(problem.free):
        return Placed(boundary, ())
    x = harmonic(problem.vertices, boundary)
    if problem.lowest(x) <= VALID:
        x = untangle(problem.vertices, x, problem.observe("untangle"))
    return problem.settled(x, recipe)


def settle(mesh: Mesh, x: Array, recipe: Recipe, watch: Watch = unwatched) -> Placed:
    """Bring the material's energy to its minimum from positions x (n, 2) without folds."""
    return _Problem(mesh, watch).settled(x, recipe)


class _Problem:
    """The free vertices of a mesh, and the history of moving them."""

    def __init__(self, mesh: Mesh, watch: Watch) -> None:
        self.elements = Elements.of(mesh.points, mesh.triangles)
        self.free = np.arange(mesh.boundary_size, len(mesh.points))
        self._watch = watch
        self._history: list[Iteration] = []

    @cached_property
    def vertices(self) -> FreeVertices:
        return FreeVertices(self.elements, self.free)

    def lowest(self, x: Array) -> float:
        """Return the smallest J of positions x (n, 2)."""
        return float(self.elements.determinants(x).min())

    def observe(self, stage: str) -> Callable[[float, Array], None]:
        def note(energy: float, x: Array) -> None:
            self._history.append(Iteration(stage, energy, folded(self.elements, x)))
            self._watch(stage)

        return note

    def settled(self, x: Array, recipe: Recipe) -> Placed:
        sound = self.lowest(x) > 0
        if len(self.free) and (sound or recipe.material == "st-venant-kirchhoff"):
            density = material(recipe, barrier=sound)
            x = relax(self.vertices, density, x, self.observe(recipe.material))
        return Placed(x, tuple(self._history))


def harmonic(vertices: FreeVertices, boundary: Array) -> Array:
    """Return the positions (n, 2) that minimise Σ A ‖F‖², the first b being given as boundary."""
    x = np.zeros((vertices.elements.vertices, 2))
    x[: len(boundary)] = boundary
    return x + newton_step(vertices, Dirichlet(), x).direction


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
    return int(np.count_nonzero(elements.determinants(x) <= 0))
