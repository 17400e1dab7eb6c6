"""Places on an outline: the one nearest to a point, and arc length to and fro."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike

from core.geometry.flatten import Polyline, flatten
from core.geometry.polyline import arc_lengths, around, nearest_length, points_at
from core.model.outline import Array, Outline, RingPoint

NODE = 1e-9
"""A place this near to a node is the node."""


@dataclass(frozen=True, eq=False)
class MeasuredRing:
    """A ring's polyline with arc lengths: translates places into arc lengths and back."""

    polyline: Polyline
    nodes: int
    """How many nodes the ring has."""
    lengths: Array
    """(n + 1,) arc lengths of the polyline's vertices, and of the whole."""

    @property
    def perimeter(self) -> float:
        """Length of the ring."""
        return float(self.lengths[-1])

    def length_of(self, at: float) -> float:
        """Return the arc length at a place."""
        return float(np.interp(at % self.nodes, self._places, self.lengths))

    def vertex_of(self, at: float) -> float:
        """Return a place counted in vertices of the polyline."""
        return float(np.interp(at % self.nodes, self._places, np.arange(len(self._places))))

    def place_at_vertex(self, vertex: float) -> float:
        """Return the place that lies at a vertex of the polyline, or a fraction on from one."""
        return self._on_node(float(np.interp(vertex, np.arange(len(self._places)), self._places)))

    def point_at(self, at: float) -> Array:
        """Return the point (2,) of the polyline at a place."""
        return points_at(self.polyline.points, self.lengths, np.array([self.length_of(at)]))[0]

    def place_of(self, length: float) -> float:
        """Return the place at an arc length, taken modulo the perimeter; that of a node exactly."""
        along = around(length, self.perimeter)
        return self._on_node(float(np.interp(along, self.lengths, self._places)))

    def nearest(self, point: ArrayLike) -> tuple[float, float]:
        """Return the place closest to a point (2,), and its distance."""
        p = np.asarray(point, dtype=float)
        length, distance = nearest_length(self.polyline.points, self.lengths, p)
        return self.place_of(length), distance

    @cached_property
    def _places(self) -> Array:
        return np.append(self.polyline.at, float(self.nodes))

    def _on_node(self, at: float) -> float:
        return float(round(at) if abs(at - round(at)) < NODE else at) % self.nodes


@lru_cache(maxsize=256)
def measured(outline: Outline) -> tuple[MeasuredRing, ...]:
    """Return every ring, measured."""
    return tuple(
        MeasuredRing(polyline, len(ring), arc_lengths(polyline.points))
        for ring, polyline in zip(outline.rings, flatten(outline), strict=True)
    )


def nearest_place(outline: Outline, point: ArrayLike) -> tuple[RingPoint, float]:
    """Return the place on the outline closest to a point (2,), and its distance."""
    found = [(*measure.nearest(point), ring) for ring, measure in enumerate(measured(outline))]
    at, distance, ring = min(found, key=lambda item: item[1])
    return RingPoint(ring, at), distance
