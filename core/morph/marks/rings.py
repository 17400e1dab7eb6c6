"""Match two rings as they were drawn: in arc lengths, whatever their direction, place and size."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Self

import numpy as np

from core.geometry.polyline import arc_lengths, signed_area
from core.model.outline import Array
from core.morph.marks.chain import Pair, in_order
from core.morph.marks.contour import Contour, gap
from core.morph.marks.keymarks import Route
from core.morph.marks.matching import Match, match_contours
from core.progress import Watch, unwatched

EMPTY = 1e-6
"""Rings that enclose less than this part of their perimeter squared match nothing."""
AT = 1e-6
"""A place this near to a corner, as a fraction of the perimeter, is the corner."""
CONFIRMED = 1e-3
"""Pairs this near to a match, as a fraction of the perimeter, lie on it."""
FAR_BETTER, BETTER = 0.7, 0.05
"""A mirrored match is far better if it costs less than this part of the others, and by so much."""
DRAWN = 0.03
"""How far the mate of a corner without partner may be drawn to a corner like it."""


@dataclass(frozen=True, eq=False)
class RingMatch:
    """A correspondence of two rings."""

    source: Contour
    target: Contour
    """The mirror image if the match is mirrored."""
    perimeters: Array
    """(2,) of the rings as drawn."""
    proposal: Match
    """The match as it was found, and …"""
    lead: Callable[[Match], Route]
    """… what corrects it, once that is asked for."""

    @classmethod
    def by_length(cls, source: Array, target: Array, starts: Pair) -> Self:
        """Match rings by arc length alone, from corresponding starts on: nothing is sure there."""
        contours = Contour.of(source), Contour.of(target)
        perimeters = np.array([arc_lengths(ring)[-1] for ring in (source, target)])
        places = zip(contours, np.array(starts) / perimeters, strict=True)
        here, there = (at.translated(np.array([start])) + np.arange(2) for at, start in places)
        unsure = Match(here, there, 1.0, np.zeros(1), np.zeros(1), mirrored=False)
        return cls(*contours, perimeters, unsure, Route.plain)

    @cached_property
    def route(self) -> Route:
        """The match, led through corners that belong together."""
        return self.lead(self.proposal)

    @property
    def cost(self) -> float:
        """How ill the rings match: 0 is perfect, 1 is poor."""
        return self.proposal.cost

    @property
    def mirrored(self) -> bool:
        """Whether it takes the mirror image of the target."""
        return self.proposal.mirrored

    def marks(self) -> tuple[Array, Array, Array]:
        """Return the marks that it takes besides the fixed ones, in order along the source.

        They are arc lengths (j,) on the source and on the target, and the confidence of each pair.
        """
        match, knots = self.route.match, self.route.key_knots()
        here = self.source.translated(match.source[knots]) * self.perimeters[0]
        there = self.target.translated(match.target[knots]) * self.perimeters[1]
        order = np.argsort(here)
        return here[order], there[order], match.sureness(match.source[knots])[order]

    def images(self, lengths: Array) -> Array:
        """Return where arc lengths (j,) on the source belong on the target."""
        at = self.source.translated(lengths / self.perimeters[0])
        return self.target.translated(self.route.match.image(at)) * self.perimeters[1]

    def along(self, pairs: Array) -> RingMatch:
        """Return a match as sure as this one that leads through other pairs of arc lengths (k, 2).

        They are in order around both rings.
        """
        sides = zip((self.source, self.target), (pairs / self.perimeters).T, strict=True)
        once = np.column_stack([contour.translated(at) for contour, at in sides])
        once = once[::-1] if self.source.backwards else once
        source, target = np.unwrap(np.vstack([once, once[:1]]), axis=0, period=1.0).T
        match = replace(self.route.match, source=source, target=target)
        return replace(self, proposal=match, lead=partial(Route.of, self.source, self.target))

    def confirmed_by(self, fixed: Sequence[Pair]) -> bool:
        """Whether pairs of arc lengths lie on the match."""
        here, there = (np.array(fixed) / self.perimeters).T
        at, image = self.source.translated(here), self.target.translated(there)
        match = self.route.match
        off = gap(match.image(at), image) * gap(match.origin(image), at)
        return bool((np.abs(off) <= CONFIRMED**2).all())

    def through(self, fixed: Sequence[Pair]) -> RingMatch:
        """Return the match led through pairs of arc lengths that lie on it, or nearly so.

        It takes the same marks as before.
        """
        pairs = _pairs(self.source, self.target, self.perimeters, fixed)
        match, keys = self.route.match, self.route.match.source[self.route.key_knots()]
        lead = partial(Route.of, self.source, self.target, fixed=pairs, keys=keys)
        return replace(self, proposal=match, lead=lead)

    def reversed(self) -> RingMatch:
        """Return the same match, seen from the target."""
        back, route = self.perimeters[::-1], self.route.reversed()
        return RingMatch(self.target, self.source, back, route.match, lambda _: route)

    def mate(self, length: float) -> float:
        """Return where an arc length belongs; that of a corner is drawn to a corner like it."""
        at = self.source.translated(np.array([length / self.perimeters[0]]))
        image = self._drawn(float(at[0]), float(self.route.match.image(at)[0]))
        return float(self.target.translated(np.array(image)) * self.perimeters[1])

    def _drawn(self, at: float, image: float) -> float:
        """Draw the image of a corner to the nearest one that turns alike, if its partner is not
        known and the order around the rings allows it.
        """
        match, anchors = self.route.match, np.flatnonzero(self.route.fixed | self.route.corner)
        corners, turns = self.source.corners
        here = np.flatnonzero(np.abs(gap(corners, at)) < AT)
        if not len(here) or (np.abs(gap(match.source[anchors], at)) < AT).any():
            return image
        known = [(match.source[i] % 1.0, match.target[i] % 1.0) for i in anchors]
        others, other_turns = self.target.corners
        away = np.abs(gap(others, image))
        away[other_turns * turns[here[0]] <= 0] = np.inf
        for k in np.argsort(away)[: np.count_nonzero(away < DRAWN)]:
            pair = at, float(others[k])
            if pair in in_order([*known, pair]):
                return pair[1]
        return image


def match_rings(
    source: Array,
    target: Array,
    fixed: Sequence[Pair] = (),
    rotation: complex | None = None,
    watch: Watch = unwatched,
) -> list[RingMatch]:
    """Match two rings (n, 2) and (k, 2) in ways that differ as wholes, the best first.

    ``fixed`` pairs of arc lengths stay together; where they contradict each other's order around
    the rings, the earlier ones count. ``rotation`` (of length one) is that of the source, if it is
    known. A mirrored match is among them when it is better than the others. Rings that enclose
    nothing have no match. ``watch(stage)`` is called between steps and may raise ``Cancelled``.
    """
    if not (_encloses(source) and _encloses(target)):
        return []
    a, b = Contour.of(source), Contour.of(target)
    perimeters = np.array([arc_lengths(ring)[-1] for ring in (source, target)])
    pairs = _pairs(a, b, perimeters, fixed)
    found = []
    for match in match_contours(a, b, pairs, rotation, watch):
        there = b.mirrored() if match.mirrored else b
        lead = partial(Route.of, a, there, fixed=pairs)
        found.append(RingMatch(a, there, perimeters, match, lead))
    return found


def mirror_is_better(matches: Sequence[RingMatch]) -> bool:
    """Whether one that is mirrored matches far better than all that are not."""
    plain = min((match.cost for match in matches if not match.mirrored), default=0.0)
    mirrored = min((match.cost for match in matches if match.mirrored), default=np.inf)
    return mirrored < min(FAR_BETTER * plain, plain - BETTER)


def _pairs(
    source: Contour, target: Contour, perimeters: Array, lengths: Sequence[Pair]
) -> list[Pair]:
    """Return pairs of arc lengths as places on the contours, in order around them."""
    if not lengths:
        return []
    here, there = (np.array(lengths) / perimeters).T
    at, image = source.translated(here), target.translated(there)
    return in_order(zip(at.tolist(), image.tolist(), strict=True))


def _encloses(ring: Array) -> bool:
    if len(ring) < 3 or not np.isfinite(ring).all():
        return False
    return abs(signed_area(ring)) > EMPTY * arc_lengths(ring)[-1] ** 2
