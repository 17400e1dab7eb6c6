"""Closed polylines (k, 2), exterior first, that cross themselves or each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from shapely import Polygon

from core.model.outline import Array


def crosses_itself(rings: Sequence[Array]) -> bool:
    """Whether rings cross or touch, themselves or each other, or do not lie in the exterior."""
    return not Polygon(rings[0], rings[1:]).is_valid


def first_fault(rings: Sequence[Array]) -> tuple[str, Array]:
    """Return what is wrong with such rings, in the words of GEOS, and where: (2,), empty if that
    is not said.
    """
    reason = shapely.is_valid_reason(Polygon(rings[0], rings[1:]))
    what, _, place = reason.rstrip("]").partition("[")  # as in "Ring Self-intersection[2 0]"
    return what, np.array(place.split()[:2], dtype=float)
