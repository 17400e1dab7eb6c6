"""From two outlines and their marks to a morph: every step in order."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice
from time import perf_counter

import numpy as np

from core.errors import MarkError, SolveError, Where
from core.fem.elements import Elements
from core.geometry.flatten import flatten
from core.geometry.places import tracks
from core.geometry.polyline import arc_lengths, nearest_length
from core.geometry.triangulation import Indices, Mesh, split_chords, triangulate
from core.geometry.validate import CleanOutline, clean
from core.model import Outline, Recipe, RingPoint
from core.model.layer import mark_labels
from core.model.outline import Array
from core.morph.boundary import BoundaryPair, MatchedRing, correspond
from core.morph.inbetween import METHODS, Interpolate
from core.morph.morph import Morph
from core.morph.placement import Placed, place
from core.morph.quality import distortion, folds, smallest_angle
from core.morph.report import Report
from core.morph.suggest import best_shift
from core.progress import Progress, silent

TRIANGLES_PER_BOUNDARY_VERTEX = 4
MIN_DENSITY = 3
OFF_OUTLINE = 1e-3
"""How far a repair may leave a mark from the outline, as a fraction of its size."""


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

    ``marks`` are corresponding places on both, named by ``labels`` in errors. A ring without marks
    starts at the best cyclic
    shift. Raises ``OutlineError``, ``MarkError`` or ``SolveError`` for input that has no answer,
    and whatever ``progress`` raises.
    """
    recipe = recipe or Recipe()
    _check_recipe(recipe)
    labels = labels or list(islice(mark_labels(), len(marks)))
    clock = _Clock(progress)
    clock.start("outlines", 0.0)
    ends = [
        clean([line.points for line in flatten(outline)], side)
        for outline, side in ((source, "source"), (target, "target"))
    ]
    _check_rings(*ends)
    clock.start("boundary", 0.1)
    pairs = _boundary(
        ends[0], ends[1], _positions(source, target, marks, labels, ends), labels, recipe
    )
    clock.start("mesh", 0.2)
    # at unit area all tolerances and energies mean the same for every shape
    frames = [(end.rings[0].mean(axis=0), float(np.sqrt(end.area))) for end in ends]
    (origin, unit), (target_origin, target_unit) = frames
    rings = [(pair.source - origin) / unit for pair in pairs]
    # rounded, so that equal shapes get equal meshes wherever they are drawn
    coarse = triangulate(
        [np.round(ring, 10) for ring in rings], 1 / (TRIANGLES_PER_BOUNDARY_VERTEX * recipe.density)
    )
    mesh = split_chords(coarse)
    drawn = np.concatenate([pair.target for pair in pairs])
    clock.start("placement", 0.3)
    placed = place(mesh, (drawn - target_origin) / target_unit, recipe, clock.watch)
    clock.start("in-between", 0.9)
    rest = origin + unit * mesh.points
    goal = target_origin + target_unit * placed.target
    b = mesh.boundary_size
    rest[:b], goal[:b] = np.concatenate([pair.source for pair in pairs]), drawn
    inbetween = _inbetween(recipe, mesh.points, (goal - origin) / unit, mesh.triangles)
    clock.stop()
    report = _report(mesh, placed, rest, goal, ends, len(mesh.points) - len(coarse.points), clock)
    return Morph(mesh.triangles, rest, goal, mesh.rings, report, inbetween, origin, unit)


def _check_recipe(recipe: Recipe) -> None:
    if recipe.density < MIN_DENSITY:
        raise SolveError(
            f"A mesh density of {recipe.density} is too coarse.",
            hint=f"Choose at least {MIN_DENSITY} boundary vertices.",
        )
    if not (0 <= recipe.lam < np.inf and 0 < recipe.mu < np.inf):
        raise SolveError(
            f"A material with μ = {recipe.mu:g} and λ = {recipe.lam:g} is not elastic.",
            hint="Choose μ above 0, and λ at 0 or above.",
        )


def _inbetween(recipe: Recipe, rest: Array, target: Array, triangles: Indices) -> Interpolate:
    """Prepare the recipe's method; on a folded map Sᵗ does not exist, and the plain form serves."""
    folded = len(folds(target, triangles)) > 0
    method = "plain arap" if recipe.method == "arap" and folded else recipe.method
    return METHODS[method](rest, target, triangles)


class _Clock:
    """Times the stages and passes progress on."""

    def __init__(self, progress: Progress) -> None:
        self.timings: dict[str, float] = {}
        self._progress, self._stage, self._since = progress, "", 0.0
        self._fraction = 0.0

    def start(self, stage: str, fraction: float) -> None:
        self.stop()
        self._stage, self._fraction, self._since = stage, fraction, perf_counter()
        self._progress(fraction, stage)

    def stop(self) -> None:
        if self._stage:
            self.timings[self._stage] = perf_counter() - self._since

    def watch(self, step: str) -> None:
        """Report a step of unknown length: each takes a part of what is left."""
        self._fraction += (0.9 - self._fraction) * 0.1
        self._progress(self._fraction, step)


def _check_rings(source: CleanOutline, target: CleanOutline) -> None:
    a, b = len(source.rings) - 1, len(target.rings) - 1
    if a != b:
        side, more, extra = ("source", source, b + 1) if a > b else ("target", target, a + 1)
        point = more.rings[extra][0]
        raise SolveError(
            f"The source has {a or 'no'} hole{'' if a == 1 else 's'}, the target {b or 'none'}.",
            where=Where(side, ring=extra, point=(float(point[0]), float(point[1]))),
            hint=f"Add a hole to the other outline, or remove hole {extra} of the {side}.",
        )


Positions = list[tuple[int, float, float, int]]
"""Of each mark: ring, arc length on the source, arc length on the target, index."""


def _positions(
    source: Outline,
    target: Outline,
    marks: Sequence[tuple[RingPoint, RingPoint]],
    labels: Sequence[str],
    ends: Sequence[CleanOutline],
) -> Positions:
    """Find the marks on the cleaned rings."""
    found = []
    for index, (a, b) in enumerate(marks):
        if a.ring != b.ring:
            raise MarkError(
                f"Mark {labels[index]} lies on ring {a.ring} of the source"
                f" but on ring {b.ring} of the target.",
                where=Where("target", ring=b.ring, marks=(index,)),
                hint="Move it to the matching ring.",
            )
        lengths = []
        sides = (("source", source, a, ends[0]), ("target", target, b, ends[1]))
        for side, outline, place_, end in sides:
            point = tracks(outline)[place_.ring].point_at(place_.at)
            ring = end.rings[place_.ring]
            length, distance = nearest_length(ring, arc_lengths(ring), point)
            if distance > OFF_OUTLINE * end.diagonal:
                raise MarkError(
                    f"Mark {labels[index]} lies on a part of the {side} that had to be cut off.",
                    where=Where(side, point=(float(point[0]), float(point[1])), marks=(index,)),
                    hint="Move the mark, or mend the crossing edges there.",
                )
            lengths.append(length)
        found.append((a.ring, lengths[0], lengths[1], index))
    return found


def _boundary(
    source: CleanOutline,
    target: CleanOutline,
    positions: Positions,
    labels: Sequence[str],
    recipe: Recipe,
) -> list[BoundaryPair]:
    """Match ring by ring; the exterior's rotation guides rings that have no marks."""
    perimeters = [float(arc_lengths(end.rings[0])[-1]) for end in (source, target)]
    spacing = (perimeters[0] / recipe.density, perimeters[1] / recipe.density)
    rotation = None
    pairs = []
    for i, (a, b) in enumerate(zip(source.rings, target.rings, strict=True)):
        here = [p for p in positions if p[0] == i]
        if here:
            _, s, t, names = zip(*here, strict=True)
        else:
            start, end, turn = best_shift(a, b, rotation)
            s, t, names = (start,), (end,), (0,)
            rotation = turn if i == 0 else rotation
        ring = MatchedRing(a, b, np.array(s), np.array(t), names)
        pairs.append(correspond(ring, spacing, labels))
    return pairs


def _report(
    mesh: Mesh,
    placed: Placed,
    rest: Array,
    goal: Array,
    ends: Sequence[CleanOutline],
    split: int,
    clock: _Clock,
) -> Report:
    spread = distortion(Elements.of(mesh.points, mesh.triangles), placed.target)
    areas = Elements.of(mesh.points, mesh.triangles).areas
    return Report(
        vertices=len(mesh.points),
        triangles=len(mesh.triangles),
        folds_source=tuple(folds(rest, mesh.triangles).tolist()),
        folds_target=tuple(folds(goal, mesh.triangles).tolist()),
        distortion_mean=float(np.average(spread, weights=areas)),
        distortion_worst=float(spread.max()),
        smallest_angle=min(smallest_angle(p, mesh.triangles) for p in (mesh.points, placed.target)),
        iterations=placed.iterations,
        timings=clock.timings,
        repairs=ends[0].repairs + ends[1].repairs,
        split_chords=split,
    )
