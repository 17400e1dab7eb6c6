"""Placing shapes on the artboard."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from core.model.outline import Array, Outline

MARGIN = 0.1
"""Share of the artboard that stays free at each side."""


def fit(outlines: Iterable[Outline], size: tuple[float, float]) -> tuple[float, Array]:
    """Return the scale and the offset (2,) that centre outlines on an artboard and fill it.

    Proportions are kept. Shapes without extent are centred as they are.
    """
    bounds = np.array([outline.bounds() for outline in outlines])
    low, high = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
    extent = high - low
    room = (1 - 2 * MARGIN) * np.asarray(size, dtype=float)
    wide = extent > 0
    scale = float((room[wide] / extent[wide]).min()) if wide.any() else 1.0
    return scale, np.asarray(size) / 2 - scale * (low + high) / 2
