"""The widest that the smallest angle of any mesh can be, as far as the outlines' corners decide."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from core.geometry.polyline import inner_angles

MOST_TRIANGLES = 6
"""At one corner: a full turn of equilateral ones."""


def allowed_angle(source: Sequence[np.ndarray], target: Sequence[np.ndarray]) -> float:
    """Return the bound in degrees, of corresponding rings (k, 2), holes clockwise.

    A corner with the inner angles α and β in source and target, α ≤ β, that k triangles share has
    one of at most α / k. And β / k, if it is wide, leaves (180° − β / k) / 2 to the other two
    corners of one of them. The mesh may choose k, but it is the same at both ends.
    """
    bounds = []
    for ends in zip(source, target, strict=True):
        angles = np.degrees([inner_angles(ring) for ring in ends])
        narrow, wide = angles.min(axis=0), angles.max(axis=0)
        k = np.arange(1, MOST_TRIANGLES + 1)[:, None]
        bounds.append(np.minimum(narrow / k, (180 - wide / k) / 2).max(axis=0))
    return float(np.concatenate(bounds).min())
