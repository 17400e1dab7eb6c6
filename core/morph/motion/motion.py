"""A motion: how a shape changes from rest to target, and how it turns and travels as a whole."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.model.recipe import Method
from core.model.turning import AS_DRAWN, Turning
from core.morph.motion.course import Course
from core.morph.motion.interpolate import Interpolate
from core.morph.motion.methods import METHODS
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

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        x = self.shape(t)
        return x if self.course is None else self.course(x, t)
