"""How far points and closed polylines (k, 2) are from each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import numpy as np
import shapely
from numpy.typing import NDArray

from core.model.outline import Array


def edges_of(rings: Sequence[Array]) -> NDArray[np.object_]:
    """Return (n,) the edges of rings, each a line string."""
    ends = [np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings]
    return cast(NDArray[np.object_], shapely.linestrings(np.concatenate(ends)))


def distances(points: Array, rings: Sequence[Array]) -> Array:
    """Return (n,) how far points (n, 2) are from the nearest edge of rings."""
    _, found = shapely.STRtree(edges_of(rings)).query_nearest(
        shapely.points(points), all_matches=False, return_distance=True
    )
    return cast(Array, found)


def departure(rings: Sequence[Array], others: Sequence[Array]) -> float:
    """Return the largest distance of a vertex of either from the edges of the other: measured both
    ways, so that a cut corner counts as well as a vertex that strays.
    """
    here, there = np.concatenate(rings), np.concatenate(others)
    return float(max(distances(here, others).max(), distances(there, rings).max()))
