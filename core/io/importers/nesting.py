"""Closed curves to filled outlines: which of them are holes, and of what."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from core.geometry.flatten import flatten
from core.geometry.polyline import signed_area
from core.model import Outline, Ring
from core.model.outline import Array

Rule = Literal["evenodd", "nonzero"]

SAMPLES = 15
"""Vertices that are looked at to tell whether one ring lies inside another."""


def group_rings(rings: Sequence[Ring], rule: Rule = "evenodd") -> list[Outline]:
    """Group rings, which should not cross each other, into outlines, in the order they came in.

    A ring bounds the filled area if the rule gives its inside and its surroundings different
    answers; a ring that bounds nothing is left out. Where rings cross, a hole may lie in no
    exterior; it becomes a shape of its own.
    """
    if len(rings) == 1:
        return [Outline(tuple(rings))]
    polygons = [flatten(Outline((ring,)))[0].points for ring in rings]
    areas = np.array([signed_area(polygon) for polygon in polygons])
    around = _surroundings(polygons, np.abs(areas))

    def filled(inside: Sequence[int]) -> bool:
        if rule == "evenodd":
            return len(inside) % 2 == 1
        return sum(1 if areas[i] > 0 else -1 for i in inside) != 0

    exteriors: dict[int, list[Ring]] = {}
    holes: list[int] = []
    for i, outer in enumerate(around):
        if filled([*outer, i]) and not filled(outer):
            exteriors[i] = [rings[i]]
        elif filled(outer) and not filled([*outer, i]):
            holes.append(i)
    for i in holes:
        owners = [j for j in around[i] if j in exteriors]
        if owners:
            exteriors[min(owners, key=lambda j: abs(areas[j]))].append(rings[i])
        else:
            exteriors[i] = [rings[i]]
    return [Outline(tuple(group)) for group in exteriors.values()]


def _surroundings(polygons: Sequence[Array], areas: Array) -> list[list[int]]:
    """For each polygon (k, 2), the indices of those that it lies in."""
    import shapely

    shapes = np.array([shapely.Polygon(polygon) for polygon in polygons])
    tree = shapely.STRtree(shapes)
    around: list[list[int]] = [[] for _ in polygons]
    for inner, outer in tree.query(shapes).T:
        if areas[outer] > areas[inner] and _mostly_inside(polygons[inner], shapes[outer]):
            around[inner].append(int(outer))
    return around


def _mostly_inside(points: Array, polygon: object) -> bool:
    """Ask several vertices (k, 2), since one may lie on the boundary of the other ring."""
    import shapely

    sample = points[np.linspace(0, len(points) - 1, SAMPLES).astype(int)]
    return bool(shapely.contains_xy(polygon, sample).mean() > 0.5)
