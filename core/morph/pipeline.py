"""From two outlines and their marks to a morph: every step in order."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import islice
from numbers import Integral, Real
from time import perf_counter
from typing import get_args

import numpy as np

from core.errors import SolveError, Where
from core.geometry.basis import Basis
from core.geometry.clean_outline import CleanOutline
from core.geometry.extent import check_together
from core.geometry.flatten import flatten
from core.geometry.triangulation import Indices
from core.geometry.validate import clean
from core.model import Outline, Recipe, RingPoint
from core.model.layer import mark_labels
from core.model.outline import Array
from core.model.recipe import LEAST_DENSITY, MOST_DENSITY, Material, Method
from core.morph.certificate import Certificate
from core.morph.correspondence import place_marks, unplace_marks, ways
from core.morph.mapping import Map
from core.morph.morph import Morph
from core.morph.motion.motion import Motion
from core.morph.quality import folds, smallest_angle
from core.morph.report import Report, Stage
from core.morph.rivals import choose
from core.progress import Progress, Watch, silent

POOR = 1.2
"""Mean distortion above which it is worth telling that the target matches far better mirrored."""
KEPT = 64
"""How many outlines are remembered clean."""


def solve_outlines(
    source: Outline,
    target: Outline,
    marks: Sequence[tuple[RingPoint, RingPoint]] = (),
    *,
    labels: Sequence[str] | None = None,
    recipe: Recipe | None = None,
    progress: Progress = silent,
) -> Morph:
    """Map the source onto the target and prepare the in-betweens.

    ``marks`` are corresponding places on both, named by ``labels`` in errors. Without any on the
    exterior, several proposals are tried; the one that distorts least, and does not turn for
    nothing, is taken. Raises ``OutlineError``, ``MarkError`` or ``SolveError`` for input that has
    no answer, and whatever ``progress`` raises.
    """
    recipe = recipe or Recipe()
    _check_recipe(recipe)
    labels = labels or list(islice(mark_labels(), len(marks)))
    clock = _Clock(progress)
    clock.start("outlines", 0.0, 0.1)
    ends = _cleaned(source, "source"), _cleaned(target, "target")
    check_together(ends)
    _check_rings(*ends)
    placed = place_marks((source, target), ends, marks, labels)
    clock.start("mapping", 0.1, 0.9)
    possible = ways(*ends, placed, labels, recipe.density, clock.watch)
    here, there = bases = Basis.of(ends[0]), Basis.of(ends[1])
    choice = choose(possible, bases, recipe, clock.watch)
    taken, found = choice.taken, choice.map
    clock.start("in-between", 0.9, 1.0)
    mesh = found.mesh
    rest, goal = here.outside(mesh.points), there.outside(found.target)
    drawn = sum(len(pair.source) for pair in taken.boundaries)  # what was added follows them
    rest[:drawn] = np.concatenate([pair.source for pair in taken.boundaries])
    goal[:drawn] = np.concatenate([pair.target for pair in taken.boundaries])
    moving = here.amid(there)
    ends_inside = mesh.points * (here.unit / moving.unit), moving.inside(goal)
    inbetween = _inbetween(recipe, *ends_inside, mesh.triangles, clock.watch)
    clock.stop()
    report = Report(
        vertices=len(rest),
        triangles=len(mesh.triangles),
        certificate=Certificate.of(mesh.triangles, mesh.rings, rest, goal),
        distortion_mean=found.mean,
        distortion_worst=float(found.distortion.max()),
        smallest_angle=min(smallest_angle(p, mesh.triangles) for p in (mesh.points, found.target)),
        iterations=found.iterations,
        stages=_stages(clock, ends, found, choice.tried, recipe),
        tried=choice.tried,
        mirror=taken.matching.mirror and found.mean > POOR,
        repairs=ends[0].repairs + ends[1].repairs,
        proposed=unplace_marks(taken.proposed, (source, target), ends),
    )
    basis = moving.origin, moving.unit
    return Morph(mesh.triangles, rest, goal, mesh.rings, report, inbetween, *basis)


def _inbetween(
    recipe: Recipe, rest: Array, target: Array, triangles: Indices, watch: Watch
) -> Motion:
    """Prepare the recipe's method; on a folded map Sᵗ does not exist, and the plain form serves."""
    folded = len(folds(target, triangles)) > 0
    method = "plain arap" if recipe.method == "arap" and folded else recipe.method
    return Motion.of(method, (rest, target), triangles, watch=watch)


@lru_cache(maxsize=KEPT)
def _cleaned(outline: Outline, side: str) -> CleanOutline:
    """Clean an outline, once for all: its marks change far more often."""
    return clean([line.points for line in flatten(outline)], side)


def _check_recipe(recipe: Recipe) -> None:
    for name, choice, choices in (
        ("method", recipe.method, get_args(Method)),
        ("material", recipe.material, get_args(Material)),
    ):
        if choice not in choices:
            raise SolveError(
                f"There is no {name} {choice!r}.", hint=f"Choose {' or '.join(choices)}."
            )
    whole = isinstance(recipe.density, Integral)
    if not (whole and LEAST_DENSITY <= recipe.density <= MOST_DENSITY):
        raise SolveError(
            f"A mesh density of {recipe.density} is out of range.",
            hint=f"Choose {LEAST_DENSITY} to {MOST_DENSITY} boundary vertices, a whole number.",
        )
    numbers = all(isinstance(value, Real) for value in (recipe.mu, recipe.lam))
    if not (numbers and 0 <= recipe.lam < np.inf and 0 < recipe.mu < np.inf):
        raise SolveError(
            f"A material with μ = {recipe.mu} and λ = {recipe.lam} is not elastic.",
            hint="Choose μ above 0, and λ at 0 or above.",
        )


def _check_rings(source: CleanOutline, target: CleanOutline) -> None:
    a, b = len(source.rings) - 1, len(target.rings) - 1
    if a == b:
        return
    side, other, end = ("source", "target", source) if a > b else ("target", "source", target)
    first, last = min(a, b) + 1, max(a, b)
    point = end.rings[first][0]
    lacking, spare = "a hole", f"hole {last}"
    if first < last:
        through = "and" if first + 1 == last else "to"
        lacking, spare = f"{abs(a - b)} holes", f"holes {first} {through} {last}"
    raise SolveError(
        f"The source has {a or 'no'} hole{'s'[: a != 1]}, the target {b or 'none'}.",
        where=Where(side, ring=first, point=(float(point[0]), float(point[1]))),
        hint=f"Add {lacking} to the {other}, or remove {spare} of the {side}.",
    )


def _stages(
    clock: _Clock, ends: Sequence[CleanOutline], found: Map, tried: int, recipe: Recipe
) -> tuple[Stage, ...]:
    """Return all stages; matching includes the maps of the rivals that were not taken."""
    repairs, rivals = sum(len(end.repairs) for end in ends), tried - 1
    matching = clock.seconds["mapping"] - sum(stage.seconds for stage in found.stages)
    return (
        Stage("outlines", clock.seconds["outlines"], f"{repairs or 'no'} repairs"),
        Stage("matching", matching, f"{rivals or 'no'} rival{'s'[: rivals != 1]} tried"),
        *found.stages,
        Stage("in-between", clock.seconds["in-between"], recipe.method),
    )


class _Clock:
    """Times the steps and passes progress on."""

    def __init__(self, progress: Progress) -> None:
        self.seconds: dict[str, float] = {}
        self._progress, self._stage, self._since = progress, "", 0.0
        self._fraction, self._end = 0.0, 1.0

    def start(self, stage: str, fraction: float, end: float) -> None:
        """Begin a stage that takes progress from a fraction to another."""
        self.stop()
        self._stage, self._since = stage, perf_counter()
        self._fraction, self._end = fraction, end
        self._progress(fraction, stage)

    def stop(self) -> None:
        if self._stage:
            self.seconds[self._stage] = perf_counter() - self._since

    def watch(self, step: str) -> None:
        """Report a step; nobody knows how many follow, so each takes a part of what is left."""
        self._fraction += (self._end - self._fraction) * 0.1
        self._progress(self._fraction, step)
