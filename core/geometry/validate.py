"""The outline door: only finite, closed, simple polygons pass; small faults are repaired.

Everything behind it (triangulation, matching) relies on that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from shapely import LinearRing, MultiPolygon, Polygon, make_valid
from shapely.validation import explain_validity

from core.errors import OutlineError, Where
from core.geometry.polyline import signed_area
from core.model.outline import Array

REPEAT = 1e-9
"""Vertices closer than this, as a fraction of the diagonal, are one vertex."""
FLAT = 1e-9
"""An outline whose hull has less area than this fraction of its squared diagonal is a line."""
SIZES = 1e-12, 1e15
"""Diagonals that can be computed with; squares and fourth powers must stay finite."""
MAX_LOSS = 0.02
"""Fraction of the area that a repair may take away or add."""


@dataclass(frozen=True, eq=False)
class CleanOutline:
    """Rings (n, 2) that are simple, disjoint and nested: exterior first with positive area, holes
    with negative area.
    """

    rings: tuple[Array, ...]
    repairs: tuple[str, ...]
    """What had to be changed, in words."""

    @property
    def area(self) -> float:
        """Enclosed area, holes taken off."""
        return sum(signed_area(ring) for ring in self.rings)

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounds."""
        return float(np.hypot(*np.ptp(self.rings[0], axis=0)))


def clean(rings: Sequence[Array], side: str) -> CleanOutline:
    """Check and repair an outline; ``side`` ("source", "target") names it in errors.

    ``rings`` are closed polylines (n, 2), exterior first. Raises ``OutlineError`` when a ring is
    not finite, has fewer than three distinct vertices or no area, crosses itself or another ring
    beyond repair, or when a hole lies outside.
    """
    if not rings:
        raise OutlineError(f"The {side} has no ring.", where=Where(side), hint="Draw an outline.")
    repairs: list[str] = []
    distinct = [
        _distinct(np.asarray(ring, float), side, i, repairs) for i, ring in enumerate(rings)
    ]
    polygon = Polygon(distinct[0], distinct[1:])
    if not polygon.is_valid:
        polygon = _repaired(polygon, len(rings), side, repairs)
        holes = _in_order([_open(hole) for hole in polygon.interiors], distinct[1:])
        distinct = [_open(polygon.exterior), *holes]
    oriented = [
        ring if (signed_area(ring) > 0) == (i == 0) else np.roll(ring[::-1], 1, axis=0)
        for i, ring in enumerate(distinct)
    ]
    return CleanOutline(tuple(oriented), tuple(repairs))


def _distinct(ring: Array, side: str, index: int, repairs: list[str]) -> Array:
    """Drop repeated vertices; refuse what has no finite area."""
    name = f"{side} outline" if index == 0 else f"{side} hole {index}"
    if ring.ndim != 2 or ring.shape[1] != 2:
        raise OutlineError(f"The {name} is not a list of (x, y) points.", where=Where(side, index))
    bad = np.flatnonzero(~np.isfinite(ring).all(axis=1))
    if len(bad):
        raise OutlineError(
            f"Node {bad[0]} of the {name} is not a finite number.",
            where=Where(side, index, int(bad[0])),
            hint="Correct or delete that node.",
        )
    size = float(np.hypot(*np.ptp(ring, axis=0))) if len(ring) else 0.0
    if len(ring) and not (size == 0 or SIZES[0] <= size <= SIZES[1]):
        raise OutlineError(
            f"The {name} is {size:.3g} wide, outside {SIZES[0]:g} to {SIZES[1]:g}.",
            where=Where(side, index),
            hint="Scale it.",
        )
    step = np.roll(ring, -1, axis=0) - ring
    kept = ring[np.hypot(step[:, 0], step[:, 1]) > REPEAT * size]
    if len(kept) < 3:
        raise OutlineError(
            f"The {name} has {len(kept)} distinct points; it needs at least 3.",
            where=Where(side, index, point=_point(ring)),
            hint="Add nodes, or draw it anew.",
        )
    if len(kept) < len(ring):
        repairs.append(f"{name}: {len(ring) - len(kept)} repeated points dropped")
    if Polygon(kept).convex_hull.area < FLAT * size**2:
        raise OutlineError(
            f"The {name} encloses no area.",
            where=Where(side, index, point=_point(kept)),
            hint="Move its nodes apart, or draw it anew.",
        )
    return kept


def _repaired(polygon: Polygon, rings: int, side: str, repairs: list[str]) -> Polygon:
    """Cut off small loops and spikes; refuse when that would change the shape."""
    problem = explain_validity(polygon)
    place = _place(problem)
    valid = make_valid(polygon, method="structure")
    parts = list(valid.geoms) if isinstance(valid, MultiPolygon) else [valid]
    parts = [part for part in parts if isinstance(part, Polygon)]
    largest = max(parts, key=lambda part: part.area, default=Polygon())
    # touching itself at a point is mended by shaving a hair off
    shaved = largest.buffer(-1e-7 * np.sqrt(largest.area), join_style="mitre")
    if isinstance(shaved, Polygon) and not LinearRing(largest.exterior).is_simple:
        largest = shaved
    drawn = _drawn_area(polygon)
    lost = abs(drawn - largest.area) / max(valid.area, drawn) if largest.area else np.inf
    if len(largest.interiors) != rings - 1 or lost > MAX_LOSS:
        what = "crosses itself" if rings == 1 else "has rings that cross or touch"
        raise OutlineError(
            f"The {side} {what} near ({place[0]:.4g}, {place[1]:.4g}).",
            where=Where(side, point=place),
            hint="Move the nodes there so that the edges no longer cross.",
        )
    repairs.append(
        f"{side}: crossing edges near ({place[0]:.4g}, {place[1]:.4g}) cut off"
        f" ({100 * lost:.2g} % of the area)"
    )
    return largest


def _in_order(holes: Sequence[Array], drawn: Sequence[Array]) -> list[Array]:
    """Return holes in the order in which they were drawn: a repair may mix them up."""
    left, ordered = list(holes), []
    for ring in drawn:
        shape = make_valid(Polygon(ring))
        shared = [Polygon(hole).intersection(shape).area for hole in left]
        ordered.append(left.pop(int(np.argmax(shared))))
    return ordered


def _drawn_area(polygon: Polygon) -> float:
    """Area by the rings as drawn, whatever their faults: loops that run backwards count against."""
    holes = sum(abs(signed_area(_open(ring))) for ring in polygon.interiors)
    return abs(signed_area(_open(polygon.exterior))) - holes


def _open(ring: LinearRing) -> Array:
    return np.asarray(ring.coords)[:-1]


def _point(ring: Array) -> tuple[float, float] | None:
    return (float(ring[0, 0]), float(ring[0, 1])) if len(ring) else None


def _place(problem: str) -> tuple[float, float]:
    """Read the coordinates in "Self-intersection[x y]"."""
    x, y = problem.rsplit("[", 1)[-1].rstrip("]").split()[:2]
    return float(x), float(y)
