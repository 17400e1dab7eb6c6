"""The outline door: only finite, closed, simple polygons pass; small faults are repaired.

Everything behind it (triangulation, matching) relies on that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LinearRing, Polygon, STRtree
from shapely.validation import explain_validity

from core.errors import OutlineError, Repair, Where
from core.geometry.crossing import crosses_itself
from core.geometry.mend import BeyondRepair, Mended, mend, separate
from core.geometry.origin import Origin
from core.geometry.polyline import arc_lengths, reversed_ring, signed_area
from core.model.outline import Array

REPEAT = 1e-9
"""Vertices closer than this, as a fraction of the diagonal, are one vertex."""
FLAT = 1e-9
"""An outline whose hull has less area than this fraction of its squared diagonal is a line."""
SIZES = 1e-12, 1e15
"""Diagonals that can be computed with; squares and fourth powers must stay finite."""
COARSEST = 1e-6
"""Largest step between neighbouring numbers, as a fraction of the diagonal: far from the origin
few digits are left for the shape."""
MAX_LOSS = 0.02
"""Fraction of the area that a repair may take away."""


@dataclass(frozen=True, eq=False)
class CleanOutline:
    """Rings (n, 2) that are simple, disjoint and nested: exterior first with positive area, holes
    with negative area.
    """

    rings: tuple[Array, ...]
    origins: tuple[Origin, ...]
    """Where each ring's vertices were on the ring as given."""
    repairs: tuple[Repair, ...]
    """What had to be changed."""

    @property
    def area(self) -> float:
        """Enclosed area, holes taken off."""
        return sum(signed_area(ring) for ring in self.rings)

    @cached_property
    def diagonal(self) -> float:
        """Diagonal of the bounds."""
        return float(np.hypot(*np.ptp(self.rings[0], axis=0)))

    @cached_property
    def lengths(self) -> tuple[Array, ...]:
        """The arc lengths (n + 1,) of each ring's vertices, and of the whole."""
        return tuple(map(arc_lengths, self.rings))

    def length_of(self, ring: int, at: float) -> float:
        """Return the arc length on a ring of a place on the given one, counted in its vertices.

        A place that was cut off counts as the one where it was cut.
        """
        return float(np.interp(self.origins[ring].run(at), *self._runs[ring]))

    def vertex_of(self, ring: int, length: float) -> float:
        """Return the place on the given ring, counted in its vertices, of an arc length."""
        runs, lengths = self._runs[ring]
        return self.origins[ring].place(float(np.interp(length % lengths[-1], lengths, runs)))

    @cached_property
    def _runs(self) -> tuple[tuple[Array, Array], ...]:
        """The runs and the arc lengths (2n + 1,) at which each ring's vertices arrive and leave."""
        return tuple(
            (origin.runs(), np.append(np.repeat(lengths[:-1], 2), lengths[-1]))
            for origin, lengths in zip(self.origins, self.lengths, strict=True)
        )


def clean(rings: Sequence[Array], side: str) -> CleanOutline:
    """Check and repair an outline; ``side`` ("source", "target") names it in errors.

    ``rings`` are closed polylines (n, 2), exterior first. Where it touches itself it is opened by a
    hair, and spikes and small loops are cut off (see ``mend``); every other vertex stays to the
    last bit. Raises ``OutlineError`` when a ring is not finite, has fewer than three distinct
    vertices or no area, crosses itself or another ring beyond repair, or when a hole lies outside.
    """
    if not rings:
        raise OutlineError(f"The {side} has no ring.", where=Where(side), hint="Draw an outline.")
    drawn = [_finite(np.asarray(ring, float), side, i) for i, ring in enumerate(rings)]
    size = _size(drawn, side)
    repairs: list[Repair] = []
    kept = [_distinct(ring, size, side, i, repairs) for i, ring in enumerate(drawn)]
    origins = [Origin.of_kept(k, len(ring)) for k, ring in zip(kept, drawn, strict=True)]
    distinct = [ring[k] for k, ring in zip(kept, drawn, strict=True)]
    unit = _Unit(distinct[0][0], size)
    at_unit = [unit.inside(ring) for ring in distinct]
    if not _is_clean(at_unit):
        mended = _mended(at_unit, origins, unit, side)
        distinct, origins = _placed(mended, distinct, unit), list(mended.origins)
        repairs += _told(mended, at_unit, [unit.inside(r) for r in distinct], unit, side)
    turned = [(signed_area(ring) > 0) != (i == 0) for i, ring in enumerate(distinct)]
    return CleanOutline(
        tuple(reversed_ring(r) if t else r for r, t in zip(distinct, turned, strict=True)),
        tuple(o.reversed() if t else o for o, t in zip(origins, turned, strict=True)),
        tuple(repairs),
    )


@dataclass(frozen=True, eq=False)
class _Unit:
    """Coordinates in which tolerances and predicates mean the same for every outline."""

    origin: Array
    size: float

    def inside(self, points: Array) -> Array:
        return (points - self.origin) / self.size

    def outside(self, points: Array) -> Array:
        return self.origin + self.size * points

    def place(self, point: Array) -> tuple[float, float]:
        x, y = self.outside(point)
        return float(x), float(y)


def _name(side: str, index: int) -> str:
    return f"{side} hole {index}" if index else f"{side} outline"


def _finite(ring: Array, side: str, index: int) -> Array:
    name = _name(side, index)
    if ring.ndim != 2 or ring.shape[1] != 2:
        raise OutlineError(f"The {name} is not a list of (x, y) points.", where=Where(side, index))
    bad = np.flatnonzero(~np.isfinite(ring).all(axis=1))
    if len(bad):
        raise OutlineError(
            f"Node {bad[0]} of the {name} is not a finite number.",
            where=Where(side, index, int(bad[0])),
            hint="Correct or delete that node.",
        )
    return ring


def _size(rings: Sequence[Array], side: str) -> float:
    """Return the diagonal; refuse what cannot be computed with."""
    points = np.concatenate(rings)
    if not len(points):
        return 0.0
    with np.errstate(over="ignore"):
        size = float(np.hypot(*np.ptp(points, axis=0)))
    if size == 0:
        return size
    if not SIZES[0] <= size <= SIZES[1]:
        raise OutlineError(
            f"The {side} is {size:.3g} wide, outside {SIZES[0]:g} to {SIZES[1]:g}.",
            where=Where(side),
            hint="Scale it.",
        )
    far = float(np.abs(points).max())
    if np.spacing(far) > COARSEST * size:
        raise OutlineError(
            f"The {side} is {size:.3g} wide and {far:.3g} away from the origin, where numbers are"
            f" {np.spacing(far):.1g} apart: too coarse for its shape.",
            where=Where(side),
            hint="Move it closer to the origin.",
        )
    return size


def check_together(ends: Sequence[CleanOutline]) -> None:
    """Refuse outlines of which one is too small beside where the other lies: in-betweens of it
    could not be told from each other.
    """
    far = max(float(np.abs(end.rings[0]).max()) for end in ends)
    small = min(end.diagonal for end in ends)
    if np.spacing(far) > COARSEST * small:
        raise OutlineError(
            f"One outline is {small:.3g} wide, and the other reaches to {far:.3g}, where numbers"
            f" are {np.spacing(far):.1g} apart: too coarse for frames between them.",
            hint="Make them more alike in size, and move them closer to the origin.",
        )


def _distinct(
    ring: Array, size: float, side: str, index: int, repairs: list[Repair]
) -> NDArray[np.int64]:
    """Return the vertices to keep, the last of each run of repeats; refuse what has no area."""
    name = _name(side, index)
    step = np.roll(ring, -1, axis=0) - ring
    length = np.hypot(step[:, 0], step[:, 1])
    kept = np.flatnonzero(length > REPEAT * size)
    if len(kept) < 3:
        raise OutlineError(
            f"The {name} has {len(kept)} distinct points; it needs at least 3.",
            where=Where(side, index, point=_point(ring)),
            hint="Add nodes, or draw it anew.",
        )
    repeated = length <= REPEAT * size
    if repeated.any():
        repairs.append(
            Repair(
                f"The {name} has {repeated.sum()} repeated points",
                "left out",
                Where(side, index),
                float(length[repeated].max()) / size,
            )
        )
    own = float(np.hypot(*np.ptp(ring, axis=0)))
    if Polygon(ring[kept]).convex_hull.area < FLAT * own**2:
        raise _no_area(ring[kept], side, index)
    return kept


def _no_area(ring: Array, side: str, index: int) -> OutlineError:
    return OutlineError(
        f"The {_name(side, index)} encloses no area.",
        where=Where(side, index, point=_point(ring)),
        hint="Move its nodes apart, or draw it anew.",
    )


def _is_clean(rings: Sequence[Array]) -> bool:
    return not crosses_itself(rings) and separate(rings)


def _mended(rings: Sequence[Array], origins: Sequence[Origin], unit: _Unit, side: str) -> Mended:
    """Mend rings at unit size; refuse when that would change the shape."""
    try:
        return mend(rings, origins, MAX_LOSS * abs(signed_area(rings[0])))
    except BeyondRepair as problem:
        if problem.flat is not None:
            raise _no_area(unit.outside(rings[problem.flat]), side, problem.flat) from None
        raise _wrong(rings, unit, side) from None


def _placed(mended: Mended, drawn: Sequence[Array], unit: _Unit) -> list[Array]:
    """Return mended rings where they were drawn; vertices that stayed do so to the last bit."""
    vertices = np.concatenate(drawn)
    return [
        np.where((index >= 0)[:, None], vertices[index], unit.outside(ring))
        for ring, index in zip(mended.rings, mended.vertices, strict=True)
    ]


def _told(
    mended: Mended, before: Sequence[Array], after: Sequence[Array], unit: _Unit, side: str
) -> list[Repair]:
    """Put what was mended into words."""
    moved = _farthest(before, after)
    share = 100 * mended.lost / abs(signed_area(after[0]))
    told = []
    for places, what, end in (
        (mended.touches, "touches itself", f"opened by {mended.hair * unit.size:.2g} there"),
        (mended.spikes, "has a spike without area", "cut off there"),
        (mended.loops, "crosses itself", f"a loop of {share:.2g} % of the area cut off there"),
    ):
        if len(places):
            more = f" and in {len(places) - 1} more" if len(places) > 1 else ""
            where = Where(side, point=unit.place(places[0]))
            told.append(Repair(f"The {side} {what}", f"{end}{more}", where, moved))
    return told


def _farthest(before: Sequence[Array], after: Sequence[Array]) -> float:
    """Return the largest distance of the vertices of either outline from the other's edges."""
    return max(_distance(before, after), _distance(after, before))


def _distance(rings: Sequence[Array], others: Sequence[Array]) -> float:
    edges = np.concatenate([np.stack([r, np.roll(r, -1, axis=0)], axis=1) for r in others])
    points = shapely.points(np.concatenate(rings))
    _, distance = STRtree(shapely.linestrings(edges)).query_nearest(
        points, return_distance=True, all_matches=False
    )
    return float(distance.max())


def _wrong(rings: Sequence[Array], unit: _Unit, side: str) -> OutlineError:
    """Say what is beyond repair."""
    problem = explain_validity(Polygon(rings[0], rings[1:]))
    point = _place(problem) if "[" in problem else rings[0][0]
    here, (x, y) = _rings_at(rings, point), unit.place(point)
    where = Where(side, ring=here[-1], point=(x, y))
    near, hole = f"near ({x:.4g}, {y:.4g})", f"Hole {here[-1]} of the {side}"
    apart = "Make it a shape of its own, on a layer of its own."
    if problem.startswith("Hole lies outside"):
        return OutlineError(
            f"{hole} lies outside the outline {near}.",
            where=where,
            hint=f"Move it inside, or delete it. {apart}",
        )
    if problem.startswith("Holes are nested"):
        return OutlineError(f"{hole} lies inside another hole {near}.", where=where, hint=apart)
    if len(here) > 1:
        what = f"Hole {here[0]} crosses hole" if here[0] else "The outline crosses hole"
        return OutlineError(
            f"{what} {here[1]} of the {side} {near}.",
            where=where,
            hint="Move them apart there.",
        )
    return OutlineError(
        f"The {_name(side, here[0])} crosses itself {near}.",
        where=where,
        hint="Move the nodes there so that the edges no longer cross.",
    )


def _rings_at(rings: Sequence[Array], point: Array) -> list[int]:
    """Return the rings that run through a point, or at least the nearest."""
    distance = shapely.distance([LinearRing(ring) for ring in rings], shapely.points(point))
    return [int(i) for i in np.flatnonzero(distance <= max(1e-6, distance.min()))]


def _point(ring: Array) -> tuple[float, float] | None:
    return (float(ring[0, 0]), float(ring[0, 1])) if len(ring) else None


def _place(problem: str) -> Array:
    """Read the coordinates in "Self-intersection[x y]"."""
    return np.array([float(x) for x in problem.rsplit("[", 1)[-1].rstrip("]").split()[:2]])
