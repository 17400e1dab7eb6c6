"""The places at which two contours are sampled to be matched."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.marks.chain import Pair
from core.morph.marks.contour import Contour
from core.morph.marks.elastic import STEEPEST

BINS = 100
"""Samples of a contour."""
COARSE = 2
"""Every so-manieth of them is enough to begin with."""


@dataclass(frozen=True, eq=False)
class Grid:
    """Places in order on both contours."""

    source: Array
    """(n,)"""
    target: Array
    """(m,)"""
    pins: Indices
    """(k, 2) samples that belong together, in order; the first is (0, 0)."""

    @classmethod
    def free(cls, source: Contour, target: Contour) -> Self:
        """Sample evenly, from vertices that do not depend on where the rings' lists start."""
        steps = np.arange(BINS) / BINS
        here, there = (np.mod(ring.prominent() + steps, 1.0) for ring in (source, target))
        return cls(here, there, np.empty((0, 2), dtype=np.int64))

    @classmethod
    def through(cls, fixed: Sequence[Pair]) -> Self:
        """Sample evenly from each of the ``fixed`` pairs to the next, about as finely everywhere.

        The pairs are in order around both contours.
        """
        pins = np.array(fixed)
        arcs = np.mod(np.roll(pins, -1, axis=0) - pins, 1.0) if len(pins) > 1 else np.ones((1, 2))
        bins = np.maximum(np.round(arcs * (BINS / COARSE)), 1)
        bins = np.maximum(bins, np.ceil(bins[:, ::-1] / STEEPEST)).astype(np.int64) * COARSE
        here, there = (
            np.concatenate([a + arc * np.arange(n) / n for a, arc, n in zip(*side, strict=True)])
            for side in zip(pins.T, arcs.T, bins.T, strict=True)
        )
        return cls(np.mod(here, 1.0), np.mod(there, 1.0), np.cumsum(bins, axis=0) - bins)


def widths(at: Array) -> Array:
    """Return (n,) how much of the perimeter belongs to each of the samples at ``at`` (n,)."""
    steps = np.mod(np.roll(at, -1) - at, 1.0)
    return (steps + np.roll(steps, 1)) / 2


def bin_width(at: Array, index: int) -> float:
    """Return how far it is from one sample to the next, in even bins."""
    n = len(at)
    return float(np.mod(at[(index + 1) % n] - at[index % n], 1.0)) * BINS
