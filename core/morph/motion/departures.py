"""How far a motion departs from its fits, smoothly through time."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence

import numpy as np

from core.geometry.rotation import Complex, phasor
from core.model.outline import Array
from core.morph.motion.passing import bumps


class Departures:
    """Departures known at some moments, and a cubic between any two (Hermite).

    Each vertex's is seen from a frame that turns as the shape does around it, so that a limb that
    is pushed aside stays aside of where it would be. At rest and at the target there is none, and
    no change of it.
    """

    def __init__(self, turning: Array, times: Sequence[float], departures: Complex) -> None:
        """Prepare for departures (k, n) at times (k,) from 0 to 1.

        ``turning`` (n,) is how far the shape turns around each vertex per unit of time.
        """
        self._turning, self._times, self._values = turning, times, departures
        widths = np.diff(times)[:, None]
        before, after = widths[:-1], widths[1:]
        rates = np.diff(departures, axis=0) / widths
        self._slopes = np.zeros_like(departures)
        self._slopes[1:-1] = (after * rates[:-1] + before * rates[1:]) / (before + after)

    def __call__(self, t: float) -> Complex:
        """Return the departure (n,) at t between 0 and 1."""
        k = bisect_left(self._times, t)
        width = self._times[k] - self._times[k - 1]
        s = (t - self._times[k - 1]) / width
        rise = s * s * (3 - 2 * s)
        value = (1 - rise) * self._values[k - 1] + rise * self._values[k]
        for bump, slope in zip(bumps(s), self._slopes[k - 1 : k + 1], strict=True):
            value += width * bump * slope
        return phasor(t * self._turning) * value
