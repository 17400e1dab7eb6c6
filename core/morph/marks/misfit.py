"""How badly two places on two contours match, and how sure a match is."""

from __future__ import annotations

import numpy as np

from core.model.outline import Array
from core.morph.marks.contour import Complex, Samples

POSITION, FAR = 3.6, 1.0
"""Weight of a squared distance in radii, and the squared distance at which half is forgiven."""
DIRECTION = 0.5
"""Weight of 1 − cos of the angle between directions."""
TURN, SHARP = 0.3, 2.0
"""Weight of a squared difference of turns, and the square at which half is forgiven."""

POOR = 0.5
"""Misfit at which a match is doubtful."""
CLEAR = 0.2
"""By how much the shape must fit worse beside a match for it to be clear."""
BESIDE, REACH = 3, 10
"""Where beside: from so many samples to so many."""


def position_misfits(expected: Complex, there: Complex) -> Array:
    """Return (..., n, m) misfits of expected points (..., n) with those of a target (m,)."""
    away = expected[..., None] - there
    return POSITION * _levelled(away.real**2 + away.imag**2, FAR)


def turn_misfits(here: Samples, there: Samples) -> Array:
    """Return (n, m) misfits of turns, whatever the rotation.

    Great differences are levelled off: a slit that only one shape has must not outweigh the rest.
    """
    squares = (here.turns[:, :, None] - there.turns[:, None]) ** 2
    return TURN * _levelled(squares, SHARP).sum(axis=0)


def direction_misfits(here: Samples, rotation: Complex, there: Samples) -> Array:
    """Return (..., n, m) misfits of directions, the source's turned by ``rotation`` (..., n)."""
    turned = (here.directions * rotation)[..., None]
    cosine = turned.real * there.directions.real + turned.imag * there.directions.imag
    return DIRECTION * (1 - cosine)


def confidence(misfits: Array, shape: Array, columns: Array) -> Array:
    """Return (n,) in [0, 1] how sure it is that sample i belongs to sample ``columns[i]``.

    ``misfits`` (n, m) of everything and ``shape`` (n, m) of the shape alone. A match is sure where
    little is amiss with it and where the shape fits worse to either side: at a corner, not along a
    smooth arc.
    """
    n, m = misfits.shape
    offsets = np.arange(-REACH, REACH + 1)
    cells = np.arange(n)[:, None], (np.rint(columns).astype(int)[:, None] + offsets) % m
    here = _smoothed(misfits[cells])[:, REACH]
    along = _smoothed(shape[cells])
    beside = along[:, np.abs(offsets) >= BESIDE].min(axis=1) - along[:, REACH]
    return np.exp(-((here / POOR) ** 2)) * (1 - np.exp(-np.maximum(beside, 0) / CLEAR))


def _levelled(values: Array, half: float) -> Array:
    return values / (1 + values / half)


def _smoothed(values: Array) -> Array:
    """Average every row with its neighbours around the ring."""
    around = np.arange(len(values))[:, None] + np.arange(1 - BESIDE, BESIDE)
    return values[around % len(values)].mean(axis=1)
