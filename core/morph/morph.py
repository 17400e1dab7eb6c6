"""A solved morph: the mesh at both ends, and every frame between."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.model.turning import Turning
from core.morph.motion.motion import Motion
from core.morph.report import Report
from core.progress import Watch, unwatched


@dataclass(frozen=True, eq=False)
class Morph:
    """Immutable; ``at`` may be called from any thread."""

    triangles: Indices
    """(m, 3) vertex indices, positively oriented at rest."""
    rest: Array
    """(n, 2) vertices where the source was drawn; the boundary comes first."""
    target: Array
    """(n, 2) the same vertices where the target was drawn."""
    rings: tuple[Indices, ...]
    """The boundary as vertex indices, exterior first."""
    report: Report
    inbetween: Motion
    """Frames in the solver's coordinates."""
    origin: Array
    """(2,) where those coordinates have their zero."""
    unit: float
    """Their length unit, between the sizes of both ends: contact reaches as far both ways."""

    def __post_init__(self) -> None:
        self.rest.setflags(write=False)
        self.target.setflags(write=False)

    @property
    def morph(self) -> Self:
        """Itself: what is seen of it is all of it."""
        return self

    @property
    def angle(self) -> float:
        """How far the shape turns as a whole, in radians; clockwise is positive."""
        course = self.inbetween.course
        return 0.0 if course is None else course.angle

    def along(self, turning: Turning) -> Self:
        """Return the morph that turns and travels as told; all that was solved is shared."""
        return replace(self, inbetween=self.inbetween.along(turning))

    def passing(self, start: Array | None, end: Array | None, watch: Watch = unwatched) -> Self:
        """Return the morph whose vertices have these velocities (n, 2), per unit s, at its ends.

        At an end that has None the motion is as it was.
        """
        ends = self.inside(self.rest), self.inside(self.target)
        first, last = (None if v is None else v / self.unit for v in (start, end))
        inbetween = self.inbetween.passing(ends, self.triangles, (first, last), watch)
        return replace(self, inbetween=inbetween)

    def inside(self, points: Array) -> Array:
        """Return points (k, 2) in the solver's coordinates."""
        return (points - self.origin) / self.unit

    def at(self, s: float) -> Array:
        """Return positions (n, 2) at progress s: the source at 0, the target at 1, both exactly.

        Outside [0, 1] the motion is carried on, for easings that overshoot. The array is read-only.
        """
        if s in (0, 1):
            return self.target if s else self.rest
        return self._outside(self.inbetween(s))

    def plain(self, s: float) -> Array | None:
        """Return what ``at`` does, or None if the frame must be held, which takes a while."""
        if s in (0, 1):
            return self.at(s)
        positions = self.inbetween.plain(s)
        return None if positions is None else self._outside(positions)

    def _outside(self, positions: Array) -> Array:
        """Put positions (n, 2) of the solver, made just now, into the document's coordinates."""
        positions *= self.unit
        positions += self.origin
        positions.setflags(write=False)
        return positions
