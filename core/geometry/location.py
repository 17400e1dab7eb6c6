"""Where points lie on a mesh, so that what is known at its vertices is known there too."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from shapely import STRtree, points, polygons

from core.geometry.triangulation import Indices
from core.model.outline import Array


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
        tree, spots = STRtree(polygons(vertices[triangles])), points(places)
        triangle = np.full(len(places), -1)
        found, inside = tree.query(spots, predicate="intersects")
        triangle[found] = inside
        outside = np.flatnonzero(triangle < 0)
        triangle[outside] = tree.nearest(spots[outside])
        a, b, c = vertices[triangles[triangle]].transpose(1, 0, 2)
        edges = np.stack([b - a, c - a], axis=-1)
        second, third = np.linalg.solve(edges, (places - a)[..., None])[..., 0].T
        weights = np.column_stack([1 - second - third, second, third])
        return cls(triangle, triangles[triangle], weights)

    def interpolate(self, values: Array) -> Array:
        """Return values (n, d) at vertices carried over to the points (k, d), linearly."""
        return np.einsum("kc,kcd->kd", self.weights, values[self.corners])
