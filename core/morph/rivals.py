"""Which of several correspondences is taken: the one that distorts least, among those that fit.

Distortion alone would turn a tree upside down for a little less of it. So a map also costs more the
further it turns the shape, and the less the outlines that it joins are alike where it joins them.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Self

import numpy as np

from core.errors import MarkError, SolveError
from core.geometry.basis import Basis
from core.geometry.crossing import crosses_itself
from core.model import Recipe
from core.model.outline import Array
from core.morph.correspondence import Correspondence, Way
from core.morph.mapping import Map, direct_map, mended_map
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
WORTH = 0.03
"""What a rival must save by sliding if it is to slide again."""
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
    tried: list[_Tried] = []
    likeliest, least = 0.0, np.inf
    for way in ways:
        doubt = _doubt(way.misfit, likeliest) if tried else 1.0
        if _cost(GOOD, 0.0, doubt) >= least or (rival := way.follow()) is None:
            continue
        ends = _inside(rival, bases)
        if _cost(GOOD, _turn(*ends), doubt) >= least:
            continue
        likeliest = likeliest if tried else way.misfit
        tried.append(_Tried.of(rival, ends, doubt, recipe, watch))
        least = min(least, tried[-1].cost)
    if not tried:
        raise SolveError("The outlines could not be matched.", hint="Set marks on both.")
    while not (best := min(tried, key=lambda each: each.cost)).finished:
        tried[tried.index(best)] = best.advanced(bases, recipe, watch)
    return Choice(best.rival, best.map, len(tried))


Rings = list[Array]
Bases = tuple[Basis, Basis]


@dataclass(frozen=True, eq=False)
class _Tried:
    rival: Correspondence
    ends: tuple[Rings, Rings]
    doubt: float
    map: Map
    sketched: bool = False
    """Whether the map is of a sketch of the ends."""
    mended: bool = False
    """Whether the map has been."""
    slides: int = SLIDES
    """How often its boundary may still slide."""

    @classmethod
    def of(
        cls,
        rival: Correspondence,
        ends: tuple[Rings, Rings],
        doubt: float,
        recipe: Recipe,
        watch: Watch,
    ) -> Self:
        """Map a correspondence, or a sketch of it where it is very fine."""
        sketch = _sketched(ends)
        rough = replace(recipe, density=min(recipe.density, SKETCH))
        found = direct_map(*(sketch or ends), rough if sketch else recipe, watch)
        return cls(rival, ends, doubt, found, sketched=sketch is not None)

    @property
    def cost(self) -> float:
        """What it costs; what is left after mending, as far as one can tell before."""
        mean = self.map.mean if self.mended else self.map.bounded_mean(MENDABLE)
        return _cost(mean, self.map.turn, self.doubt)

    @property
    def finished(self) -> bool:
        """Whether nothing is left to be done."""
        return self.mended and not self._may_slide

    @property
    def _may_slide(self) -> bool:
        """Whether sliding is possible, may help, and does not take long."""
        possible = self.slides > 0 and self.rival.proposed and self.map.sound
        fine = self.map.mesh.boundary_size >= 2 * SKETCH
        return bool(possible) and self.map.mean >= SLIDING and not fine

    def advanced(self, bases: Bases, recipe: Recipe, watch: Watch) -> _Tried:
        """Return it without folds; or slid, while that helps; or mended in the end."""
        if not self._may_slide:
            return self.drawn(recipe, watch).with_mended_map(recipe, watch)
        after = self.slid(bases, recipe, watch)
        saved = 0.0 if after is None else self.cost - after.cost
        if after is None or saved <= 0:
            return replace(self, slides=0)
        return replace(after, slides=self.slides - 1 if saved >= WORTH else 0)

    def slid(self, bases: Bases, recipe: Recipe, watch: Watch) -> _Tried | None:
        """Return the map, without folds, of what the boundary slides to; none if that fails."""
        start = perf_counter()
        try:
            rival = self.rival.slid(slide(self.map.mesh, self.map.target, watch))
        except MarkError:
            return None
        stage = Stage("sliding", perf_counter() - start, f"from distortion {self.map.mean:.3f}")
        after = _Tried.of(rival, _inside(rival, bases), self.doubt, recipe, watch)
        return after.after(stage).unfolded(recipe, watch)

    def after(self, *stages: Stage) -> _Tried:
        """Return it with stages that came before the map."""
        return replace(self, map=replace(self.map, stages=(*stages, *self.map.stages)))

    def drawn(self, recipe: Recipe, watch: Watch) -> _Tried:
        """Return it with a map of the ends themselves."""
        if not self.sketched:
            return self
        before = [stage for stage in self.map.stages if stage.name == "sliding"]
        direct = direct_map(*self.ends, recipe, watch)
        return replace(self, map=direct, sketched=False).after(*before)

    def unfolded(self, recipe: Recipe, watch: Watch) -> _Tried:
        """Return it without folds."""
        return self if self.map.sound else self.drawn(recipe, watch).with_mended_map(recipe, watch)

    def with_mended_map(self, recipe: Recipe, watch: Watch) -> _Tried:
        """Return it with folds and small angles put right."""
        if self.mended:
            return self
        found = mended_map(self.map, *self.ends, recipe, watch)
        return replace(self, map=found, mended=True)


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


def _inside(rival: Correspondence, bases: Bases) -> tuple[Rings, Rings]:
    return (
        [bases[0].inside(pair.source) for pair in rival.boundaries],
        [bases[1].inside(pair.target) for pair in rival.boundaries],
    )
