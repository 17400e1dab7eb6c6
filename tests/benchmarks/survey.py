"""One pair from end to end: solved, measured beside its peers, and made ready to draw."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cache, partial
from multiprocessing import get_context
from pathlib import Path

import numpy as np

import core
from core.geometry.crossing import crosses_itself
from core.model import Recipe
from core.morph.pipeline import solve_outlines
from core.morph.quality import folds
from tests.benchmarks.drift import Drift
from tests.benchmarks.flubber import Flubber
from tests.benchmarks.given_marks import solve_given_marks
from tests.benchmarks.measures import Row, measure, outline
from tests.benchmarks.pairs import Pair
from tests.benchmarks.sheet import Panel

STRIP = np.arange(1, 6) / 6
"""Moments of the in-betweens that are drawn."""


@dataclass(frozen=True)
class Plan:
    """What is asked of every pair."""

    frames: int = 33
    """Ends included."""
    recipe: Recipe = field(default_factory=Recipe)
    given_marks: bool = False
    flubber: Path | None = None
    """The folder that holds the package; without, flubber is left out."""


@dataclass(frozen=True)
class Surveyed:
    """What was found."""

    row: Row
    panels: list[Panel]


@dataclass(frozen=True)
class Refused:
    """A pair that the program would not solve."""

    pair: str
    reason: str


def survey(plan: Plan, pair: Pair) -> Surveyed | Refused:
    """Carry the plan out for one pair."""
    try:
        row, morph = measure(pair, plan.frames, plan.recipe)
    except core.MorphError as error:
        return Refused(pair.name, str(error))
    if plan.flubber is not None and len(morph.rings) == 1:  # it knows no holes
        row = replace(row, drifts=row.drifts | {"flubber": _flubbered(plan, plan.flubber, pair)})
    if row.mirror:
        mirrored = solve_outlines(pair.source, pair.target.mirrored(), recipe=plan.recipe)
        row = replace(row, distortion_mirrored=mirrored.report.distortion_mean)
    if plan.given_marks and morph.report.proposed:
        row = replace(row, given=solve_given_marks(pair, morph.report, plan.recipe))
    return Surveyed(row, list(panels(row, morph)))


def survey_all(plan: Plan, pairs: Iterable[Pair], jobs: int = 1) -> Iterator[Surveyed | Refused]:
    """Carry the plan out for every pair, in order; in several processes timings say little."""
    work = partial(survey, plan)
    if jobs == 1:
        yield from map(work, pairs)
        return
    with get_context("spawn").Pool(jobs) as pool:
        yield from pool.imap(work, pairs)


def panels(row: Row, morph: core.Morph) -> Iterator[Panel]:
    """Yield the source, its mesh, the target's mesh, the target, and five in-betweens."""
    source, target = row.pair.split(" → ")
    rest, goal, rings, triangles = morph.rest, morph.target, morph.rings, morph.triangles
    turned = folds(goal, triangles)
    yield Panel(source, rest, rings, rainbow=True)
    yield Panel(f"{row.triangles} triangles", rest, rings, triangles)
    yield Panel(f"SD {row.distortion_mean:.2f}", goal, rings, triangles, turned)
    yield Panel(target, goal, rings, rainbow=True)
    for t in STRIP:
        frame = morph.at(t)
        crosses = crosses_itself(outline(frame, morph))
        yield Panel(f"{t:.2f} crosses" if crosses else f"{t:.2f}", frame, rings)


def _flubbered(plan: Plan, folder: Path, pair: Pair) -> Drift:
    (source,), (target,) = pair.drawn
    times = np.linspace(0, 1, plan.frames)
    rings = _running(folder).frames(source, target, times, plan.recipe.density)
    return Drift.of([[ring] for ring in rings], times)


@cache
def _running(folder: Path) -> Flubber:
    """Start flubber once in a process."""
    return Flubber(folder)
