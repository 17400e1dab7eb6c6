"""Bézier rings to polylines, keeping track of where on the ring each vertex lies."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from core.model.cubic import points_on
from core.model.outline import Array, Outline, Ring

TOLERANCE = 1e-4
"""Largest distance from curve to polyline, as a fraction of the outline's diagonal."""
MAX_PIECES = 256
"""Pieces that one segment is cut into at most."""
REMEMBERED = 256
"""Outlines whose polylines are kept."""


@dataclass(frozen=True, eq=False)
class Polyline:
    """A closed polyline and the place (``Ring``) of each of its vertices."""

    points: Array
    """(n, 2)"""
    at: Array
    """(n,) increasing places on the ring it came from."""


@lru_cache(maxsize=REMEMBERED)
def flatten(outline: Outline, tolerance: float = TOLERANCE) -> tuple[Polyline, ...]:
    """Flatten every ring to within ``tolerance`` × the diagonal of the outline's bounds.

    The same outlines are asked for with every frame, so the last ones are remembered.
    """
    left, top, right, bottom = outline.bounds()
    distance = tolerance * float(np.hypot(right - left, bottom - top))
    return tuple(flatten_ring(ring, distance) for ring in outline.rings)


def flatten_ring(ring: Ring, distance: float) -> Polyline:
    """Flatten a ring to within ``distance``; straight segments keep just their nodes."""
    if not ring.curved.any() or not distance > 0:
        return Polyline(ring.points, np.arange(len(ring), dtype=float))
    points, at = [], []
    for i, curved in enumerate(ring.curved):
        u = np.arange(_pieces(ring.controls(i), distance) if curved else 1, dtype=float)
        u /= len(u)
        at.append(i + u)
        points.append(points_on(ring.controls(i), u) if curved else ring.points[i : i + 1])
    polyline = Polyline(np.concatenate(points), np.concatenate(at))
    polyline.points.setflags(write=False)
    return polyline


def _pieces(controls: Array, distance: float) -> int:
    """Pieces of a cubic, by the bound of its second derivative (Wang's formula)."""
    bend = np.abs(np.diff(controls, n=2, axis=0)).max(axis=0)
    pieces = np.ceil(np.sqrt(0.75 * np.hypot(*bend) / distance))
    return int(np.clip(pieces, 2, MAX_PIECES)) if np.isfinite(pieces) else 2
