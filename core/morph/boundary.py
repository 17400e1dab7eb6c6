"""Boundary correspondence: marks split both outlines into arcs, arc length spreads the rest.

Inside an arc a vertex keeps its fraction of the arc's length (Song 2013, fig. 5). The vertices of
both outlines are used, so that both ends are exactly what was drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.errors import MarkError, Where
from core.geometry.polyline import arc_lengths, inner_angles, points_at
from core.geometry.triangulation import Indices
from core.model.outline import Array

SNAP = 0.2
"""Source and target vertices closer than this fraction of the spacing become one: more would tell
in the distortion, less in the angles."""
NARROW, BESIDE = np.radians(22), 0.75
"""A corner narrower than this is not to be shared by two triangles, so it becomes one with a corner
of the other outline, if there is any within this fraction of the spacing."""
STEEP = 5.0
"""How much longer than its neighbour an edge may be."""
MOST_SPLITS = 64
"""Each quarters longer edges, and shifts the excess to the next: more than any outline takes."""
COINCIDENT = 1e-7
"""Marks closer than this fraction of the perimeter lie on top of each other."""
HAIR = 1e-9
"""A mark within this fraction of the perimeter beside a vertex is at it: marks are rounded."""
EQUAL = 1e-12
"""Arc lengths that differ by less than this fraction of the perimeter do so by rounding."""


@dataclass(frozen=True, eq=False)
class BoundaryPair:
    """Corresponding boundary vertices of one ring."""

    source: Array
    """(k, 2)"""
    target: Array
    """(k, 2)"""


@dataclass(frozen=True, eq=False)
class MatchedRing:
    """A ring of both outlines, and where the marks lie on it."""

    source: Array
    """(n, 2) clean ring."""
    target: Array
    """(k, 2) clean ring."""
    source_marks: Array
    """(j,) arc lengths."""
    target_marks: Array
    """(j,) arc lengths, in the same order."""
    marks: tuple[int, ...] = ()
    """(j,) indices of the artist's marks, to name them in errors; empty if these are proposals."""

    def indices(self, which: Sequence[int] | Indices) -> tuple[int, ...]:
        """Return the indices of some of the artist's marks, in order."""
        return tuple(sorted(self.marks[i] for i in which)) if self.marks else ()

    def names(self, which: Sequence[int] | Indices, labels: Sequence[str]) -> list[str]:
        """Name some marks: proposals by their numbers."""
        return [labels[self.marks[i]] if self.marks else f"{i + 1}" for i in which]


def correspond(
    ring: MatchedRing, spacing: tuple[float, float], labels: Sequence[str]
) -> BoundaryPair:
    """Return the common vertices of one ring, no further apart than ``spacing`` (source, target).

    Needs at least one mark. ``labels`` name the artist's marks. Raises ``MarkError`` when marks
    coincide or their cyclic order differs on the two outlines.
    """
    order = np.argsort(ring.source_marks, kind="stable")
    order = np.roll(order, -int(np.argmin(order)))  # from the first mark, wherever the list starts
    _check_apart(ring, labels)
    _check_order(ring, order, labels)
    outlines = ring.source, ring.target
    marks = (
        _at_vertices(ring.source, ring.source_marks),
        _at_vertices(ring.target, ring.target_marks),
    )
    reach = SNAP * np.minimum(spacing, [_median_edge(points) for points in outlines])
    source, target = map(_Curve, outlines, (at[order[0]] for at in marks))
    anchors = np.column_stack([at[order] - at[order[0]] for at in marks])
    anchors = np.mod(anchors, [source.perimeter, target.perimeter])
    anchors = _pointed(anchors, source, target, BESIDE * np.array(spacing))
    anchors = _joined(anchors, source, target, reach)
    pairs = _densified(_union(anchors, source, target), source, target, spacing)
    pairs = _graded(pairs, source, target)
    return BoundaryPair(source.points_at(pairs[:, 0]), target.points_at(pairs[:, 1]))


class _Curve:
    """A closed polyline whose arc length starts at a given place."""

    def __init__(self, points: Array, start: float) -> None:
        self._points, self._lengths = points, arc_lengths(points)
        self._start = start
        self.perimeter = float(self._lengths[-1])
        from_start = np.mod(self._lengths[:-1] - start, self.perimeter)
        from_start[self.perimeter - from_start < EQUAL * self.perimeter] = 0.0
        order = np.argsort(from_start, kind="stable")
        self.vertices = from_start[order]
        """(n,) increasing arc lengths of the vertices."""
        self._corners = points[order]
        self.angles = inner_angles(points)[order]
        """(n,) radians inside the outline, at its vertices."""

    def points_at(self, at: Array) -> Array:
        """Return the points (k, 2) at arc lengths (k,); a vertex's own gives it to the last bit."""
        points = points_at(self._points, self._lengths, at + self._start)
        nearest = np.clip(np.searchsorted(self.vertices, at), 0, len(self.vertices) - 1)
        for i in (nearest, nearest - 1):
            same = np.abs(self.vertices[i] - at) <= EQUAL * self.perimeter
            points[same] = self._corners[i[same]]
        return points


def _at_vertices(points: Array, at: Array) -> Array:
    """Return arc lengths (j,) with those a hair beside a vertex set to the vertex's own."""
    lengths = arc_lengths(points)
    nearest = _nearest(at, lengths)
    beside = np.abs(lengths[nearest] - at) < HAIR * lengths[-1]
    return np.where(beside, lengths[nearest], at)


def _check_apart(ring: MatchedRing, labels: Sequence[str]) -> None:
    for side, points, at in (
        ("source", ring.source, ring.source_marks),
        ("target", ring.target, ring.target_marks),
    ):
        lengths = arc_lengths(points)
        order = np.argsort(at)
        gap = np.diff(np.append(at[order], at[order[0]] + lengths[-1]))
        close = np.flatnonzero(gap < COINCIDENT * lengths[-1])
        if len(at) > 1 and len(close):
            pair = sorted((order[close[0]], order[(close[0] + 1) % len(order)]))
            place = points_at(points, lengths, at[pair[:1]])[0]
            raise MarkError(
                f"Marks {' and '.join(ring.names(pair, labels))} lie on the same point"
                f" of the {side}.",
                where=Where(
                    side, point=(float(place[0]), float(place[1])), marks=ring.indices(pair)
                ),
                hint="Drag one of them away, or remove it.",
            )


def _check_order(ring: MatchedRing, order: Indices, labels: Sequence[str]) -> None:
    """Find a mark whose removal helps, the newest first, to name it rather than all of them."""
    along = ring.target_marks[order]
    if _descents(along) <= 1:
        return
    for i in np.argsort(order)[::-1]:
        if _descents(np.delete(along, i)) <= 1:
            wrong = [int(order[i])]
            break
    else:
        wrong = list(range(len(order)))
    if len(along) > 2 and _descents(along[::-1]) <= 1:
        raise MarkError(
            "The marks run backwards around the target, so the shape would be turned inside out.",
            where=Where("target", marks=ring.indices(order)),
            hint="Mirror the target, or set its marks in the same direction as on the source.",
        )
    here, there = (
        " ".join(ring.names(np.argsort(at), labels))
        for at in (ring.source_marks, ring.target_marks)
    )
    place = points_at(ring.target, arc_lengths(ring.target), ring.target_marks[wrong[:1]])[0]
    raise MarkError(
        f"Marks run in another order around the target ({there}) than around the source ({here}).",
        where=Where("target", point=(float(place[0]), float(place[1])), marks=ring.indices(wrong)),
        hint=f"Move or remove mark{'s'[: len(wrong) > 1]} {', '.join(ring.names(wrong, labels))}.",
    )


def _descents(values: Array) -> int:
    """Count how often a cyclic sequence falls: once if it is in cyclic order."""
    return int(np.sum(np.roll(values, -1) <= values)) if len(values) > 1 else 0


def _closed(anchors: Array, source: _Curve, target: _Curve) -> Array:
    return np.vstack([anchors, [[source.perimeter, target.perimeter]]])


def _pointed(anchors: Array, source: _Curve, target: _Curve, reach: Array) -> Array:
    """Add corners of both outlines as anchors (k, 2) where one of them is narrow.

    It then belongs to a single triangle, unless the other is too blunt. The narrowest come first.
    """
    ways = (source, target, slice(None)), (target, source, slice(None, None, -1))
    narrow = [
        (angle, at, other, way)
        for curve, other, way in ways
        for angle, at in zip(curve.angles, curve.vertices, strict=True)
        if angle < NARROW
    ]
    for angle, at, other, way in sorted(narrow, key=lambda corner: corner[:2]):
        here, there = _closed(anchors, source, target)[:, way].T
        if not len(_between(np.array([at]), here)[0]):
            continue
        image, back = np.interp(at, here, there), np.interp(other.vertices, there, here)
        away = np.column_stack([back - at, other.vertices - image])[:, way]
        after = np.searchsorted(here, at)
        inside = there[after - 1 : after + 1] + EQUAL * there[-1] * np.array([1, -1])
        near = (inside[0] < other.vertices) & (other.vertices < inside[1])
        near &= (np.abs(away) <= reach).all(axis=1)
        left = np.minimum(np.minimum(angle, other.angles), (np.pi - other.angles) / 2)
        best = np.lexsort((other.angles, -np.where(near, left, 0)))[0]
        if near[best] and left[best] > angle / 2:
            pair = np.array([at, other.vertices[best]])[way]
            anchors = np.insert(anchors, np.searchsorted(anchors[:, 0], pair[0]), pair, axis=0)
    return anchors


def _joined(anchors: Array, source: _Curve, target: _Curve, reach: Array) -> Array:
    """Add vertices of both outlines that nearly meet as anchors (k, 2), so that no slivers arise.

    Two are joined when each is the other's nearest of those left between the same anchors, and
    within reach on both outlines. That moves their neighbours, which may then meet, too.
    """
    while True:
        ends = _closed(anchors, source, target)
        (a, b), (arc, arc_b) = zip(
            *(_between(curve.vertices, ends[:, k]) for k, curve in enumerate((source, target))),
            strict=True,
        )
        if not (len(a) and len(b)):
            return anchors
        on_source, on_target = np.interp(b, *ends.T[::-1]), np.interp(a, *ends.T)
        i = np.arange(len(a))
        j = _nearest(a, on_source)
        mutual = (_nearest(on_source, a)[j] == i) & (arc == arc_b[j])
        gaps = np.abs(np.column_stack([a - on_source[j], on_target - b[j]]))
        i = np.flatnonzero(mutual & (gaps <= reach).all(axis=1))
        if not len(i):
            return anchors
        anchors = np.vstack([anchors, np.column_stack([a[i], b[j[i]]])])
        anchors = anchors[np.argsort(anchors[:, 0], kind="stable")]


def _between(places: Array, ends: Array) -> tuple[Array, Indices]:
    """Return the places (k,) that are not at one of the ends, and after which end each lies."""
    margin = EQUAL * ends[-1]
    arc = np.searchsorted(ends, places - margin, side="right")
    inside = np.searchsorted(ends, places + margin, side="right") == arc
    return places[inside], arc[inside]


def _median_edge(points: Array) -> float:
    return float(np.median(np.diff(arc_lengths(points))))


def _nearest(a: Array, b: Array) -> Indices:
    """Return, for each of sorted a, the index of the nearest of sorted b."""
    right = np.clip(np.searchsorted(b, a), 0, len(b) - 1)
    left = np.maximum(right - 1, 0)
    return np.where(np.abs(b[left] - a) <= np.abs(b[right] - a), left, right)


def _union(anchors: Array, source: _Curve, target: _Curve) -> Array:
    """Return arc lengths (k, 2) on the source and the target: one row for each vertex of either."""
    here, there = _closed(anchors, source, target).T
    (a, _), (b, _) = _between(source.vertices, here), _between(target.vertices, there)
    from_source = np.column_stack([a, np.interp(a, here, there)])
    from_target = np.column_stack([np.interp(b, there, here), b])
    merged = np.vstack([anchors, from_source, from_target])
    return merged[np.lexsort((merged[:, 1], merged[:, 0]))]


def _densified(pairs: Array, source: _Curve, target: _Curve, spacing: tuple[float, float]) -> Array:
    """Split steps that are longer than the spacing on either outline into equal parts."""
    ends = _closed(pairs, source, target)
    step = np.diff(ends, axis=0)
    parts = np.maximum(np.ceil((step / np.array(spacing) - 1e-9).max(axis=1)), 1).astype(int)
    start = np.repeat(np.arange(len(pairs)), parts)
    within = np.arange(len(start)) - np.repeat(np.cumsum(parts) - parts, parts)
    return ends[start] + (within / parts[start])[:, None] * step[start]


def _graded(pairs: Array, source: _Curve, target: _Curve) -> Array:
    """Split steps that are much longer than the one beside them, on either outline.

    Between a short edge and a long one no triangle has wide angles at both.
    """
    for _ in range(MOST_SPLITS):
        ends = _closed(pairs, source, target)
        step = np.diff(ends, axis=0)
        after_short = step > STEEP * np.roll(step, 1, axis=0)
        before_short = step > STEEP * np.roll(step, -1, axis=0)
        cut = np.flatnonzero((after_short | before_short).any(axis=1))
        if not len(cut):
            break
        share = np.where(after_short, 0.25, np.where(before_short, 0.75, 0.5))
        pairs = np.insert(pairs, cut + 1, (pairs + share * step)[cut], axis=0)
    return pairs
