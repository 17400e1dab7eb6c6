"""Turning and moving as a whole."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from core.model.outline import Array


@dataclass(frozen=True)
class RigidMotion:
    """Takes z to turn · z + shift, |turn| = 1."""

    turn: complex = 1
    shift: complex = 0

    @classmethod
    def between(cls, here: Array, there: Array) -> Self:
        """Return the one that takes points (k, 2) closest to others, in squares (Procrustes)."""
        (z, centre), (w, goal) = (_about_mean(points) for points in (here, there))
        turn = complex(np.vdot(z, w))
        turn = turn / abs(turn) if turn else 1
        return cls(turn, goal - turn * centre)

    def __call__(self, points: Array) -> Array:
        """Move points (k, 2)."""
        return points if self == STILL else points @ self.matrix.T + self.offset

    def displacement(self, point: Array) -> complex:
        """Return by how much a point (2,) is moved."""
        return complex(*(self(point) - point))

    @property
    def matrix(self) -> Array:
        """(2, 2)"""
        a = self.turn
        return np.array([[a.real, -a.imag], [a.imag, a.real]])

    @property
    def offset(self) -> Array:
        """(2,)"""
        return np.array([self.shift.real, self.shift.imag])

    def back(self, points: Array) -> Array:
        """Move points (k, 2) to where they came from."""
        turn = self.turn.conjugate()
        return RigidMotion(turn, -turn * self.shift)(points)


STILL = RigidMotion()


def _about_mean(points: Array) -> tuple[Array, complex]:
    z = points[:, 0] + 1j * points[:, 1]
    return z - z.mean(), complex(z.mean())
