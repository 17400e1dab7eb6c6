"""Ways to place the inside of a mesh whose boundary is given: ours and those of public peers.

mouette untangles as we do (Garanzha et al. 2021), by L-BFGS. libigl's SLIM lowers the same energy
as our polish (Rabinovich et al. 2017), with the boundary held by a penalty.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from time import perf_counter

import numpy as np

from core.fem.elements import Elements
from core.fem.energies import SymmetricDirichlet
from core.fem.newton import FreeVertices
from core.geometry.polyline import signed_area
from core.geometry.triangulation import Mesh, split_chords, triangulate
from core.model import Recipe
from core.model.recipe import LEAST_DENSITY
from core.morph.pipeline import solve_outlines
from core.morph.placement import CONVERGED, MAX_STEPS, harmonic, relax
from core.morph.quality import distortion
from core.morph.untangle import untangle
from tests.benchmarks.pairs import Pair

ROUNDS = 4
"""Of untangling, where the first gives up."""
SOFT = 1e5
"""SLIM's penalty for boundary vertices: libigl's own default."""


@dataclass(frozen=True, eq=False)
class Task:
    """A mesh of the source and where its boundary belongs, both at unit area."""

    mesh: Mesh
    boundary: np.ndarray
    """(b, 2)"""

    @classmethod
    def of(cls, pair: Pair, triangles: int) -> Task:
        """Mesh a pair's source, its boundary matched automatically: what the solver tries first."""
        recipe = Recipe(density=max(triangles // 4, LEAST_DENSITY))
        morph = solve_outlines(pair.source, pair.target, recipe=recipe)
        rest, target = ([end[ring] for ring in morph.rings] for end in (morph.rest, morph.target))
        mesh = split_chords(triangulate(_at_unit_area(rest), 1 / triangles))
        return cls(mesh, np.concatenate(_at_unit_area(target)))

    @cached_property
    def elements(self) -> Elements:
        """The mesh's triangles."""
        return Elements.of(self.mesh.points, self.mesh.triangles)

    @property
    def free(self) -> np.ndarray:
        """The inner vertices."""
        return np.arange(self.mesh.boundary_size, len(self.mesh.points))

    def start(self) -> np.ndarray:
        """Return the harmonic map (n, 2), which may fold."""
        return harmonic(FreeVertices(self.elements, self.free), self.boundary)

    def folds(self, x: np.ndarray) -> int:
        """Count the triangles of positions x (n, 2) with J ≤ 0."""
        return int(np.sum(self.elements.determinants(x) <= 0))


@dataclass(frozen=True, eq=False)
class Placed:
    """What a solver made of a task."""

    ms: float
    folds: int
    distortion_mean: float
    distortion_worst: float
    moved: float
    """How far the boundary has strayed, in units of √area."""


Solve = Callable[[Task, np.ndarray], tuple[np.ndarray, float]]
"""From a start (n, 2) to positions (n, 2) and the seconds it took, all preparation included."""


def placed(task: Task, x: np.ndarray, seconds: float) -> Placed:
    """Judge positions x (n, 2)."""
    spread = distortion(task.elements, x)
    return Placed(
        ms=1e3 * seconds,
        folds=task.folds(x),
        distortion_mean=float(np.average(spread, weights=task.elements.areas)),
        distortion_worst=float(spread.max()),
        moved=float(np.abs(x[: len(task.boundary)] - task.boundary).max()),
    )


def our_untangling(task: Task, x: np.ndarray) -> tuple[np.ndarray, float]:
    """Untangle by projected Newton, one step per ε; give up as soon as the solver does."""
    start = perf_counter()
    x = untangle(FreeVertices(task.elements, task.free), x, lambda *_: None)
    return x, perf_counter() - start


def our_patient_untangling(task: Task, x: np.ndarray) -> tuple[np.ndarray, float]:
    """Start again from where the last round gave up."""
    start = perf_counter()
    vertices = FreeVertices(task.elements, task.free)
    for _ in range(ROUNDS):
        x = untangle(vertices, x, lambda *_: None)
        if not task.folds(x):
            break
    return x, perf_counter() - start


def our_polished_untangling(task: Task, x: np.ndarray) -> tuple[np.ndarray, float]:
    """Lower the distortion after untangling, as mouette's steps do on their way."""
    x, seconds = our_patient_untangling(task, x)
    if task.folds(x):
        return x, seconds
    x, more = our_polish(task, x)
    return x, seconds + more


def mouette_untangling(task: Task, x: np.ndarray) -> tuple[np.ndarray, float]:
    """Untangle by mouette: fixed boundary, weights by area, to the first valid map, one thread."""
    from mouette.processing.parametrization import untangle as untangle_by_mouette

    start = perf_counter()
    corners = task.mesh.points[task.mesh.triangles]
    sides = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], axis=2)
    y = untangle_by_mouette(
        x.copy(),
        np.arange(len(x)) < task.mesh.boundary_size,
        task.mesh.triangles,
        np.linalg.inv(sides),
        areas=task.elements.areas,
        stop_if_positive=True,
        num_threads=1,
    )
    return y.reshape(-1, 2), perf_counter() - start


def our_polish(task: Task, x: np.ndarray) -> tuple[np.ndarray, float]:
    """Lower the symmetric Dirichlet energy by projected Newton."""
    start = perf_counter()
    vertices = FreeVertices(task.elements, task.free)
    x = relax(vertices, SymmetricDirichlet(), x, lambda *_: None)
    return x, perf_counter() - start


def slim_polish(task: Task, x: np.ndarray) -> tuple[np.ndarray, float]:
    """Lower the same energy by libigl's SLIM until a step gains as little as ours may.

    The energy is not its to tell: it is measured outside the time.
    """
    import igl

    start = perf_counter()
    space = np.column_stack([task.mesh.points, np.zeros(len(x))])
    data = igl.slim_precompute(
        np.asfortranarray(space),
        np.asfortranarray(task.mesh.triangles.astype(np.int32)),
        np.asfortranarray(x),
        igl.MappingEnergyType.SYMMETRIC_DIRICHLET,
        np.arange(task.mesh.boundary_size, dtype=np.int32),
        np.asfortranarray(task.boundary),
        SOFT,
    )
    seconds = perf_counter() - start
    before = np.inf
    for _ in range(MAX_STEPS):
        start = perf_counter()
        x = igl.slim_solve(data, 1)
        seconds += perf_counter() - start
        after = placed(task, x, 0).distortion_mean
        if before - after <= CONVERGED * after:
            break
        before = after
    return x, seconds


def _at_unit_area(rings: list[np.ndarray]) -> list[np.ndarray]:
    size = np.sqrt(sum(map(signed_area, rings)))
    return [(ring - rings[0].mean(axis=0)) / size for ring in rings]
