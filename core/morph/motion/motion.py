"""A motion: how a shape changes from rest to target, and how it turns and travels as a whole."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from core.fem.elements import Elements
from core.geometry.rotation import Complex, turn_and_mirror
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.model.recipe import Method
from core.model.turning import AS_DRAWN, Turning
from core.morph.motion.course import Course
from core.morph.motion.interpolate import Interpolate
from core.morph.motion.methods import METHODS
from core.morph.motion.rigid import PlainRigid, Rigid
from core.progress import Watch, unwatched


@dataclass(frozen=True, eq=False)
class Motion:
    """The shape and its course are told apart, so that turning a frame can never fold it."""

    shape: Interpolate
    course: Course | None
    """None where every vertex has a path of its own."""

    @classmethod
    def of(
        cls,
        method: Method,
        ends: tuple[Array, Array],
        triangles: Indices,
        turning: Turning = AS_DRAWN,
        watch: Watch = unwatched,
    ) -> Self:
        """Prepare a method for positions (n, 2) at rest and target, and triangles (m, 3)."""
        shape = METHODS[method](*ends, triangles, watch)
        if shape.turn is None:
            return cls(shape, None)
        return cls(shape, Course.of(ends, triangles, shape.turn, turning))

    def along(self, turning: Turning) -> Self:
        """Return the motion of the same shape on another course."""
        return self if self.course is None else replace(self, course=self.course.along(turning))

    @property
    def angles(self) -> Array:
        """How far each triangle turns (m,) from end to end; as the whole, if that is not known."""
        if self.course is None:
            return np.zeros(1)
        if isinstance(self.shape, Rigid | PlainRigid):
            return self.shape.theta + self.course.spin
        return np.array([self.course.angle])

    @property
    def can_pass(self) -> bool:
        """Whether it can be given velocities at its ends."""
        return isinstance(self.shape, Rigid)

    def passing(
        self,
        ends: tuple[Array, Array],
        triangles: Indices,
        velocities: tuple[Array | None, Array | None],
        watch: Watch = unwatched,
    ) -> Self:
        """Return the motion whose vertices have these velocities (n, 2) at its ends.

        ``ends`` and ``triangles`` are those it was prepared for. None is as in a span by itself.
        """
        _, course = self._parts
        start, end = (
            None if v is None else _spun(_gradient(v, x, triangles), -course.spin)
            for v, x in zip(velocities, ends, strict=True)
        )
        of_centre = (None if v is None else complex(*(course.mass @ v)) for v in velocities)
        return replace(
            self,
            shape=Rigid(*ends, triangles, watch, (start, end)),
            course=course.passing(*of_centre),
        )

    def rate(self, end: int) -> tuple[Complex, complex]:
        """Return what an end, 0 or 1, has in a span by itself.

        That is the velocity gradient (2, m), as turns and mirrors, and the centre's velocity.
        """
        shape, course = self._parts
        rate = shape.exponent.rate_at_end if end else shape.exponent.rate_at_start
        return _spun(rate, course.spin), course.own_velocity(end)

    def field(self, rate: Complex, centre: complex) -> Array:
        """Return velocities (n, 2) at the start: their gradients are closest to rate (2, m)."""
        shape, course = self._parts
        v = shape.fit(rate)
        return v + ([centre.real, centre.imag] - course.mass @ v)

    @property
    def _parts(self) -> tuple[Rigid, Course]:
        if not isinstance(self.shape, Rigid) or self.course is None:
            raise TypeError(f"a motion of a {type(self.shape).__name__} cannot pass through a key")
        return self.shape, self.course

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        return self._placed(self.shape(t), t)

    def plain(self, t: float) -> Array | None:
        """Return positions (n, 2) at t if they need not be held, which costs little; else None."""
        x = self.shape.plain(t) if isinstance(self.shape, Rigid) else self.shape(t)
        return None if x is None else self._placed(x, t)

    def _placed(self, x: Array, t: float) -> Array:
        return x if self.course is None else self.course(x, t)


def _gradient(values: Array, points: Array, triangles: Indices) -> Complex:
    """Return the gradient of values (n, 2) at points (n, 2), as turns and mirrors (2, m)."""
    gradients = Elements.of(points, triangles).deformation_gradients(values)
    return np.stack(turn_and_mirror(gradients))


def _spun(rate: Complex, spin: float) -> Complex:
    """Return a velocity gradient (2, m) with a rotation of the whole added."""
    return np.stack([rate[0] + 1j * spin, rate[1]])
