"""What a matching compares: a ring sampled along its length, and its corners.

Points and directions are complex numbers: a product turns and scales, and the argument of
``a · conj(b)`` is the angle from b to a. Places are fractions of the perimeter, in [0, 1).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from core.geometry.polyline import arc_lengths, points_at, resample, reversed_ring, signed_area
from core.geometry.rotation import Complex
from core.model.outline import Array

EVEN = 128
"""Samples that the centre and the size of a ring are measured on."""
DIRECTION_REACH = 0.005
"""Half the chord that a direction is measured on, as a fraction of the perimeter."""
TURN_REACHES = (0.01, 0.03)
"""The chords before and after a point that its turns are measured between."""
CORNER = np.radians(30)
"""A vertex where a ring turns by more than this, over the shortest such chords, is a corner."""
ACROSS, WIDE = 3.0, 1 / np.pi
"""Across from a place lies what is so many times further along the ring; if nothing does, the ring
is as wide as a circle."""
HAIR = 0.0015
"""Places this near to a vertex may as well lie on it: a sample is no more exact."""


@dataclass(frozen=True, eq=False)
class Contour:
    """A ring that runs with positive area, centred and scaled to radius one."""

    points: Array
    """(n, 2)"""
    lengths: Array
    """(n + 1,) arc lengths of the vertices and of the end."""
    backwards: bool
    """Whether the ring that was given ran the other way round."""

    @classmethod
    def of(cls, ring: Array) -> Self:
        """Prepare a ring (n, 2) of any orientation, place and size."""
        even = resample(ring, EVEN)
        centre = even.mean(axis=0)
        points = (ring - centre) / np.sqrt(np.mean(np.sum((even - centre) ** 2, axis=1)))
        backwards = signed_area(points) < 0
        points = reversed_ring(points) if backwards else points
        return cls(points, arc_lengths(points), backwards)

    def mirrored(self) -> Contour:
        """Return the reflection."""
        points = reversed_ring(self.points * [1.0, -1.0])
        return Contour(points, arc_lengths(points), not self.backwards)

    def translated(self, at: Array) -> Array:
        """Translate places on the ring that was given into places here, or back again."""
        return np.mod(-at if self.backwards else at, 1.0)  # both orders start at the same vertex

    def points_at(self, at: Array) -> Complex:
        """Return the points at places (k,), taken modulo one."""
        points = points_at(self.points, self.lengths, at * self.lengths[-1])
        return points[:, 0] + 1j * points[:, 1]

    def drawn(self, at: Array) -> Array:
        """Return places (k,) in [0, 1), those a hair from a vertex moved onto it."""
        vertices = self.lengths / self.lengths[-1]
        after = np.searchsorted(vertices, at)
        nearest = np.where(at - vertices[after - 1] < vertices[after] - at, after - 1, after)
        close = np.abs(vertices[nearest] - at) < HAIR
        return np.mod(np.where(close, vertices[nearest], at), 1.0)

    def turns_at(self, at: Array, reach: float) -> Array:
        """Return the angles (k,) between the chords before and after places."""
        before, here, after = (self.points_at(at + step) for step in (-reach, 0.0, reach))
        return np.angle((after - here) * np.conj(here - before))

    def widths_at(self, at: Array) -> Array:
        """Return how far it is across from places (k,), as fractions of the perimeter.

        Across lies what is near, but far along the ring.
        """
        others = np.arange(EVEN) / EVEN
        away = np.abs(self.points_at(at)[:, None] - self.points_at(others)) / self.lengths[-1]
        across = np.abs(gap(at[:, None], others)) > ACROSS * away
        return np.where(across, away, WIDE).min(axis=1)

    def area_and_centre(self) -> tuple[float, complex]:
        """Return the enclosed area, and its centre."""
        z = self.points[:, 0] + 1j * self.points[:, 1]
        after = np.roll(z, -1)
        doubled = (np.conj(z) * after).imag
        area = float(doubled.sum()) / 2
        return area, complex((doubled @ (z + after)) / (6 * area))

    def prominent(self) -> float:
        """Return the vertex farthest from the centre: the same wherever the list starts."""
        away = np.round(np.hypot(self.points[:, 0], self.points[:, 1]), 9)
        return float(self.lengths[np.argmax(away)] / self.lengths[-1])

    @cached_property
    def corners(self) -> tuple[Array, Array]:
        """The places (k,) of the corners, and how far the ring turns there."""
        at = self.lengths[:-1] / self.lengths[-1]
        turns = self.turns_at(at, TURN_REACHES[0])
        free = np.abs(turns) > CORNER
        corners = []
        for i in np.argsort(-np.abs(turns), kind="stable"):  # the sharpest rules those around it
            if free[i]:
                corners.append(i)
                free &= (np.abs(gap(at, at[i])) >= TURN_REACHES[0]) | (turns * turns[i] < 0)
        found = np.sort(np.array(corners, dtype=np.int64))
        return at[found], turns[found]


@dataclass(frozen=True, eq=False)
class Samples:
    """A contour at n places in order."""

    at: Array
    """(n,)"""
    points: Complex
    """(n,)"""
    directions: Complex
    """(n,) of length one."""
    turns: Array
    """(r, n) one row for each of ``TURN_REACHES``."""

    @classmethod
    def of(cls, contour: Contour, at: Array) -> Self:
        """Sample a contour at places (n,)."""
        chord = contour.points_at(at + DIRECTION_REACH) - contour.points_at(at - DIRECTION_REACH)
        return cls(
            at,
            contour.points_at(at),
            chord / np.maximum(np.abs(chord), 1e-12),
            np.array([contour.turns_at(at, reach) for reach in TURN_REACHES]),
        )

    def every(self, step: int) -> Samples:
        """Return every so-manieth sample."""
        return Samples(
            self.at[::step], self.points[::step], self.directions[::step], self.turns[:, ::step]
        )

    def between(self, index: Array) -> Complex:
        """Return the points at fractional indices (k,), taken modulo n."""
        low = np.floor(index).astype(np.int64)
        u, n = index - low, len(self.at)
        return (1 - u) * self.points[low % n] + u * self.points[(low + 1) % n]


def gap(a: Array, b: Array | float) -> Array:
    """Return a − b for places on a ring, the short way round."""
    return np.mod(a - b + 0.5, 1.0) - 0.5
