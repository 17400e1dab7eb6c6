"""Proof that a map is one to one.

Let triangles cover two outlines, the border edges of the triangles be the edges of the outlines,
and a map take each vertex of one to the same vertex of the other. If every triangle runs
counter-clockwise at both ends and both outlines are simple, then the triangles tile both outlines
and the map is a bijection: a point inside an outline is covered as often as the border winds around
it, which is once (Lipman 2014, "Bijective mappings of meshes with boundary and the degree in mesh
processing", theorem 1).

Every sign is decided exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from core.geometry.crossing import crosses_itself
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.quality import folds


@dataclass(frozen=True)
class Certificate:
    """What the proof needs, as it was found."""

    folds: tuple[tuple[int, ...], tuple[int, ...]]
    """Triangles that do not run counter-clockwise, in the source and in the target."""
    simple: tuple[bool, bool]
    """Whether the outlines cross neither themselves nor each other."""
    bordered: bool
    """Whether the border edges of the triangles are the edges of the outlines."""

    @classmethod
    def of(cls, triangles: Indices, rings: Sequence[Indices], source: Array, target: Array) -> Self:
        """Examine a mesh: triangles (m, 3), rings of boundary vertices, positions (n, 2)."""
        return cls(
            folds=(_folds(source, triangles), _folds(target, triangles)),
            simple=(_simple(source, rings), _simple(target, rings)),
            bordered=_bordered(triangles, rings),
        )

    @property
    def holds(self) -> bool:
        """Whether the map is proved to be one to one."""
        return not any(self.folds) and all(self.simple) and self.bordered


def _folds(points: Array, triangles: Indices) -> tuple[int, ...]:
    return tuple(folds(points, triangles).tolist())


def _simple(points: Array, rings: Sequence[Indices]) -> bool:
    return not crosses_itself([points[ring] for ring in rings])


def _bordered(triangles: Indices, rings: Sequence[Indices]) -> bool:
    """Whether each edge of a ring has one triangle, on its left, and each other edge has two, one
    on either side.
    """
    tail, head = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
    start, end = np.concatenate(rings), np.concatenate([np.roll(ring, -1) for ring in rings])
    n = int(triangles.max()) + 1
    edges, back = tail * n + head, head * n + tail
    # closed off by rings that run backwards, every edge has its opposite
    closed = np.sort(np.concatenate([edges, end * n + start]))
    opposite = np.sort(np.concatenate([back, start * n + end]))
    return bool((np.diff(closed) > 0).all()) and np.array_equal(closed, opposite)
