"""Which boundaries belong together: by the marks where there are some, by proposals elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Self

import numpy as np

from core.errors import MarkError, Where
from core.geometry.clean_outline import CleanOutline
from core.geometry.places import measured
from core.geometry.polyline import arc_lengths, points_at
from core.model import Outline, RingPoint
from core.model.outline import Array
from core.morph.boundary import BoundaryPair, MatchedRing, correspond
from core.morph.marks.holes import RingPair, paired_holes
from core.morph.marks.rings import RingMatch, match_rings, mirror_is_better
from core.morph.shift import best_shift, farthest_out
from core.progress import Watch, unwatched

OFF_OUTLINE = 1e-3
"""How far a repair may leave a mark from the outline, as a fraction of its size."""


@dataclass(frozen=True)
class PlacedMark:
    """A mark on the cleaned rings."""

    rings: tuple[int, int]
    """On the source and on the target."""
    lengths: tuple[float, float]
    index: int


@dataclass(frozen=True)
class ProposedMark:
    """A pair of places on the cleaned rings that belong together as far as one can tell."""

    rings: tuple[int, int]
    lengths: tuple[float, float]
    confidence: float
    """In [0, 1]: high at corners that are alike, low along smooth arcs."""


@dataclass(frozen=True, eq=False)
class MarkedRing:
    """A ring of both outlines with marks: those of the artist, or proposals."""

    ring: MatchedRing
    proposed: tuple[ProposedMark, ...] = ()
    """Its marks, if the artist gave none, and …"""
    match: RingMatch | None = None
    """… where they are from."""

    def slid(self, places: Array) -> MarkedRing:
        """Return the ring with proposals that lead nearest to pairs of places (k, 2).

        They are fractions of the perimeters from the first mark on. Marks of the artist stay.
        """
        if self.match is None:
            return self
        ring, first = self.ring, [self.ring.source_marks[0], self.ring.target_marks[0]]
        match = self.match.along(first + places * self.match.perimeters)
        return _proposed(ring.source, ring.target, self.proposed[0].rings, match)


@dataclass(frozen=True, eq=False)
class Matching:
    """How all rings belong together."""

    rings: Sequence[MarkedRing]
    mirror: bool = False
    """Whether the exterior would match the target's mirror image far better."""


@dataclass(frozen=True, eq=False)
class Correspondence:
    """Which boundaries belong together."""

    matching: Matching
    boundaries: list[BoundaryPair]
    """Ring by ring."""
    spacing: tuple[float, float]
    """How far apart their vertices are at most."""
    labels: Sequence[str]
    """Names of the marks."""

    @classmethod
    def of(cls, matching: Matching, spacing: tuple[float, float], labels: Sequence[str]) -> Self:
        """Split the boundaries; raises ``MarkError`` where marks contradict each other."""
        boundaries = [correspond(each.ring, spacing, labels) for each in matching.rings]
        return cls(matching, boundaries, spacing, labels)

    def slid(self, places: Sequence[Array]) -> Correspondence:
        """Return the correspondence whose proposed marks lead nearest to pairs of places (k, 2).

        They are given ring by ring, as fractions of the perimeters from the first vertex of the
        boundary on. Marks of the artist stay. Raises ``MarkError`` where that is not possible.
        """
        rings = [each.slid(at) for each, at in zip(self.matching.rings, places, strict=True)]
        return Correspondence.of(replace(self.matching, rings=rings), self.spacing, self.labels)

    @property
    def proposed(self) -> tuple[ProposedMark, ...]:
        """The marks that were set on the rings on which there were none."""
        return tuple(mark for each in self.matching.rings for mark in each.proposed)


@dataclass(frozen=True, eq=False)
class Way:
    """A way in which the outlines may belong together."""

    misfit: float
    """How ill the exteriors match: 0 is perfect, 1 is poor; 0 if the artist matched them."""
    follow: Callable[[], Correspondence | None]
    """Works it out; None where proposals contradict each other. May raise ``MarkError``."""


def place_marks(
    outlines: tuple[Outline, Outline],
    ends: tuple[CleanOutline, CleanOutline],
    marks: Sequence[tuple[RingPoint, RingPoint]],
    labels: Sequence[str],
) -> list[PlacedMark]:
    """Find the marks on the cleaned rings; raises ``MarkError`` for those that are not on them."""
    placed = []
    partner: dict[int, int] = {0: 0}
    for index, pair in enumerate(marks):
        lengths = []
        for side, outline, place, end in zip(
            ("source", "target"), outlines, pair, ends, strict=True
        ):
            measure = measured(outline)[place.ring]
            length = end.length_of(place.ring, measure.vertex_of(place.at))
            point = measure.point_at(place.at)
            if _strayed(end, place.ring, length, point):
                raise MarkError(
                    f"Mark {labels[index]} lies on a part of the {side} that had to be cut off.",
                    where=Where(side, point=(float(point[0]), float(point[1])), marks=(index,)),
                    hint="Move the mark, or mend the outline there.",
                )
            lengths.append(length)
        rings = pair[0].ring, pair[1].ring
        taken = rings[0] not in partner and rings[1] in partner.values()
        if taken or partner.setdefault(*rings) != rings[1]:
            raise MarkError(
                f"Mark {labels[index]} joins {_ring(rings[0])} of the source to {_ring(rings[1])}"
                " of the target, but another mark or the kind of ring says otherwise.",
                where=Where("target", ring=rings[1], marks=(index,)),
                hint="Move it to the matching ring.",
            )
        placed.append(PlacedMark(rings, (lengths[0], lengths[1]), index))
    return placed


def _strayed(end: CleanOutline, ring: int, length: float, point: Array) -> bool:
    """Whether an arc length lies off the point that it stands for."""
    away = points_at(end.rings[ring], end.lengths[ring], np.array([length]))[0] - point
    return bool(np.hypot(*away) > OFF_OUTLINE * end.diagonal)


def unplace_marks(
    proposed: Sequence[ProposedMark],
    outlines: tuple[Outline, Outline],
    ends: tuple[CleanOutline, CleanOutline],
) -> tuple[tuple[RingPoint, RingPoint, float], ...]:
    """Return where proposed marks lie on the outlines as they were drawn, with their confidence."""

    def place(mark: ProposedMark, side: int) -> RingPoint:
        ring = mark.rings[side]
        vertex = ends[side].vertex_of(ring, mark.lengths[side])
        return RingPoint(ring, measured(outlines[side])[ring].place_at_vertex(vertex))

    return tuple((place(mark, 0), place(mark, 1), mark.confidence) for mark in proposed)


def ways(
    source: CleanOutline,
    target: CleanOutline,
    marks: Sequence[PlacedMark],
    labels: Sequence[str],
    density: int,
    watch: Watch = unwatched,
) -> Iterator[Way]:
    """Yield ways in which boundaries may belong together, the most likely first.

    With marks on the exterior they decide, and there is just one. The edges are split to the
    exteriors' perimeters over ``density``. ``watch(stage)`` is called between steps and may raise
    ``Cancelled``.
    """
    here, there = (float(end.lengths[0][-1]) / density for end in (source, target))
    given = any(mark.rings[0] == 0 for mark in marks)

    def follow(matching: Callable[[], Matching]) -> Correspondence | None:
        try:
            return Correspondence.of(matching(), (here, there), labels)
        except MarkError:
            if given:
                raise
            return None  # it was a proposal, and there are others

    for misfit, matching in _matchings(source, target, marks, watch):
        yield Way(misfit, partial(follow, matching))


def _matchings(
    source: CleanOutline, target: CleanOutline, marks: Sequence[PlacedMark], watch: Watch
) -> Iterator[tuple[float, Callable[[], Matching]]]:
    """Yield how ill the exteriors match, and what works the matching out."""
    a, b = source.rings[0], target.rings[0]
    exterior = [mark for mark in marks if mark.rings == (0, 0)]
    fixed = [mark.lengths for mark in exterior]
    found: list[RingMatch] = []
    if not exterior or len(source.rings) > 1:
        found = match_rings(a, b, fixed, watch=watch)
    proposals = [match for match in found if not match.mirrored]

    def matching(match: RingMatch | None) -> Matching:
        holes = _holes(source, target, marks, match, watch)
        if exterior:
            return Matching([_marked(source, target, exterior), *holes])
        ring = _proposed(a, b, (0, 0), match or _shifted(a, b, RingPair(0, 0)))
        return Matching([ring, *holes], mirror_is_better(found))

    if exterior:
        yield 0.0, partial(matching, next(iter(proposals), None))
        return
    for match in proposals:
        yield match.cost, partial(matching, match)
    yield max((match.cost for match in proposals), default=1.0), partial(matching, None)


def _holes(
    source: CleanOutline,
    target: CleanOutline,
    marks: Sequence[PlacedMark],
    exterior: RingMatch | None,
    watch: Watch,
) -> list[MarkedRing]:
    """Match the holes, each by its marks, or else by what the exterior's match says of it."""
    known = {mark.rings[0]: mark.rings[1] for mark in marks if mark.rings[0] > 0}
    if exterior is not None:
        watch("holes")
        pairs = paired_holes(source.rings, target.rings, exterior, known)
    else:
        free = iter(j for j in range(1, len(target.rings)) if j not in known.values())
        pairs = [RingPair(i, known.get(i) or next(free)) for i in range(1, len(source.rings))]
    matched = []
    for pair in sorted(pairs, key=lambda pair: pair.source):
        here = [mark for mark in marks if mark.rings == (pair.source, pair.target)]
        if here:
            matched.append(_marked(source, target, here))
            continue
        a, b = source.rings[pair.source], target.rings[pair.target]
        matches = match_rings(a, b, (), pair.rotation, watch)
        found = [match for match in matches if not match.mirrored]
        best = found[0] if found else _shifted(a, b, pair)
        matched.append(_proposed(a, b, (pair.source, pair.target), best))
    return matched


def _marked(source: CleanOutline, target: CleanOutline, marks: Sequence[PlacedMark]) -> MarkedRing:
    i, j = marks[0].rings
    here, there = np.array([mark.lengths for mark in marks]).T
    names = tuple(mark.index for mark in marks)
    return MarkedRing(MatchedRing(source.rings[i], target.rings[j], here, there, names))


def _proposed(source: Array, target: Array, rings: tuple[int, int], match: RingMatch) -> MarkedRing:
    """Count proposed marks from the farthest out, so that the start vertex does not matter."""
    here, there, confidence = match.marks()
    first = farthest_out(points_at(source, arc_lengths(source), here), source)
    here, there, confidence = (np.roll(v, -first) for v in (here, there, confidence))
    proposed = tuple(
        ProposedMark(rings, (s, t), c)
        for s, t, c in zip(here.tolist(), there.tolist(), confidence.tolist(), strict=True)
    )
    return MarkedRing(MatchedRing(source, target, here, there), proposed, match)


def _shifted(source: Array, target: Array, pair: RingPair) -> RingMatch:
    """Match by arc length from the best cyclic shift on; nothing is sure about it."""
    return RingMatch.by_length(source, target, best_shift(source, target, pair.rotation))


def _ring(index: int) -> str:
    return f"hole {index}" if index else "the exterior"
