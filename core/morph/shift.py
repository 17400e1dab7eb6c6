"""Where a ring starts when nobody said: the best cyclic shift."""

from __future__ import annotations

import numpy as np

from core.geometry.polyline import arc_lengths, resample
from core.geometry.rotation import Complex, to_complex
from core.model.outline import Array

SAMPLES = 256
TURN_LITTLE, TURN_ALIKE = 0.02, 0.5
"""How much a rotation counts beside the fit: a small one, and one like another that is given."""
SNAP = 1.5
"""How many samples away a vertex may be that the start moves to."""


def best_shift(
    source: Array, target: Array, rotation: complex | None = None
) -> tuple[float, float]:
    """Find corresponding starts of two clean rings (n, 2) and (k, 2).

    Returns the arc length on the source and that on the target. Each cyclic shift is scored by how
    well the rings then fit under their best similarity (Procrustes); between near equals the
    smaller rotation wins, or the one closest to ``rotation``, of length one, if that is given.
    """
    start = float(arc_lengths(source)[farthest_out(source, source)])
    a, b = _samples(source, start), _samples(target, 0.0)
    fit = np.fft.ifft(np.conj(np.fft.fft(a)) * np.fft.fft(b))  # Σ conj(a_i) b_{i+k}
    turn = fit / np.maximum(np.abs(fit), 1e-300)
    wish = turn.real if rotation is None else (turn * np.conj(rotation)).real
    weight = TURN_LITTLE if rotation is None else TURN_ALIKE
    shift = int(np.argmax(np.abs(fit) * (1 + weight * wish)))
    lengths = arc_lengths(target)
    sample = lengths[-1] / SAMPLES
    return start, _to_vertex(lengths, shift * sample, SNAP * sample)


def farthest_out(places: Array, ring: Array) -> int:
    """Return which of places (k, 2) is farthest from the centre of a ring (n, 2).

    Where its list of points starts does not matter, nor does rounding.
    """
    away = places - resample(ring, SAMPLES).mean(axis=0)
    return int(np.argmax(np.round(np.hypot(away[:, 0], away[:, 1]) / np.ptp(ring), 9)))


def _samples(points: Array, start: float) -> Complex:
    """Return (SAMPLES,) centred points as complex numbers."""
    z = to_complex(resample(points, SAMPLES, start))
    return z - z.mean()


def _to_vertex(lengths: Array, at: float, reach: float) -> float:
    """Move an arc length to the nearest vertex within reach."""
    perimeter = lengths[-1]
    gap = np.abs(np.mod(lengths[:-1] - at + perimeter / 2, perimeter) - perimeter / 2)
    nearest = int(np.argmin(gap))
    return float(lengths[nearest]) if gap[nearest] <= reach else float(at)
