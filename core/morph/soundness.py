"""Whether a span's frames are sound: nothing folded, nothing crossing, both ends as drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np
import shapely

from core.geometry.flatten import flatten
from core.model.outline import Array, Outline
from core.morph.morph import Morph
from core.morph.quality import crosses_itself, folds
from core.morph.scene import Span

END_TOLERANCE = 1e-9
"""Largest distance from a drawn outline, as a fraction of its diagonal."""


@dataclass(frozen=True)
class FrameCheck:
    """One frame of a span."""

    frame: int
    folds: int
    """Triangles without positive area."""
    crossings: int
    """Pairs of boundary edges that cross; touching counts as one."""


@dataclass(frozen=True)
class SpanCheck:
    """All frames of a span."""

    frames: tuple[FrameCheck, ...]
    source_error: float
    """Largest distance between at(0) and the drawn source, as a fraction of its diagonal."""
    target_error: float
    seconds_per_frame: float

    @property
    def sound(self) -> bool:
        """Whether nothing is wrong."""
        clean = all(frame.folds == frame.crossings == 0 for frame in self.frames)
        return clean and max(self.source_error, self.target_error) <= END_TOLERANCE


def check_span(span: Span, morph: Morph, progress: Sequence[tuple[int, float]]) -> SpanCheck:
    """Look at a span's frames; ``progress`` lists their numbers and their s."""
    checks, seconds = [], 0.0
    for frame, s in progress:
        start = perf_counter()
        points = morph.at(s)
        seconds += perf_counter() - start
        rings = [points[ring] for ring in morph.rings]
        checks.append(FrameCheck(frame, len(folds(points, morph.triangles)), crossings(rings)))
    return SpanCheck(
        tuple(checks),
        _end_error(span.source, morph, 0.0),
        _end_error(span.target, morph, 1.0),
        seconds / max(len(checks), 1),
    )


def crossings(rings: Sequence[Array]) -> int:
    """Count the crossings of closed polylines (k, 2), exterior first, with themselves and others.

    Rings that only touch, or lie in the wrong place, count as one.
    """
    if not crosses_itself(rings):
        return 0
    edges = np.concatenate([np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings])
    segments = shapely.linestrings(edges)
    pairs = shapely.STRtree(segments).query(segments, predicate="crosses")
    return max(pairs.shape[1] // 2, 1)


def _end_error(outline: Outline, morph: Morph, s: float) -> float:
    """Measure both ways, so that a cut corner counts as well as a vertex that strays.

    All rings at once: the target's holes may have been drawn in another order than the source's.
    """
    points = morph.at(s)
    drawn = [line.points for line in flatten(outline)]
    found = [points[ring] for ring in morph.rings]
    left, top, right, bottom = outline.bounds()
    size = float(np.hypot(right - left, bottom - top))
    return max(_farthest(drawn, found), _farthest(found, drawn)) / size


def _farthest(rings: Sequence[Array], others: Sequence[Array]) -> float:
    """Return the largest distance of a vertex of rings (k, 2) from the edges of others."""
    edges = shapely.multilinestrings([shapely.linearrings(ring) for ring in others])
    return float(shapely.distance(shapely.points(np.concatenate(rings)), edges).max())
