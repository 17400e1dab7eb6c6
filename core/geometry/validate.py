"""The outline door: only finite, closed, simple polygons pass; small faults are repaired.

Everything behind it (triangulation, matching) relies on that.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from shapely import Polygon

from core.errors import OutlineError, Repair, Where
from core.geometry.basis import Basis
from core.geometry.clean_outline import CleanOutline
from core.geometry.crossing import crosses_itself
from core.geometry.distance import departure
from core.geometry.extent import size_of
from core.geometry.faults import beyond_repair, name_of, not_finite, too_few, without_area
from core.geometry.mending import BeyondRepair
from core.geometry.mending.meetings import separate
from core.geometry.mending.mend import Mended, mend
from core.geometry.origin import Origin
from core.geometry.polyline import diagonal, reversed_ring, signed_area
from core.model.outline import MIN_NODES, Array

REPEAT = 1e-9
"""Vertices closer than this, as a fraction of the diagonal, are one vertex."""
FLAT = 1e-9
"""An outline whose hull has less area than this fraction of its squared diagonal is a line."""
MAX_LOSS = 0.02
"""Fraction of the area by which a repair may change it."""


def clean(rings: Sequence[Array], side: str) -> CleanOutline:
    """Check and repair an outline; ``side`` ("source", "target") names it in errors.

    ``rings`` are closed polylines (n, 2), exterior first. Where it touches itself it is opened by a
    hair, and spikes and small loops are cut off (see ``mending``); every other vertex stays to the
    last bit. Raises ``OutlineError`` when a ring is not finite, has fewer than three distinct
    vertices or no area, crosses itself or another ring beyond repair, or when a hole lies outside.
    """
    if not rings:
        raise OutlineError(f"The {side} has no ring.", where=Where(side), hint="Draw an outline.")
    drawn = [_finite(np.asarray(ring, float), side, i) for i, ring in enumerate(rings)]
    size = size_of(drawn, side)
    repairs: list[Repair] = []
    kept = [_distinct(ring, size, side, i, repairs) for i, ring in enumerate(drawn)]
    origins = [Origin.of_kept(k, len(ring)) for k, ring in zip(kept, drawn, strict=True)]
    distinct = [ring[k] for k, ring in zip(kept, drawn, strict=True)]
    basis = Basis(distinct[0][0], size)
    inside = [basis.inside(ring) for ring in distinct]
    if crosses_itself(inside) or not separate(inside):
        mended = _mended(inside, origins, basis, side)
        distinct, origins = _placed(mended, distinct, basis), list(mended.opened.origins)
        repairs += _told(mended, inside, [basis.inside(ring) for ring in distinct], basis, side)
    turned = [(signed_area(ring) > 0) != (i == 0) for i, ring in enumerate(distinct)]
    return CleanOutline(
        tuple(reversed_ring(r) if t else r for r, t in zip(distinct, turned, strict=True)),
        tuple(o.reversed() if t else o for o, t in zip(origins, turned, strict=True)),
        tuple(repairs),
    )


def _finite(ring: Array, side: str, index: int) -> Array:
    bad = np.flatnonzero(~np.isfinite(ring).all(axis=1))
    if len(bad):
        raise not_finite(int(bad[0]), side, index)
    return ring


def _distinct(
    ring: Array, size: float, side: str, index: int, repairs: list[Repair]
) -> NDArray[np.int64]:
    """Return the vertices to keep, the last of each run of repeats; refuse what has no area."""
    step = np.roll(ring, -1, axis=0) - ring
    length = np.hypot(step[:, 0], step[:, 1])
    repeated = length <= REPEAT * size
    kept = np.flatnonzero(~repeated)
    if len(kept) < MIN_NODES:
        raise too_few(ring, len(kept), side, index)
    if repeated.any():
        what = f"The {name_of(side, index)} has {repeated.sum()} repeated points"
        moved = float(length[repeated].max()) / size
        repairs.append(Repair(what, "left out", Where(side, index), moved))
    if Polygon(ring[kept]).convex_hull.area < FLAT * diagonal(ring) ** 2:
        raise without_area(ring[kept], side, index)
    return kept


def _mended(rings: Sequence[Array], origins: Sequence[Origin], basis: Basis, side: str) -> Mended:
    """Mend rings in their own coordinates; refuse when that would change the shape."""
    most = MAX_LOSS * abs(signed_area(rings[0]))
    try:
        mended = mend(rings, origins, most)
    except BeyondRepair as problem:
        if problem.flat is not None:
            flat = basis.outside(rings[problem.flat])
            raise without_area(flat, side, problem.flat) from None
        raise beyond_repair(rings, basis, side) from None
    if sum(map(signed_area, mended.opened.rings)) <= most:  # its holes take up all of it
        raise without_area(basis.outside(rings[0]), side, 0)
    return mended


def _placed(mended: Mended, drawn: Sequence[Array], basis: Basis) -> list[Array]:
    """Return mended rings where they were drawn; vertices that stayed do so to the last bit."""
    vertices = np.concatenate(drawn)
    return [
        np.where((index >= 0)[:, None], vertices[index], basis.outside(ring))
        for ring, index in zip(mended.opened.rings, mended.opened.vertices, strict=True)
    ]


def _told(
    mended: Mended, before: Sequence[Array], after: Sequence[Array], basis: Basis, side: str
) -> list[Repair]:
    """Put what was mended into words."""
    moved = departure(before, after)
    share = 100 * mended.lost / abs(signed_area(after[0]))
    told = []
    for places, what, end in (
        (mended.touches, "touches itself", f"opened by {mended.hair * basis.unit:.2g} there"),
        (mended.spikes, "has a spike without area", "cut off there"),
        (mended.loops, "crosses itself", f"a loop of {share:.2g} % of the area cut off there"),
    ):
        if len(places):
            more = f" and in {len(places) - 1} more" if len(places) > 1 else ""
            x, y = basis.outside(places[0]).tolist()
            where = Where(side, point=(x, y))
            told.append(Repair(f"The {side} {what}", f"{end}{more}", where, moved))
    return told
