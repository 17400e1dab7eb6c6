"""A mesh of the source, and where its vertices go in the target, without a fold.

The direct route triangulates the source and places the inner vertices by energy. Where that leaves
folds, a mesh that fits both outlines from the start takes its place, cleaned up at both ends.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from time import perf_counter

import numpy as np

from core.fem.elements import Elements
from core.geometry.rotation import turn_and_mirror
from core.geometry.triangulation import Mesh, split_chords, triangulate
from core.model import Recipe
from core.model.outline import Array
from core.morph.compatible.cleanup import coarsen, improve
from core.morph.compatible.overlay import compatible_mesh
from core.morph.placement import place, settle
from core.morph.quality import distortion
from core.morph.report import Iteration, Stage
from core.progress import Watch

TRIANGLES_PER_BOUNDARY_VERTEX = 4
POOR = 50.0
"""Distortion of a triangle above which a sound map is cleaned up as well."""

TURNING = 0.15
"""What half a turn adds to the cost of a map, as a fraction of its distortion."""


@dataclass(frozen=True, eq=False)
class Map:
    """A mesh of the source and its image, both at unit area."""

    mesh: Mesh
    target: Array
    """(n, 2)"""
    distortion: Array
    """(m,) symmetric Dirichlet density of each triangle; infinite where it is folded."""
    iterations: tuple[Iteration, ...]
    stages: tuple[Stage, ...]
    """What was done, in order."""

    @property
    def sound(self) -> bool:
        """Whether it has no fold."""
        return bool(np.isfinite(self.distortion).all())

    @property
    def mean(self) -> float:
        """Mean distortion by area: 1 is an isometry, infinite has a fold."""
        return float(np.average(self.distortion, weights=self._elements.areas))

    @property
    def turn(self) -> float:
        """How far the shape turns as a whole, in (-π, π]."""
        turn, _ = turn_and_mirror(self._elements.deformation_gradients(self.target))
        return float(np.angle(self._elements.areas @ turn))

    @property
    def cost(self) -> float:
        """Mean distortion, and a little for turning: a shape is not turned for nothing."""
        return self.mean * (1 + TURNING * abs(self.turn) / np.pi)

    @cached_property
    def _elements(self) -> Elements:
        return Elements.of(self.mesh.points, self.mesh.triangles)


def direct_map(
    source: Sequence[Array], target: Sequence[Array], recipe: Recipe, watch: Watch
) -> Map:
    """Map rings (k, 2) that correspond vertex by vertex, exterior first, at about unit area.

    The map may have folds: some meshes cannot take the target's shape without. ``watch(stage)`` is
    called between steps and may raise ``Cancelled``.
    """
    log = _Log()
    watch("mesh")
    # rounded, so that equal shapes get equal meshes wherever they are drawn
    coarse = triangulate([np.round(ring, 10) for ring in source], _max_area(recipe))
    mesh = split_chords(coarse)
    log.note("mesh", f"{len(mesh.points) - len(coarse.points)} chords split")
    placed = place(mesh, np.concatenate(target), recipe, watch)
    spread = _distortion(mesh, placed.target)
    log.note("placement", _verdict(spread), mesh, spread)
    return Map(mesh, placed.target, spread, placed.iterations, tuple(log.stages))


def mended_map(
    direct: Map, source: Sequence[Array], target: Sequence[Array], recipe: Recipe, watch: Watch
) -> Map:
    """Return a map without folds in place of a direct one that has some, or has poor triangles."""
    if direct.distortion.max() <= POOR:
        return direct
    log = _Log(direct.stages)
    mesh, image = direct.mesh, direct.target
    if not direct.sound:
        mesh, image = coarsen(*compatible_mesh(source, target, watch), watch)
        log.note("joint mesh", f"{len(mesh.triangles)} triangles that fit both outlines")
    mesh, image = improve(mesh, image, _max_area(recipe), watch, rounds=1 if direct.sound else 5)
    settled = settle(mesh, image, recipe, watch)
    spread = _distortion(mesh, settled.target)
    log.note("clean-up", f"{len(mesh.triangles)} triangles, {_verdict(spread)}", mesh, spread)
    if spread.max() >= direct.distortion.max():
        return replace(direct, stages=tuple(log.stages))
    history = direct.iterations + settled.iterations
    return Map(mesh, settled.target, spread, history, tuple(log.stages))


def _max_area(recipe: Recipe) -> float:
    return 1 / (TRIANGLES_PER_BOUNDARY_VERTEX * recipe.density)


class _Log:
    """Times the stages."""

    def __init__(self, stages: Iterable[Stage] = ()) -> None:
        self.stages = list(stages)
        self._since = perf_counter()

    def note(
        self, name: str, result: str, mesh: Mesh | None = None, spread: Array | None = None
    ) -> None:
        """Note what a stage did, with the distortion of the map that it left, if it left one."""
        seconds, self._since = perf_counter() - self._since, perf_counter()
        if mesh is None or spread is None:
            self.stages.append(Stage(name, seconds, result))
            return
        mean = np.average(spread, weights=Elements.of(mesh.points, mesh.triangles).areas)
        folds = int(np.isinf(spread).sum())
        self.stages.append(Stage(name, seconds, result, folds, float(mean)))


def _distortion(mesh: Mesh, target: Array) -> Array:
    return distortion(Elements.of(mesh.points, mesh.triangles), target)


def _verdict(spread: Array) -> str:
    folds = int(np.isinf(spread).sum())
    return f"{folds} folds" if folds else f"distortion at worst {spread.max():.3g}"
