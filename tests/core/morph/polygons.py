"""Simple polygons, tame and wild, with vertices in correspondence."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st
from shapely import LineString, Polygon

from core.geometry.polyline import resample, signed_area
from core.model.outline import Array


def at_unit_area(points: Array) -> Array:
    return (points - points.mean(axis=0)) / np.sqrt(signed_area(points))


def disc(count: int) -> Array:
    angle = 2 * np.pi * np.arange(count) / count
    return at_unit_area(np.column_stack([np.cos(angle), np.sin(angle)]))


def square(count: int) -> Array:
    """Most of its vertices lie on straight edges."""
    return at_unit_area(resample(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), count))


def comb(teeth: int, count: int) -> Array:
    corners = [[0.0, 0.0], [2 * teeth, 0]]
    for k in reversed(range(teeth)):
        corners += [[2 * k + 2, 9], [2 * k + 1, 9], [2 * k + 1, 1], [2 * k, 1]]
    return at_unit_area(resample(np.array(corners), count))


def spiral(turns: float, count: int) -> Array:
    angle = np.linspace(1, 1 + 2 * np.pi * turns, count // 2)
    spine = np.column_stack([np.cos(angle), np.sin(angle)])
    outer, inner = spine * (angle + 1)[:, None], spine * (angle - 1)[:, None]
    return at_unit_area(np.concatenate([outer, inner[::-1]]))


def needle(count: int, width: float) -> Array:
    return at_unit_area(resample(np.array([[0.0, 0], [1, 0], [1, width], [0, width]]), count))


def hole(
    x: float, turn: float, centre: Array | tuple[float, float] = (0, 0), radius: float = 0.1
) -> Array:
    """A small clockwise ring of 12 vertices, ``x`` to the right of a centre."""
    angle = turn - 2 * np.pi * np.arange(12) / 12
    return np.asarray(centre) + [x, 0] + radius * np.column_stack([np.cos(angle), np.sin(angle)])


def hole_within(polygon: Array) -> Array:
    """A small hole somewhere inside a polygon."""
    inside = Polygon(polygon).representative_point()
    room = inside.distance(Polygon(polygon).exterior)
    return hole(0, 0, (inside.x, inside.y), 0.4 * room)


@st.composite
def star_shaped(draw: st.DrawFn, count: int) -> Array:
    radius = draw(st.lists(st.floats(0.1, 1), min_size=count, max_size=count))
    angle = 2 * np.pi * np.arange(count) / count
    return at_unit_area(np.array(radius)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]))


@st.composite
def untangled(draw: st.DrawFn, count: int) -> Array:
    """A closed walk through random points of a grid, its crossings undone, its edges divided."""
    cells = draw(st.lists(st.integers(0, 99), min_size=5, max_size=12, unique=True))
    walk = np.column_stack(np.divmod(cells, 10)).astype(float)
    walk += 0.01 * np.sin(np.arange(2 * len(walk))).reshape(-1, 2)  # no three in a line
    while (pair := _first_crossing(walk)) is not None:
        i, j = pair
        walk[i + 1 : j + 1] = walk[i + 1 : j + 1][::-1].copy()
    if signed_area(walk) < 0:
        walk = walk[::-1]
    parts = np.bincount(np.arange(count) % len(walk), minlength=len(walk))
    share = np.concatenate([np.arange(k) / k for k in parts])[:, None]
    start = np.repeat(walk, parts, axis=0)
    return at_unit_area(
        (1 - share) * start + share * np.repeat(np.roll(walk, -1, axis=0), parts, axis=0)
    )


def _first_crossing(walk: Array) -> tuple[int, int] | None:
    edges = [LineString(edge) for edge in np.stack([walk, np.roll(walk, -1, axis=0)], axis=1)]
    for i in range(len(edges)):
        for j in range(i + 2, len(edges)):
            if (i or j < len(edges) - 1) and edges[i].intersects(edges[j]):
                return i, j
    return None
