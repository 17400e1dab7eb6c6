"""Closed polylines (k, 2), exterior first, that cross themselves or each other."""

from __future__ import annotations

from collections.abc import Sequence

from shapely import Polygon

from core.model.outline import Array


def crosses_itself(rings: Sequence[Array]) -> bool:
    """Whether rings cross or touch, themselves or each other, or do not lie in the exterior."""
    return not Polygon(rings[0], rings[1:]).is_valid
