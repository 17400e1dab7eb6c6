"""Where points lie on a mesh, so that what is known at its vertices is known there too."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
import shapely
from numpy.typing import NDArray

from core.geometry.polyline import cross
from core.geometry.triangulation import Indices, unique_edges
from core.model.outline import Array

ROUNDING = 1e-9
"""How far outside a triangle a point in it may seem to be, as a weight."""


@dataclass(frozen=True, eq=False)
class Located:
    """Points by the triangle that each is in, or nearest to."""

    triangle: Indices
    """(k,)"""
    corners: Indices
    """(k, 3) its vertices."""
    weights: Array
    """(k, 3) barycentric coordinates; one is negative outside the mesh."""

    @classmethod
    def on(cls, vertices: Array, triangles: Indices, places: Array) -> Self:
        """Locate places (k, 2) on a mesh of vertices (n, 2) and triangles (m, 3)."""
        corners = vertices[triangles]
        spots, low, high = shapely.points(places), corners.min(axis=1), corners.max(axis=1)
        near = np.flatnonzero(
            ((high >= places.min(axis=0)) & (low <= places.max(axis=0))).all(axis=1)
        )
        boxes = shapely.box(*low[near].T, *high[near].T)
        place, which = shapely.STRtree(boxes).query(spots)
        triangle = near[which]
        deepest = _weights(corners[triangle], places[place]).min(axis=1)
        order = np.argsort(deepest, kind="stable")  # of a place's triangles the last stays
        found = np.full(len(places), -1)
        found[place[order]] = np.where(deepest[order] < -ROUNDING, -1, triangle[order])
        outside = np.flatnonzero(found < 0)
        if len(outside):
            found[outside] = _nearest(vertices, triangles, spots[outside])
        return cls(found, triangles[found], _weights(corners[found], places))

    def interpolate(self, values: Array) -> Array:
        """Return values (n, d) at vertices carried over to the points (k, d), linearly."""
        return np.einsum("kc,kcd->kd", self.weights, values[self.corners])


def _weights(corners: Array, places: Array) -> Array:
    """Return barycentric coordinates (k, 3) of places (k, 2) by triangles' corners (k, 3, 2)."""
    a, b, c = (corners[:, i] - places for i in range(3))
    parts = np.stack([cross(b, c), cross(c, a), cross(a, b)], axis=1)
    areas = parts.sum(axis=1, keepdims=True)
    return parts / np.where(areas == 0, 1, areas)


def _nearest(vertices: Array, triangles: Indices, spots: NDArray[np.object_]) -> Indices:
    """Return the triangles (k,) on the boundary that are nearest to points outside."""
    edges, sides, count = unique_edges(triangles)
    side = np.flatnonzero(count[sides].ravel() == 1)
    lines = shapely.linestrings(vertices[edges[sides.ravel()[side]]])
    return side[shapely.STRtree(lines).nearest(spots)] // 3
