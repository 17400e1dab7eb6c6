"""The boundary by its edge lengths and turning angles (Sederberg et al. 1993): to compare with.

T. W. Sederberg, P. Gao, G. Wang and H. Mu, "2-D shape blending: an intrinsic solution to the vertex
path problem", SIGGRAPH 1993. It knows the outline alone, so limbs keep their length while the area
may change. Points are complex numbers here.
"""

from __future__ import annotations

import numpy as np

from core.fem.elements import Elements
from core.fem.newton import Factor
from core.geometry.rotation import Complex, to_complex, to_points
from core.geometry.triangulation import Indices, boundary_rings
from core.model.outline import Array
from core.progress import Watch, unwatched

STIFFEST = 1e-4
"""How much an edge that keeps its length may give way, relative to that length."""


class Intrinsic:
    """Interpolates every ring by its lengths and angles; inner vertices follow harmonically.

    All is seen from a frame that turns with the exterior ring, so rigid motion is reproduced.
    """

    def __init__(
        self, rest: Array, target: Array, triangles: Indices, watch: Watch = unwatched
    ) -> None:
        rings = boundary_rings(triangles)
        z, w = to_complex(rest), to_complex(target)
        exterior = max(rings, key=lambda ring: np.ptp(z[ring].real))
        self.turn = _mean_turn(z[exterior], w[exterior])
        w = w * np.exp(-1j * self.turn)
        self._paths = [(ring, _RingPath(z[ring], w[ring])) for ring in rings]
        self._extension = _Extension(Elements.of(rest, triangles), np.concatenate(rings))
        self._drift = w - self._extension(w)

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t, wherever they lie."""
        x = np.zeros_like(self._drift)
        for ring, path in self._paths:
            x[ring] = path(t)
        # the target's inner vertices need not lie where its boundary alone would put them
        x = (self._extension(x) + t * self._drift) * np.exp(1j * t * self.turn)
        return to_points(x)


class _RingPath:
    """A closed polygon whose edge lengths and turning angles change evenly."""

    def __init__(self, rest: Complex, target: Complex) -> None:
        before, after = (np.roll(ring, -1) - ring for ring in (rest, target))
        self._lengths = np.abs(before), np.abs(after)
        self._start, self._turned = _directions(before), _turns(rest, target)
        self._mass = sum(_mass(lengths) for lengths in self._lengths) / 2
        self._centres = self._mass @ rest, self._mass @ target
        mean = sum(self._lengths) / 2
        change = np.abs(self._lengths[1] - self._lengths[0])
        self._give = np.maximum(change, STIFFEST * mean) ** 2

    def __call__(self, t: float) -> Complex:
        """Return the vertices (k,) at t."""
        ahead = np.exp(1j * (self._start + t * self._turned))
        lengths = (1 - t) * self._lengths[0] + t * self._lengths[1]
        edges = (lengths - self._correction(lengths, ahead)) * ahead
        ring = np.cumsum(edges) - edges
        return ring + (1 - t) * self._centres[0] + t * self._centres[1] - self._mass @ ring

    def _correction(self, lengths: Array, ahead: Complex) -> Array:
        """Return what to take off the lengths (k,) so that the polygon closes.

        The least Σ (s / change of length)² for which Σ (length − s) · direction = 0, by Lagrange.
        """
        u = np.stack([ahead.real, ahead.imag])
        multipliers = np.linalg.solve((self._give * u) @ u.T, u @ lengths)
        return self._give * (multipliers @ u)


class _Extension:
    """Inner vertices of a mesh where its boundary puts them: harmonic, factored once."""

    def __init__(self, elements: Elements, border: Indices) -> None:
        self._border = border
        self._inner = np.setdiff1d(np.arange(elements.vertices), border)
        rows = elements.laplacian[self._inner]
        self._load = rows[:, border]
        self._factor = Factor(rows[:, self._inner].tocsc()) if len(self._inner) else None

    def __call__(self, z: Complex) -> Complex:
        """Return positions (n,) with the boundary of z (n,) and harmonic inside."""
        z = z.copy()
        if self._factor is not None:
            load = self._load @ z[self._border]
            solved = self._factor.solve(-to_points(load))
            z[self._inner] = to_complex(solved)
        return z


def _directions(edges: Complex) -> Array:
    """Return the angles (k,) of edges, unwrapped along the ring."""
    turning = np.angle(edges[1:] / edges[:-1])
    return np.angle(edges[0]) + np.concatenate([[0.0], np.cumsum(turning)])


def _turns(rest: Complex, target: Complex) -> Array:
    """Return how far each edge turns (k,); on the mean between −π and π."""
    before, after = (np.roll(ring, -1) - ring for ring in (rest, target))
    turns = _directions(after) - _directions(before)
    mean = np.average(turns, weights=np.abs(before) + np.abs(after))
    return turns - 2 * np.pi * np.floor((mean + np.pi) / (2 * np.pi))


def _mean_turn(rest: Complex, target: Complex) -> float:
    weights = sum(np.abs(np.roll(ring, -1) - ring) for ring in (rest, target))
    return float(np.average(_turns(rest, target), weights=weights))


def _mass(lengths: Array) -> Array:
    """Return each vertex's share (k,) of the perimeter."""
    return (lengths + np.roll(lengths, 1)) / (2 * lengths.sum())
