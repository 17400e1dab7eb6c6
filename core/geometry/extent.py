"""Sizes and distances that can be computed with."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from core.errors import OutlineError, Where
from core.geometry.clean_outline import CleanOutline
from core.geometry.polyline import diagonal
from core.model.outline import Array
from core.model.structure import FARTHEST

LEAST, MOST = 1e-12, FARTHEST
"""Diagonals whose squares and fourth powers stay finite."""
COARSEST = 1e-6
"""Largest step between neighbouring numbers, as a fraction of the diagonal: far from the origin
few digits are left for the shape."""


def size_of(rings: Sequence[Array], side: str) -> float:
    """Return the diagonal of rings (n, 2); refuse what cannot be computed with."""
    points = np.concatenate(rings)
    if not len(points):
        return 0.0
    with np.errstate(over="ignore"):
        size = diagonal(points)
    if size == 0:
        return size
    if not LEAST <= size <= MOST:
        raise OutlineError(
            f"The {side} is {size:.3g} wide, outside {LEAST:g} to {MOST:g}.",
            where=Where(side),
            hint="Scale it.",
        )
    far = float(np.abs(points).max())
    if np.spacing(far) > COARSEST * size:
        raise OutlineError(
            f"The {side} is {size:.3g} wide and {far:.3g} away from the origin, where numbers are"
            f" {np.spacing(far):.1g} apart: too coarse for its shape.",
            where=Where(side),
            hint="Move it closer to the origin.",
        )
    return size


def check_together(ends: Sequence[CleanOutline]) -> None:
    """Refuse outlines of which one is too small beside where the other lies: in-betweens of it
    could not be told from each other.
    """
    far = max(float(np.abs(end.rings[0]).max()) for end in ends)
    small = min(end.diagonal for end in ends)
    if np.spacing(far) > COARSEST * small:
        raise OutlineError(
            f"One outline is {small:.3g} wide, and the other reaches to {far:.3g}, where numbers"
            f" are {np.spacing(far):.1g} apart: too coarse for frames between them.",
            hint="Make them more alike in size, and move them closer to the origin.",
        )
