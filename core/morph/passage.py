"""Through a key without a jolt: the velocity that the spans on both its sides share there.

Either span by itself arrives or leaves with a velocity gradient, and a velocity of its centre.
Between the two lies one that overshoots neither; a field of velocities that has it is fitted on
the later span's mesh, and read off for the earlier one's vertices.
"""

from __future__ import annotations

import numpy as np

from core.geometry.location import Located
from core.geometry.rotation import Complex
from core.model.outline import Array
from core.morph.morph import Morph

Durations = tuple[float, float]
"""How long the spans before and after a key last."""


def shared_velocity(before: Morph, after: Morph, durations: Durations) -> tuple[Array, Array]:
    """Return the velocities (n, 2) at a key of the vertices before it, and of those after it.

    They are per unit of time. Both motions must be able to pass.
    """
    first, second = durations
    arriving, centre_arriving = before.inbetween.rate(1)
    leaving, centre_leaving = after.inbetween.rate(0)
    centroids = after.rest[after.triangles].mean(axis=1)
    there = Located.on(before.target, before.triangles, centroids).triangle
    rate = _between_rates(arriving[:, there] / first, leaving / second, durations)
    centre = between(
        _column(before.unit / first * centre_arriving),
        _column(after.unit / second * centre_leaving),
        durations,
    )
    v = after.unit * after.inbetween.field(rate, complex(*centre.ravel()) / after.unit)
    return Located.on(after.rest, after.triangles, before.target).interpolate(v), v


def _between_rates(arriving: Complex, leaving: Complex, durations: Durations) -> Complex:
    """Return a velocity gradient (2, m) between two: spin and strain each for itself."""
    spin = between(arriving[:1].imag, leaving[:1].imag, durations)[0]
    strain = between(_strain(arriving), _strain(leaving), durations)
    return np.stack([strain[0] + 1j * spin, strain[1] + 1j * strain[2]])


def between(arriving: Array, leaving: Array, durations: Durations) -> Array:
    """Return rates (d, k) between those before and after a key, vector by vector.

    Their weighted harmonic mean where they point the same way, so that a cubic with it overshoots
    nothing (Fritsch and Butland 1984); less, down to nothing, the more they turn apart.
    """
    first, second = durations
    speeds = np.linalg.norm(arriving, axis=0), np.linalg.norm(leaving, axis=0)
    moving = (speeds[0] > 0) & (speeds[1] > 0)
    u, w = (np.where(moving, speed, 1) for speed in speeds)
    shares = first + 2 * second, 2 * first + second
    mean = (shares[0] + shares[1]) / (shares[0] / u + shares[1] / w)
    return np.where(moving, mean * (arriving / u + leaving / w) / 2, 0)


def _strain(rate: Complex) -> Array:
    """Return the symmetric part of velocity gradients (2, m) as vectors (3, m)."""
    return np.stack([rate[0].real, rate[1].real, rate[1].imag])


def _column(velocity: complex) -> Array:
    return np.array([[velocity.real], [velocity.imag]])
