"""What the point formats share: from lists of points to parts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from core.errors import FileError
from core.io.importers.nesting import group_rings
from core.io.importers.part import MAX_NODES, Part, numbered
from core.model import Ring
from core.model.outline import MIN_NODES

Points = Sequence[tuple[float, float]]


def parts_of(rings: Sequence[Points], name: str) -> list[Part]:
    """Make parts of closed polygons; one inside another is its hole."""
    if sum(map(len, rings)) > MAX_NODES:
        raise FileError(f"The file has more than {MAX_NODES} points.")
    if not rings:
        raise FileError("The file holds no points.")
    closed = [Ring.polygon(_opened(ring, i)) for i, ring in enumerate(rings, 1)]
    return numbered(name, group_rings(closed))


def _opened(points: Points, number: int) -> Points:
    """Drop a last point that repeats the first."""
    ring = points[:-1] if len(points) > 1 and points[-1] == points[0] else points
    if len(ring) < MIN_NODES:
        raise FileError(
            f"Ring {number} has {len(ring)} points; an outline needs at least {MIN_NODES}."
        )
    if not np.ptp(np.asarray(ring), axis=0).any():
        raise FileError(f"All points of ring {number} are the same.")
    return ring
