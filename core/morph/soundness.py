"""Whether a span is sound: its map one to one, no frame folded or crossing, both ends as drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from time import perf_counter
from typing import Self

import numpy as np
import shapely

from core.geometry.crossing import crosses_itself, first_fault
from core.geometry.distance import departure, edges_of
from core.geometry.flatten import flatten
from core.geometry.polyline import diagonal
from core.model.outline import Array, Outline
from core.morph.morph import Morph
from core.morph.quality import folds
from core.morph.scene import Span
from core.progress import Progress, silent

END_TOLERANCE = 1e-9
"""Largest distance from a drawn outline, as a fraction of its diagonal."""


@dataclass(frozen=True, eq=False)
class FrameCheck:
    """One frame of a span."""

    frame: int
    folds: int
    """Triangles without positive area."""
    crossings: int
    """Pairs of boundary edges that cross; touching counts as one."""
    places: Array
    """(k, 2) where: the middle of each folded triangle, then each crossing."""
    seconds: float = 0.0
    """What it took to make."""

    @property
    def sound(self) -> bool:
        """Whether nothing is wrong."""
        return self.folds == self.crossings == 0


@dataclass(frozen=True, eq=False)
class SpanCheck:
    """All frames of a span, in order."""

    frames: tuple[FrameCheck, ...]
    source_error: float
    """Largest distance between at(0) and the drawn source, as a fraction of its diagonal."""
    target_error: float
    tolerance: float = END_TOLERANCE
    """How much of an error is no fault: outlines that were repaired are off by that."""
    one_to_one: bool = True
    """Whether the map from end to end is proved to be so."""

    @classmethod
    def of(cls, span: Span, morph: Morph, checks: Sequence[FrameCheck]) -> Self:
        """Take together what was seen in every frame, in any order, and look at the ends."""
        return cls(
            tuple(sorted(checks, key=attrgetter("frame"))),
            _end_error(span.source, morph, 0.0),
            _end_error(span.target, morph, 1.0),
            END_TOLERANCE + max((repair.moved for repair in morph.report.repairs), default=0.0),
            morph.report.certificate.holds,
        )

    @property
    def exact(self) -> bool:
        """Whether both ends are as drawn, but for the repairs."""
        return max(self.source_error, self.target_error) <= self.tolerance

    @property
    def sound(self) -> bool:
        """Whether nothing is wrong."""
        return self.exact and self.one_to_one and all(frame.sound for frame in self.frames)

    @property
    def seconds_per_frame(self) -> float:
        """What a frame took to make, on average."""
        return sum(frame.seconds for frame in self.frames) / max(len(self.frames), 1)


def check_span(
    span: Span,
    morph: Morph,
    frames: Sequence[tuple[int, float]],
    progress: Progress = silent,
) -> SpanCheck:
    """Look at a span's frames, in the order in which (number, s) lists them."""
    checks = []
    for done, (frame, s) in enumerate(frames):
        progress(done / len(frames), "checking")
        start = perf_counter()
        points = morph.at(s)
        seconds = perf_counter() - start
        checks.append(replace(check_frame(frame, morph, points), seconds=seconds))
    return SpanCheck.of(span, morph, checks)


def check_frame(frame: int, morph: Morph, points: Array) -> FrameCheck:
    """Look at one frame of a morph, whose vertices are at (n, 2) points."""
    folded = folds(points, morph.triangles)
    middles = points[morph.triangles[folded]].mean(axis=1)
    if not np.isfinite(points).all():  # nowhere to be found
        return FrameCheck(frame, len(folded), 0, middles[np.isfinite(middles).all(axis=1)])
    crossed = crossings([points[ring] for ring in morph.rings])
    return FrameCheck(frame, len(folded), len(crossed), np.concatenate([middles, crossed]))


def crossings(rings: Sequence[Array]) -> Array:
    """Return (k, 2) where closed polylines (k, 2), exterior first, cross themselves and others.

    Rings that only touch, or lie in the wrong place, count as one.
    """
    if not crosses_itself(rings):
        return np.empty((0, 2))
    segments = edges_of(rings)
    one, other = shapely.STRtree(segments).query(segments, predicate="crosses")
    once = one < other
    places = shapely.get_coordinates(
        shapely.intersection(segments[one[once]], segments[other[once]])
    )
    return places if len(places) else first_fault(rings)[1].reshape(-1, 2)


def _end_error(outline: Outline, morph: Morph, s: float) -> float:
    """Return how far a frame is from an outline, as a fraction of the outline's diagonal.

    All rings at once: the target's holes may have been drawn in another order than the source's.
    """
    points = morph.at(s)
    drawn = [line.points for line in flatten(outline)]
    found = [points[ring] for ring in morph.rings]
    return departure(drawn, found) / diagonal(np.concatenate(drawn))
