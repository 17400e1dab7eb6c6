"""Outlines that cannot be repaired: what is wrong with them, and where."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from shapely import LinearRing

from core.errors import OutlineError, Where
from core.geometry.basis import Basis
from core.geometry.crossing import first_fault
from core.model.outline import Array


def name_of(side: str, ring: int) -> str:
    """Name a ring of the "source" or the "target" in messages."""
    return f"{side} hole {ring}" if ring else f"{side} outline"


def not_finite(node: int, side: str, index: int) -> OutlineError:
    """Say that a node of a ring is nowhere."""
    return OutlineError(
        f"Node {node} of the {name_of(side, index)} is not a finite number.",
        where=Where(side, index, node),
        hint="Correct or delete that node.",
    )


def too_few(points: Array, distinct: int, side: str, index: int) -> OutlineError:
    """Say that a ring (n, 2) as drawn has too few distinct vertices."""
    count = max(distinct, min(len(points), 1))
    return OutlineError(
        f"The {name_of(side, index)} has {count or 'no'} distinct point{'s'[: count != 1]};"
        " it needs at least 3.",
        where=_begins(points, side, index),
        hint="Add nodes, or draw it anew.",
    )


def without_area(points: Array, side: str, index: int) -> OutlineError:
    """Say that a ring (n, 2) as drawn encloses nothing."""
    return OutlineError(
        f"The {name_of(side, index)} encloses no area.",
        where=_begins(points, side, index),
        hint="Move its nodes apart, or draw it anew.",
    )


def beyond_repair(rings: Sequence[Array], basis: Basis, side: str) -> OutlineError:
    """Say how rings (n, 2), in their own coordinates, cross, or lie in the wrong place."""
    problem, place = first_fault(rings)
    point = place if len(place) else rings[0][0]
    here, (x, y) = _rings_at(rings, point), basis.outside(point).tolist()
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
        f"The {name_of(side, here[0])} crosses itself {near}.",
        where=where,
        hint="Move the nodes there so that the edges no longer cross.",
    )


def _rings_at(rings: Sequence[Array], point: Array) -> list[int]:
    """Return the rings that run through a point, or at least the nearest."""
    distance = shapely.distance([LinearRing(ring) for ring in rings], shapely.points(point))
    return [int(i) for i in np.flatnonzero(distance <= max(1e-6, distance.min()))]


def _begins(points: Array, side: str, index: int) -> Where:
    """Return the place of a ring's first point, if there is one."""
    point = (float(points[0, 0]), float(points[0, 1])) if len(points) else None
    return Where(side, index, point=point)
