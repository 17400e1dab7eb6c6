"""How a shape turns and travels as a whole: its triangles' gradients say nothing of that."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import log, sqrt
from typing import Self

import numpy as np

from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.model.turning import AS_DRAWN, Turning
from core.morph.motion.passing import bumps


@dataclass(frozen=True, eq=False)
class Course:
    """Carries the centre of mass from end to end, and adds whole turns about it.

    A vertex's mass is its share of the area, averaged over both ends. On an arc the centre moves
    as under c → e^λ c + b, the similarity with the shape's turn and growth that takes one end's
    centre to the other's: round its fixed point, in a circle or a logarithmic spiral. Parts that
    hang together at a joint stay together on it.
    """

    mass: Array
    """(n,)"""
    centres: tuple[complex, complex]
    """At both ends."""
    turn: float
    """The shape's mean rotation, in [-π, π)."""
    growth: float
    """How many times larger it is at the end: the root of the ratio of the areas."""
    turning: Turning
    velocities: tuple[complex | None, complex | None] = (None, None)
    """Of the centre, where the motion passes through an end."""

    @classmethod
    def of(
        cls, ends: tuple[Array, Array], triangles: Indices, turn: float, turning: Turning = AS_DRAWN
    ) -> Self:
        """Prepare for positions (n, 2) at both ends, triangles (m, 3) and the mean rotation."""
        (before, area), (after, later_area) = (_mass(end, triangles) for end in ends)
        mass = (before + after) / 2
        start, end = (complex(*(mass @ end)) for end in ends)
        return cls(mass, (start, end), turn, sqrt(later_area / area), turning)

    def along(self, turning: Turning) -> Self:
        """Return the course between the same ends with another turning."""
        return replace(self, turning=turning)

    def passing(self, start: complex | None, end: complex | None) -> Self:
        """Return the course whose centre has these velocities at its ends."""
        return replace(self, velocities=(start, end))

    @property
    def angle(self) -> float:
        """How far the shape turns in all; clockwise is positive where y points down."""
        return self.turning.angle(self.turn)

    @property
    def spin(self) -> float:
        """How far whole frames are turned per unit t."""
        return self.angle - self.turn

    def __call__(self, x: Array, t: float) -> Array:
        """Return a frame's positions x (n, 2), wherever they lie, turned and put in place."""
        if self.spin:
            c, s = np.cos(t * self.spin), np.sin(t * self.spin)
            x = x @ np.array([[c, s], [-s, c]])
        centre = self._centre(t)
        return x + ([centre.real, centre.imag] - self.mass @ x)

    def own_velocity(self, t: float) -> complex:
        """Return the centre's velocity at t in a span by itself."""
        start, end = self.centres
        if self._rate == 0:
            return end - start
        return complex(self._rate * np.exp(t * self._rate) / np.expm1(self._rate)) * (end - start)

    @cached_property
    def _rate(self) -> complex:
        """Growth and swing per unit t on the arc, as a complex logarithm; 0 for a straight path."""
        if self.turning.path == "straight":
            return 0
        return complex(log(self.growth), self.turning.swing(self.turn))

    def _centre(self, t: float) -> complex:
        start, end = self.centres
        way = t if self._rate == 0 else complex(np.expm1(t * self._rate) / np.expm1(self._rate))
        centre = start + way * (end - start)
        for bump, at, velocity in zip(bumps(t), (0, 1), self.velocities, strict=True):
            if velocity is not None:
                centre += bump * (velocity - self.own_velocity(at))
        return centre


def _mass(points: Array, triangles: Indices) -> tuple[Array, float]:
    """Return each vertex's share (n,) of the area, and the area."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    u, v = b - a, c - a
    areas = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    around = np.bincount(triangles.ravel(), weights=np.repeat(areas, 3), minlength=len(points))
    return around / around.sum(), float(areas.sum())
