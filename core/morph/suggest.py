"""Proposals for marks: all that two outlines need, or the mate of one clicked place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from core.geometry.places import measured
from core.model.outline import Array, Outline, RingPoint
from core.morph.marks.chain import Pair
from core.morph.marks.holes import RingPair, paired_holes
from core.morph.marks.rings import RingMatch, match_rings

Marks = Sequence[tuple[RingPoint, RingPoint]]


@dataclass(frozen=True, eq=False)
class OutlineMatch:
    """How two outlines belong together, ring by ring, led through the marks that they have."""

    source: Outline
    target: Outline
    rings: tuple[tuple[RingPair, RingMatch | None], ...]
    """Exteriors first; there is no match where a ring encloses nothing."""

    def proposals(self) -> list[tuple[RingPoint, RingPoint, float]]:
        """Return the marks that are needed besides those it is led through, with confidences."""
        found = []
        for pair, match in self.rings:
            if match is None:
                continue
            here, there = measured(self.source)[pair.source], measured(self.target)[pair.target]
            found += [
                (
                    RingPoint(pair.source, here.place_of(s)),
                    RingPoint(pair.target, there.place_of(t)),
                    float(confidence),
                )
                for s, t, confidence in zip(*match.marks(), strict=True)
            ]
        return found

    def mate(self, place: RingPoint) -> RingPoint:
        """Return the place on the target that belongs to one on the source.

        The mate of a corner is a corner wherever there is one like it.
        """
        known = {pair.source: (pair.target, match) for pair, match in self.rings}
        ring, match = known.get(place.ring, (min(place.ring, len(self.target.rings) - 1), None))
        here, there = measured(self.source)[place.ring], measured(self.target)[ring]
        if not here.perimeter > 0 or not there.perimeter > 0:
            return RingPoint(ring, 0.0)
        length = here.length_of(place.at)
        image = match.mate(length) if match else length / here.perimeter * there.perimeter
        return RingPoint(ring, there.place_of(image))

    def reversed(self) -> OutlineMatch:
        """Return the same match, seen from the target."""
        return OutlineMatch(
            self.target,
            self.source,
            tuple((pair.reversed(), match and match.reversed()) for pair, match in self.rings),
        )


def match_outlines(
    source: Outline, target: Outline, marks: Marks = (), ring: int | None = None
) -> OutlineMatch:
    """Match two outlines: the exteriors, then each hole with the one that lies where the exterior's
    match carries it; ``marks`` decide where there are any.

    With ``ring``, only as far as is needed to find the mates of places on that ring.
    """
    return OutlineMatch(
        source,
        target,
        tuple(
            (pair, _match(source, target, pair, _fixed(source, target, pair, marks)))
            for pair in _ring_pairs(source, target, marks, ring)
            if ring is None or pair.source == ring
        ),
    )


def mate(source: Outline, target: Outline, place: RingPoint, marks: Marks = ()) -> RingPoint:
    """Propose the place on the target that belongs to ``place`` on the source.

    It follows the match of both rings through the marks already set.
    """
    return match_outlines(source, target, marks, place.ring).mate(place)


def snap(outline: Outline, place: RingPoint, radius: float) -> RingPoint:
    """Return the node nearest to a place, within ``radius``, or the place itself."""
    ring = outline.rings[place.ring]
    away = ring.points - ring.position(place.at)
    distance = np.hypot(away[:, 0], away[:, 1])
    nearest = int(np.argmin(distance))
    return RingPoint(place.ring, float(nearest)) if distance[nearest] <= radius else place


def _ring_pairs(
    source: Outline, target: Outline, marks: Marks, ring: int | None = None
) -> list[RingPair]:
    """Return the rings that belong together, exteriors first; marks decide where there are any.

    Only the exteriors when just ``ring`` 0 is asked for: finding the holes takes time.
    """
    exteriors = RingPair(0, 0)
    exterior = _match(source, target, exteriors, _fixed(source, target, exteriors, marks))
    if ring == 0 or exterior is None:
        return [exteriors]
    known = {a.ring: b.ring for a, b in marks if a.ring > 0 and b.ring > 0}
    return [exteriors, *paired_holes(_rings(source), _rings(target), exterior, known)]


def _rings(outline: Outline) -> list[Array]:
    return [measure.polyline.points for measure in measured(outline)]


def _fixed(source: Outline, target: Outline, pair: RingPair, marks: Marks) -> tuple[Pair, ...]:
    """Return the marks on two rings as arc lengths."""
    here, there = measured(source)[pair.source], measured(target)[pair.target]
    return tuple(
        (here.length_of(a.at), there.length_of(b.at))
        for a, b in marks
        if (a.ring, b.ring) == (pair.source, pair.target)
    )


@lru_cache(maxsize=128)
def _match(
    source: Outline, target: Outline, pair: RingPair, fixed: tuple[Pair, ...]
) -> RingMatch | None:
    """Return the best match of two rings, not mirrored; none if one of them encloses nothing.

    Marks that lie on the match without them confirm it and spare another search: those that were
    proposed and accepted do.
    """
    free = _match(source, target, pair, ()) if fixed else None
    if free is not None and free.confirmed_by(fixed):
        return free.through(fixed)
    here, there = _rings(source)[pair.source], _rings(target)[pair.target]
    matches = match_rings(here, there, fixed, pair.rotation)
    return next((match for match in matches if not match.mirrored), None)
