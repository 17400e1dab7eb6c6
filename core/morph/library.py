"""The library's front door: plain arrays and vertex indices in, a morph out."""

from __future__ import annotations

from collections.abc import Sequence
from operator import index as as_integer
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from core.errors import MarkError, OutlineError, SolveError, Where
from core.model import Outline, Recipe, RingPoint
from core.morph.morph import Morph
from core.morph.pipeline import solve_outlines
from core.progress import Progress, silent

Shape = Outline | ArrayLike | Sequence[ArrayLike]
"""An outline, the points of a polygon, or rings of points."""
MarkIndex = int | tuple[int, int]
"""A vertex of the exterior, or (ring, vertex)."""


def solve(
    source: Shape,
    target: Shape,
    marks: Sequence[tuple[MarkIndex, MarkIndex]] | None = None,
    *,
    recipe: Recipe | None = None,
    progress: Progress = silent,
) -> Morph:
    """Map one outline onto another.

    ``source`` and ``target`` are (n, 2) and (k, 2) points of closed polygons, the first not
    repeated; or sequences of such rings, the exterior first and then the holes; or an ``Outline``,
    which may have curves. Either orientation will do. ``marks`` pair vertex indices of the source
    with those of the target; ``(ring, vertex)`` reaches holes. Without marks the outlines are
    matched by their features. ``progress(fraction, stage)`` may raise ``Cancelled``.

    Raises ``OutlineError``, ``MarkError`` or ``SolveError``, each with what, where and a hint; they
    call marks by their indices.
    """
    if not isinstance(recipe, Recipe | None):
        raise SolveError(f"The recipe is {recipe!r}, not a Recipe.")
    ends = _outline(source, "source"), _outline(target, "target")
    given = () if marks is None else marks
    if not np.iterable(given):
        raise MarkError(
            f"The marks are {given}, not a list of pairs.", hint="Give [(vertex, vertex), …]."
        )
    pairs = [_places(ends, pair, i) for i, pair in enumerate(given)]
    names = [f"{i}" for i in range(len(pairs))]
    return solve_outlines(*ends, pairs, labels=names, recipe=recipe, progress=progress)


def _outline(given: Shape, side: str) -> Outline:
    if isinstance(given, Outline):
        return given
    try:
        parts: list[Any] = list(given)  # type: ignore[arg-type]
        rings = parts if parts and np.ndim(parts[0]) == 2 else [parts]
        if any(np.iscomplexobj(ring) for ring in rings):
            raise TypeError("they are complex")
        return Outline.polygon(*rings)
    except (TypeError, ValueError) as problem:
        raise OutlineError(
            f"The {side} is not an (n, 2) array of numbers: {str(problem).rstrip('.')}.",
            where=Where(side),
            hint="Give the points of one closed polygon, or an Outline for holes.",
        ) from None


def _places(
    ends: tuple[Outline, Outline], pair: tuple[MarkIndex, MarkIndex], index: int
) -> tuple[RingPoint, RingPoint]:
    try:
        (ring, vertex), (other_ring, other) = map(_numbers, pair)
    except (TypeError, ValueError):
        raise MarkError(
            f"Mark {index} is {pair}, not a pair of vertices.",
            where=Where(marks=(index,)),
            hint="Give (vertex, vertex), or ((ring, vertex), (ring, vertex)).",
        ) from None
    return (
        _place(ends[0], ring, vertex, "source", index),
        _place(ends[1], other_ring, other, "target", index),
    )


def _numbers(mark: Any) -> tuple[int, int]:
    """Return ring and vertex; TypeError or ValueError for what names none."""
    ring, vertex = mark if np.ndim(mark) else (0, mark)
    return as_integer(ring), as_integer(vertex)


def _place(outline: Outline, ring: int, vertex: int, side: str, index: int) -> RingPoint:
    if not 0 <= ring < len(outline.rings) or not 0 <= vertex < len(outline.rings[ring]):
        raise MarkError(
            f"Mark {index} names vertex {vertex} of ring {ring} of the {side}, which is not there.",
            where=Where(side, marks=(index,)),
            hint="Count rings and vertices from 0.",
        )
    return RingPoint(ring, float(vertex))
