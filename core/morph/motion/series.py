"""A smooth motion as a Chebyshev series in time: a frame for less than a back-substitution.

Ideal gradients are exponentials in t, and the fit is linear in them. So every vertex moves along an
entire function of t, of which a few samples tell all to the last digits (Trefethen 2013,
*Approximation Theory and Approximation Practice*, chapters 3 and 8).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.fft import dct

from core.model.outline import Array

DEGREES = 16, 32, 64
"""Tried in order; beyond, frames are made one by one."""
EXACT = 1e-13
"""Largest part of a series that its last terms may have."""
LAST = 3
"""How many terms have to be that small, since every other one may vanish."""


class Series:
    """Frames of a motion in [0, 1] by one product with a few terms; others as the motion has them.

    A frame depends on its time alone, and the terms on the motion alone.
    """

    def __init__(self, motion: Callable[[float], Array]) -> None:
        """Sample a motion that takes t to positions (n, 2)."""
        self._motion = motion
        self._terms = _terms(motion)

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        if self._terms is None or not 0 <= t <= 1:
            return self._motion(t)
        turns = np.arange(len(self._terms)) * np.arccos(2 * t - 1)
        frame: Array = np.cos(turns) @ self._terms
        return frame.reshape(-1, 2)


def _terms(motion: Callable[[float], Array]) -> Array | None:
    """Return the coefficients (degree + 1, 2n), or None where no degree is enough."""
    samples: list[Array] = []
    for degree in DEGREES:
        times = (1 + np.cos(np.pi * np.arange(degree + 1) / degree)) / 2
        known = iter(samples)  # every other time of twice the degree
        new = [not samples or place % 2 == 1 for place in range(degree + 1)]
        samples = [
            motion(float(t)).ravel() if fresh else next(known)
            for t, fresh in zip(times, new, strict=True)
        ]
        terms: Array = dct(np.array(samples), type=1, axis=0) / degree
        terms[[0, -1]] /= 2
        sizes = np.abs(terms).max(axis=1)
        if sizes[-LAST:].max() <= EXACT * sizes.max():
            needed = np.flatnonzero(sizes > EXACT / 10 * sizes.max())
            return np.ascontiguousarray(terms[: needed[-1] + 1 if len(needed) else 1])
    return None
