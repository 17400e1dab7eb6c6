"""Closed curves to filled outlines: which of them are holes, and of what."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from core.errors import FileError
from core.geometry.flatten import flatten
from core.geometry.polyline import signed_area
from core.model import Outline, Ring
from core.model.outline import Array

Rule = Literal["evenodd", "nonzero"]

SAMPLES = 15
"""Vertices that are looked at to tell whether one ring lies inside another."""
MAX_OVERLAPS = 1_000_000
"""Pairs of rings, one of which may lie inside the other, that a shape may have."""
BATCH = 256
"""Rings that are looked at together, so that memory is bounded, too."""


def group_rings(rings: Sequence[Ring], rule: Rule = "evenodd") -> list[Outline]:
    """Group rings, which should not cross each other, into outlines, in the order they came in.

    A ring bounds the filled area if the rule gives its inside and its surroundings different
    answers; a ring that bounds nothing is left out. Where rings cross, a hole may lie in no
    exterior; it becomes a shape of its own. FileError where far too many overlap.
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
    """For each polygon (k, 2), the indices of those that it mostly lies in.

    Several of its vertices are asked, since one may lie on the boundary of the other ring.
    """
    import shapely

    shapes = np.array([shapely.Polygon(polygon) for polygon in polygons])
    shapely.prepare(shapes)
    tree = shapely.STRtree(shapes)
    samples = np.array([p[np.linspace(0, len(p) - 1, SAMPLES).astype(int)] for p in polygons])
    around: list[list[int]] = [[] for _ in polygons]
    overlaps = 0
    for start in range(0, len(shapes), BATCH):
        number, outer = tree.query(shapes[start : start + BATCH])
        inner = start + number
        larger = areas[outer] > areas[inner]
        inner, outer = inner[larger], outer[larger]
        overlaps += len(inner)
        if overlaps > MAX_OVERLAPS:
            raise FileError(f"More than {MAX_OVERLAPS} pairs of curves lie in or over each other.")
        x, y = np.moveaxis(samples[inner], 2, 0)
        inside = shapely.contains_xy(shapes[outer][:, None], x, y).mean(axis=1) > 0.5
        for i, j in zip(inner[inside].tolist(), outer[inside].tolist(), strict=True):
            around[i].append(j)
    return around
