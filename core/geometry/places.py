"""Places on an outline: the one nearest to a point, and arc length to and fro."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from core.geometry.flatten import Polyline, flatten
from core.geometry.polyline import arc_lengths, nearest_length, points_at
from core.model.outline import Array, Outline, RingPoint


@dataclass(frozen=True, eq=False)
class Track:
    """A ring's polyline with arc lengths: translates places into arc lengths and back."""

    polyline: Polyline
    nodes: int
    lengths: Array

    @property
    def perimeter(self) -> float:
        """Length of the ring."""
        return float(self.lengths[-1])

    def length_of(self, at: float) -> float:
        """Return the arc length at a place."""
        places = np.append(self.polyline.at, float(self.nodes))
        return float(np.interp(at % self.nodes, places, self.lengths))

    def point_at(self, at: float) -> Array:
        """Return the point (2,) of the polyline at a place."""
        return points_at(self.polyline.points, self.lengths, np.array([self.length_of(at)]))[0]

    def place_of(self, length: float) -> float:
        """Return the place at an arc length, taken modulo the perimeter."""
        places = np.append(self.polyline.at, float(self.nodes))
        at = float(np.interp(length % self.perimeter, self.lengths, places))
        return at % self.nodes


@lru_cache(maxsize=256)
def tracks(outline: Outline) -> tuple[Track, ...]:
    """Return the track of every ring."""
    return tuple(
        Track(polyline, len(ring), arc_lengths(polyline.points))
        for ring, polyline in zip(outline.rings, flatten(outline), strict=True)
    )


def nearest_place(outline: Outline, point: ArrayLike) -> tuple[RingPoint, float]:
    """Return the place on the outline closest to a point (2,), and its distance."""
    p = np.asarray(point, dtype=float)
    found = []
    for i, track in enumerate(tracks(outline)):
        length, distance = nearest_length(track.polyline.points, track.lengths, p)
        found.append((distance, RingPoint(i, track.place_of(length))))
    distance, place = min(found, key=lambda item: item[0])
    return place, distance
