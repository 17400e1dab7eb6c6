"""Closed polylines (n, 2), first point not repeated: area, arc length, places along them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from core.model.outline import Array


def cross(u: Array, v: Array) -> Array:
    """Return the cross products (...) of vectors (..., 2): positive when v lies left of u."""
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def signed_area(points: Array) -> float:
    """Return the enclosed area, positive when the polyline turns from +x towards +y."""
    p = points - points.mean(axis=0)  # far from the origin the products would cancel
    q = np.roll(p, -1, axis=0)
    return 0.5 * float(np.sum(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]))


def arc_lengths(points: Array) -> Array:
    """Return (n + 1,) arc length at each vertex, from 0 up to the perimeter at the closing one."""
    edges = np.roll(points, -1, axis=0) - points
    return np.concatenate([[0.0], np.cumsum(np.hypot(edges[:, 0], edges[:, 1]))])


def diagonal(points: Array) -> float:
    """Return the diagonal of the bounds of points (n, 2)."""
    return float(np.hypot(*np.ptp(points, axis=0)))


def inner_angles(points: Array) -> Array:
    """Return (n,) the angle at each vertex, on the left of the polyline, in [0, 2π)."""
    after, before = np.roll(points, -1, axis=0) - points, np.roll(points, 1, axis=0) - points
    angles = np.arctan2(cross(after, before), np.einsum("ij,ij->i", after, before))
    return np.mod(angles, 2 * np.pi)


def around(at: ArrayLike, perimeter: float) -> Array:
    """Return arc lengths (...) modulo a perimeter; zeros where that is zero."""
    return np.mod(at, perimeter) if perimeter > 0 else np.zeros_like(at, dtype=float)


def points_at(points: Array, lengths: Array, at: Array) -> Array:
    """Return (k, 2) points at arc lengths (k,), taken modulo the perimeter.

    ``lengths`` is ``arc_lengths(points)``. An arc length that equals a vertex's gives that vertex
    to the last bit.
    """
    closed = np.append(points, points[:1], axis=0)
    at = around(at, lengths[-1])
    return np.column_stack([np.interp(at, lengths, closed[:, k]) for k in (0, 1)])


def nearest_length(points: Array, lengths: Array, point: Array) -> tuple[float, float]:
    """Return (arc length of the closest place to a point, its distance)."""
    start = points
    edge = np.roll(points, -1, axis=0) - points
    squared = np.einsum("ij,ij->i", edge, edge)
    along = np.einsum("ij,ij->i", point - start, edge)
    u = np.clip(np.divide(along, squared, out=np.zeros_like(along), where=squared > 0), 0, 1)
    away = start + u[:, None] * edge - point
    distance = np.hypot(away[:, 0], away[:, 1])
    i = int(np.argmin(distance))
    return float(lengths[i] + u[i] * (lengths[i + 1] - lengths[i])), float(distance[i])


def resample(points: Array, count: int, start: float = 0.0) -> Array:
    """Return (count, 2) points evenly spaced by arc length, the first at arc length ``start``."""
    lengths = arc_lengths(points)
    return points_at(points, lengths, start + np.arange(count) * (lengths[-1] / count))


def reversed_ring(points: Array) -> Array:
    """Return a ring (n, 2) the other way round, its first vertex staying first."""
    return np.roll(points[::-1], 1, axis=0)
