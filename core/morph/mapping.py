"""A mesh of the source, and where its vertices go in the target, without a fold.

The direct route triangulates the source and places the inner vertices by energy. Where that leaves
folds, a mesh that fits both outlines from the start takes its place. Where a few triangles are poor
at either end, the mesh is changed around them; where that does not do, all of it is made even at
both ends, and both ends of it are brought to rest.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from time import perf_counter
from typing import Self

import numpy as np

from core.fem.elements import Elements
from core.geometry.rotation import to_complex, to_points, turn_and_mirror
from core.geometry.triangulation import Mesh, split_chords, triangulate
from core.model import Recipe
from core.model.outline import Array
from core.morph.compatible.cleanup import coarsen, improve
from core.morph.compatible.flips import flip
from core.morph.compatible.joint import JointMesh
from core.morph.compatible.overlay import compatible_mesh
from core.morph.compatible.settling import settle_both
from core.morph.compatible.widening import FAIR, widen
from core.morph.placement import place, settle
from core.morph.quality import distortion
from core.morph.report import Iteration, Stage
from core.progress import Watch

TRIANGLES_PER_BOUNDARY_VERTEX = 4
FEW, MANY = 0.05, 0.1
"""Parts of the triangles: if no more are poor, the mesh is changed only around them; if more are
still poor in an even mesh, more triangles would not help."""
NARROW = 0.5
"""Quality below which triangles may have been changed for the sake of poor ones beside them."""
SLIGHTLY, COSTLY = 1.003, 1.03
"""How many times the distortion wider angles may take before the energy is brought down again, and
after that."""
ALIKE = 1e-9
"""Distance, at unit area, at which outlines are the same."""


@dataclass(frozen=True, eq=False)
class Map:
    """A mesh of the source and its image, both at unit area."""

    mesh: Mesh
    target: Array
    """(n, 2)"""
    distortion: Array
    """(m,) symmetric Dirichlet density of each triangle; infinite where it is folded."""
    iterations: tuple[Iteration, ...]
    stages: tuple[Stage, ...] = ()
    """What was done, in order."""
    even: bool = False
    """Whether its mesh was made even at both ends."""

    @classmethod
    def of(cls, mesh: Mesh, target: Array, iterations: tuple[Iteration, ...]) -> Self:
        """Measure the map that takes a mesh to target positions (n, 2)."""
        spread = distortion(Elements.of(mesh.points, mesh.triangles), target)
        return cls(mesh, target, spread, iterations)

    def on(self, joint: JointMesh) -> Map:
        """Measure the same map on a mesh that was changed at both ends."""
        return Map.of(*joint.apart(self.mesh.rings), self.iterations)

    def joint(self) -> JointMesh:
        """Return the mesh at both ends."""
        return JointMesh.of(self.mesh, self.target)

    def after(self, stages: Iterable[Stage], iterations: Iterable[Iteration] = ()) -> Map:
        """Return it with what came before."""
        return replace(
            self,
            stages=(*stages, *self.stages),
            iterations=(*iterations, *self.iterations),
        )

    @property
    def folds(self) -> int:
        """How many triangles are folded."""
        return int(np.isinf(self.distortion).sum())

    @property
    def sound(self) -> bool:
        """Whether it has no fold."""
        return self.folds == 0

    @property
    def mean(self) -> float:
        """Mean distortion by area: 1 is an isometry, infinite has a fold."""
        return self.bounded_mean(np.inf)

    def bounded_mean(self, most: float) -> float:
        """Mean distortion by area, no triangle counting for more than ``most``."""
        bounded = np.minimum(self.distortion, most)
        return float(np.average(bounded, weights=self._elements.areas))

    @property
    def worst_quality(self) -> float:
        """Quality of the worst triangle at the worse end, see ``joint``."""
        return float(self.joint().worse.min())

    @property
    def turn(self) -> float:
        """How far the shape turns as a whole, in (-π, π]."""
        turn, _ = turn_and_mirror(self._elements.deformation_gradients(self.target))
        return float(np.angle(self._elements.areas @ turn))

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
    coarse.points[: coarse.boundary_size] = np.concatenate(source)
    mesh = split_chords(coarse)
    log.note("mesh", f"{len(mesh.points) - len(coarse.points)} chords split")
    placed = place(mesh, np.concatenate(target), recipe, watch)
    return log.map("placement", Map.of(mesh, placed.target, placed.iterations))


def refitted_map(
    source: Sequence[Array], target: Sequence[Array], recipe: Recipe, watch: Watch
) -> Map:
    """Map the same rings without a fold, on a mesh that fits both outlines from the start."""
    log = _Log()
    mesh, image = compatible_mesh(source, target, watch)
    joint = _evened(coarsen(JointMesh.of(mesh, image), watch), recipe, watch)
    found = replace(Map.of(*joint.apart(mesh.rings), ()), even=True)
    return log.map("joint mesh", found, f"{len(joint.triangles)} triangles that fit both outlines")


def polished_map(sound: Map, recipe: Recipe, watch: Watch) -> Map:
    """Return a map without folds with its small angles put right; without any, as it is."""
    if np.mean(sound.joint().worse < FAIR) <= FEW:
        wide = _widened(sound, watch)
        if wide.worst_quality >= FAIR and wide.mean <= SLIGHTLY * sound.mean:
            return wide
    return _polished(sound, recipe, watch)


def _widened(found: Map, watch: Watch) -> Map:
    """Return a map with wider angles, whatever they cost."""
    log = _Log(found.stages)
    before = found.joint()
    after = widen(before, watch=watch)
    if after is before:
        return found
    change = len(after.triangles) - len(before.triangles)
    quality = f"worst quality {before.worse.min():.3f} to {after.worse.min():.3f}"
    return log.map("angles", found.on(after), f"{change:+} triangles, {quality}")


def _polished(found: Map, recipe: Recipe, watch: Watch) -> Map:
    """Return a map at rest, its angles as wide as is cheap there.

    Where many triangles are poor, all of the mesh is made even at both ends first.
    """
    log = _Log(found.stages)
    joint = found.joint()
    if np.mean(joint.worse < FAIR) > FEW:
        joint = joint if found.even else _evened(joint, recipe, watch)
        joint = settle_both(flip(joint, passes=3), watch=watch)
    if 0 < np.mean(joint.worse < FAIR) <= MANY:
        joint = widen(joint, watch=watch)
        joint = settle_both(joint, joint.worse < NARROW, watch)
    found = found.on(joint)
    if recipe.material == "st-venant-kirchhoff":
        settled = settle(found.mesh, found.target, recipe, watch)
        found = Map.of(found.mesh, settled.target, found.iterations + settled.iterations)
    dearest = COSTLY * found.mean
    for aim in (0.1, 0.2, FAIR):
        wider = found.on(widen(found.joint(), aim, watch))
        if wider.mean > dearest:
            break
        found = wider
    found = _exact_if_similar(found)
    return log.map("polish", found, f"worst quality {found.worst_quality:.3f}")


def _evened(joint: JointMesh, recipe: Recipe, watch: Watch) -> JointMesh:
    """Make a mesh even at both ends, and bring both to rest."""
    return settle_both(improve(joint, _max_area(recipe), watch), watch=watch)


def _exact_if_similar(found: Map) -> Map:
    """Return the similarity itself between outlines that are similar, which no energy is below.

    Bringing both ends to rest in turn comes close to it, but takes many turns to get there.
    """
    here, there = to_complex(found.mesh.points), to_complex(found.target)
    border = slice(found.mesh.boundary_size)
    goal = there[border].mean()
    arms, reached = here - here[border].mean(), there[border] - goal
    ratio = np.vdot(arms[border], reached) / np.vdot(arms[border], arms[border])
    image = goal + ratio * arms
    if np.abs(image - there)[border].max() > ALIKE:
        return found
    image[border] = there[border]
    return Map.of(found.mesh, to_points(image), found.iterations)


def _max_area(recipe: Recipe) -> float:
    return 1 / (TRIANGLES_PER_BOUNDARY_VERTEX * recipe.density)


class _Log:
    """Times the stages."""

    def __init__(self, stages: Iterable[Stage] = ()) -> None:
        self._stages = list(stages)
        self._since = perf_counter()

    def note(self, name: str, result: str) -> None:
        """Note what a stage did that left no map."""
        self._stages.append(Stage(name, self._passed(), result))

    def map(self, name: str, found: Map, what: str = "") -> Map:
        """Note what a stage did, and return the map that it left with all stages."""
        worst = f"distortion at worst {found.distortion.max():.3g}"
        verdict = worst if found.sound else f"{found.folds} folds"
        result = f"{what}, {verdict}" if what else verdict
        stage = Stage(name, self._passed(), result, found.folds, found.mean)
        return replace(found, stages=(*self._stages, stage))

    def _passed(self) -> float:
        seconds, self._since = perf_counter() - self._since, perf_counter()
        return seconds
