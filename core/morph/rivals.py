"""Which of several correspondences is taken: the one that distorts least, among those that fit.

Distortion alone would turn a tree upside down for a little less of it. So a map also costs more the
further it turns the shape, and the less the outlines that it joins are alike where it joins them.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from core.errors import MarkError, SolveError
from core.geometry.basis import Basis
from core.geometry.crossing import crosses_itself
from core.model import Recipe
from core.model.outline import Array
from core.morph.correspondence import Correspondence, Way
from core.morph.mapping import Map, direct_map, polished_map, refitted_map
from core.morph.report import Stage
from core.morph.sliding import slide
from core.progress import Watch

GOOD = 1.3
"""Mean distortion that is as little as can be expected of a rival."""
TURNING = 0.85
"""What half a turn adds to the cost of a map, as a fraction of it."""
ALIKE = 0.05
"""Misfit below which correspondences hardly differ. Above, twice the misfit costs √2 times more."""
SLIDING, SLIDES = 1.12, 8
"""Mean distortion from which on the boundary may slide, and how often."""
WORTH = 0.02
"""What part of its cost a rival must save by sliding if it is to slide again."""
MENDABLE = 20.0
"""What a triangle counts at most: mending will put right what is worse, or folded."""
SKETCH = 256
"""Boundary vertices by which rivals are told apart: finer maps take longer, and say the same."""


@dataclass(frozen=True, eq=False)
class Choice:
    """The correspondence that was taken, and its map."""

    taken: Correspondence
    map: Map
    tried: int
    """How many correspondences got a map."""


def choose(ways: Iterable[Way], bases: Bases, recipe: Recipe, watch: Watch) -> Choice:
    """Map the correspondences that may be the best one; improve whichever is, while another is not.

    ``ways`` come the most likely first. ``watch(stage)`` is called between steps and may raise
    ``Cancelled``. Raises ``SolveError`` if no way can be followed.
    """
    job = _Job(bases, recipe, watch)
    tried: list[_Tried] = []
    likeliest, least = 0.0, np.inf
    for way in ways:
        doubt = _doubt(way.misfit, likeliest) if tried else 1.0
        if _cost(GOOD, 0.0, doubt) >= least or (rival := way.follow()) is None:
            continue
        if _cost(GOOD, _turn(*job.ends(rival)), doubt) >= least:
            continue
        likeliest = likeliest if tried else way.misfit
        tried.append(_Tried(job, rival, doubt, job.direct(rival)))
        least = min(least, tried[-1].cost)
    if not tried:
        raise SolveError("The outlines could not be matched.", hint="Set marks on both.")
    while not (best := min(tried, key=lambda each: each.cost)).finished:
        tried[tried.index(best)] = best.advanced()
    return Choice(best.rival, best.drawn, len(tried))


Rings = list[Array]
Bases = tuple[Basis, Basis]


@dataclass(frozen=True, eq=False)
class _Job:
    """Makes the maps of rivals: of sketches of the ends, where these are very fine."""

    bases: Bases
    recipe: Recipe
    watch: Watch

    def ends(self, rival: Correspondence) -> tuple[Rings, Rings]:
        """Return both boundaries, at unit area."""
        return (
            [self.bases[0].inside(pair.source) for pair in rival.boundaries],
            [self.bases[1].inside(pair.target) for pair in rival.boundaries],
        )

    def sketchy(self, rival: Correspondence) -> bool:
        """Whether the maps are of a sketch."""
        return _sketched(self.ends(rival)) is not None

    def direct(self, rival: Correspondence) -> Map:
        """Map a rival; there may be folds."""
        return direct_map(*self._task(rival), self.watch)

    def refitted(self, rival: Correspondence) -> Map:
        """Map a rival without folds."""
        return refitted_map(*self._task(rival), self.watch)

    def polished(self, rival: Correspondence, sound: Map) -> Map:
        """Return a rival's map without folds with its small angles put right."""
        *_, recipe = self._task(rival)
        return polished_map(sound, recipe, self.watch)

    def drawn(self, rival: Correspondence) -> Map:
        """Return the finished map of the ends themselves."""
        ends = self.ends(rival)
        found = direct_map(*ends, self.recipe, self.watch)
        if not found.sound:
            again = refitted_map(*ends, self.recipe, self.watch)
            found = again.after(found.stages, found.iterations)
        return polished_map(found, self.recipe, self.watch)

    def _task(self, rival: Correspondence) -> tuple[Rings, Rings, Recipe]:
        if (sketch := _sketched(ends := self.ends(rival))) is None:
            return *ends, self.recipe
        return *sketch, replace(self.recipe, density=min(self.recipe.density, SKETCH))


@dataclass(frozen=True, eq=False)
class _Tried:
    """A rival, and how far its map has come."""

    job: _Job
    rival: Correspondence
    doubt: float
    map: Map
    slides: int = SLIDES
    """How often its boundary may still slide."""
    refitted: bool = False
    """Whether the mesh was made for both ends, so that there is no fold."""
    finished: bool = False
    """Whether nothing is left to be done."""

    @property
    def cost(self) -> float:
        """What it costs; what is left after mending, as far as one can tell before."""
        return _cost(self._mean, self.map.turn, self.doubt)

    @property
    def drawn(self) -> Map:
        """The finished map of the ends themselves."""
        if not self.job.sketchy(self.rival):
            return self.map
        slid = [stage for stage in self.map.stages if stage.name == "sliding"]
        return self.job.drawn(self.rival).after(slid)

    def advanced(self) -> _Tried:
        """Return it slid, while that helps; then without folds, and slid again; then finished."""
        if self._may_slide:
            after = self._slid()
            saved = 0.0 if after is None else self.cost - after.cost
            if after is None or saved <= 0:
                return replace(self, slides=0)
            return replace(after, slides=self.slides - 1 if saved >= WORTH * self.cost else 0)
        if not self.map.sound:
            found = self.job.refitted(self.rival).after(self.map.stages, self.map.iterations)
            return replace(self, map=found, refitted=True, slides=SLIDES)
        return replace(self, map=self.job.polished(self.rival, self.map), finished=True)

    @property
    def _mean(self) -> float:
        known = self.refitted or self.finished
        return self.map.mean if known else self.map.bounded_mean(MENDABLE)

    @property
    def _may_slide(self) -> bool:
        """Whether sliding is possible, may help, and does not take long."""
        fine = self.map.mesh.boundary_size >= 2 * SKETCH
        return self.slides > 0 and bool(self.rival.proposed) and self._mean >= SLIDING and not fine

    def _slid(self) -> _Tried | None:
        """Return it with a map of the same kind of what the boundary slides to, if there is one."""
        start = perf_counter()
        try:
            rival = self.rival.slid(slide(self.map.mesh, self.map.target, self.job.watch))
        except MarkError:
            return None
        stage = Stage("sliding", perf_counter() - start, f"from distortion {self._mean:.3f}")
        found = self.job.refitted(rival) if self.refitted else self.job.direct(rival)
        return replace(self, rival=rival, map=found.after([stage]))


def _sketched(ends: tuple[Rings, Rings]) -> tuple[Rings, Rings] | None:
    """Return every so many-th vertex of ends that have far more than needed, if that is sound."""
    every = sum(map(len, ends[0])) // SKETCH
    if every < 2 or min(map(len, ends[0])) < 3 * every:
        return None
    here, there = ([ring[::every] for ring in end] for end in ends)
    return None if crosses_itself(here) or crosses_itself(there) else (here, there)


def _cost(distortion: float, turn: float, doubt: float) -> float:
    return distortion * (1 + TURNING * abs(turn) / np.pi) * doubt


def _doubt(misfit: float, least: float) -> float:
    return float(np.sqrt((ALIKE + misfit) / (ALIKE + least)))


def _turn(source: Rings, target: Rings) -> float:
    """How far the exterior turns as a whole, in (-π, π]."""
    here, there = (ends[0] @ [1, 1j] for ends in (source, target))
    return float(np.angle(np.vdot(here - here.mean(), there - there.mean())))
