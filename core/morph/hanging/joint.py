"""Where a layer is joined to the one it hangs on, and how that one carries it.

The joint is made of vertices that lie on the carrier at a key. Those count most that lie at the
same place of it at both keys: a limb's where it turns, a wheel's at its hub.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Protocol, cast

import numpy as np
import shapely

from core.geometry.distance import distances
from core.geometry.flatten import flatten
from core.geometry.polyline import diagonal
from core.geometry.rotation import wrap
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.hanging.carried import CarriedPoints
from core.morph.hanging.rigid import RigidMotion
from core.morph.hanging.seen import Seen, as_solved
from core.morph.morph import Morph
from core.morph.motion.passing import bumps

if TYPE_CHECKING:
    from core.morph.hanging.run import Phase, Run

MOST_POINTS = 200
LEAST_POINTS = 8
"""What lies nearest to the carrier is joined to it, if less lies on it."""
NO_TIME = 1e-4
"""Part of a span in which nothing turns unevenly."""
CLOSE = 0.03
"""By how much what hardly slides on the carrier may do so, as a fraction of the layer's size."""
STIFF = 0.1
"""Turn on the carrier, in radians, below which it is doubtful what a layer turns about."""
NEAR = 2.0
"""How far that may be from the points that slide least, in standard deviations of these."""


class Joint(Protocol):
    """How a layer is carried in one phase."""

    def __call__(self, frame: float, seen: Seen = as_solved) -> RigidMotion:
        """Return how far it has been carried at a frame."""
        ...

    def turned(self, frame: float) -> float:
        """Return the angle of that motion, whole turns included."""
        ...


class StillJoint:
    """Carries a key that stands still along, from its own frame to those before or after it."""

    def __init__(self, phase: Phase, carrier: Run) -> None:
        outline = np.concatenate([line.points for line in flatten(phase.outline)])
        self._points = outline[_joined(outline, carrier, phase.drawn)]
        self._carried = CarriedPoints(carrier, phase.drawn, self._points)

    def __call__(self, frame: float, seen: Seen = as_solved) -> RigidMotion:
        """Return the motion of the place that it is joined to."""
        return RigidMotion.between(self._points, self._carried(frame, seen))

    def turned(self, frame: float) -> float:
        """Return the angle of that motion, whole turns included."""
        return _on_branch(self(frame).turn, self._carried.turned(frame))


class MovingJoint:
    """Keeps a span's frames joined to the carrier, and turns them with it.

    The span's own turn is what the carrier's leaves of it. Whole turns besides about the layer's
    own centre leave that where it would be without them.
    """

    def __init__(self, phase: Phase, carrier: Run) -> None:
        first, last = phase.first, phase.last
        self._phase = phase
        morph = self._morph
        joined = _joined(morph.rest, carrier, first), _joined(morph.target, carrier, last)
        self._carried = (
            CarriedPoints(carrier, first, morph.rest[joined[0]]),
            CarriedPoints(carrier, last, morph.target[joined[1]], ends=True),
        )
        self._vertices = np.concatenate(joined)
        self._start, end = self._places(first), self._places(last)
        self._gaps = morph.rest[self._vertices] - self._start, morph.target[self._vertices] - end
        slid = self._gaps[1] - self._gaps[0]
        self._weights = hinge(morph.rest[self._vertices], slid, CLOSE * diagonal(morph.rest))
        self._seen = self._seen_turn(self._carrier_turned(last, end))
        self._spins = self._extra_spins()

    @property
    def _morph(self) -> Morph:
        morph = self._phase.morph
        assert morph is not None
        return morph

    @property
    def angle(self) -> float:
        """How far the layer turns in all, as seen from the carrier."""
        course = self._morph.inbetween.course
        return 0.0 if course is None else course.turning.angle(self._seen)

    def turned(self, frame: float) -> float:
        """Return how far it is turned at a frame, besides what the span itself turns."""
        return self._turned(frame, self._places(frame))

    def __call__(self, frame: float, seen: Seen = as_solved) -> RigidMotion:
        """Return what moves the span's own frame to its place."""
        s, places = self._phase.progress(frame), self._places(frame, seen)
        x, (before, after) = seen(self._morph, s), self._gaps
        goal = complex(*(self._weights @ (places + (1 - s) * before + s * after)))
        joint = complex(*(self._weights @ x[self._vertices]))
        course = self._morph.inbetween.course
        if course is None:
            return RigidMotion(1, goal - joint)
        central = course.turning.about == "centre"
        whole = self.angle - course.turning.swing(self._seen) if central else 0.0
        turn, centre = np.exp(1j * self._turned(frame, places)), complex(*(course.mass @ x))
        arm = turn * np.exp(-1j * s * whole) * (joint - centre)
        return RigidMotion(turn, goal - arm - turn * centre)

    @cached_property
    def rates(self) -> tuple[complex, complex]:
        """The velocity that this adds to the layer's centre at both ends, per frame."""
        first, last = self._phase.first, self._phase.last
        step = NO_TIME * (last - first)
        start, end = self._morph.rest.mean(axis=0), self._morph.target.mean(axis=0)
        return (
            self(first + step).displacement(start) / step,
            -self(last - step).displacement(end) / step,
        )

    def _turned(self, frame: float, places: Array) -> float:
        if self._morph.inbetween.course is None:
            return 0.0
        s = self._phase.progress(frame)
        smoothed = sum(bump * rate for bump, rate in zip(bumps(s), self._spins, strict=True))
        return self._turned_unsmoothed(frame, places) - smoothed

    def _turned_unsmoothed(self, frame: float, places: Array) -> float:
        own = self._phase.progress(frame) * (self.angle - self._morph.angle)
        return self._carrier_turned(frame, places) + own

    def _extra_spins(self) -> tuple[float, float]:
        """Return how fast this turns the span, per unit s, at ends that the motion passes through.

        There it must not: the span's own motion has the velocity that it shares with the next.
        """
        before, after = self._phase.passes
        if self._morph.inbetween.course is None or not (before or after):
            return 0.0, 0.0
        first, last = self._phase.first, self._phase.last
        step = NO_TIME * (last - first)
        start, almost, end = (
            self._turned_unsmoothed(frame, self._places(frame))
            for frame in (first + step, last - step, last)
        )
        return before * start / NO_TIME, after * (end - almost) / NO_TIME

    def _carrier_turned(self, frame: float, places: Array) -> float:
        """Return how far the carrier has turned where it has its part of the joint."""
        turn = RigidMotion.between(self._start, places).turn
        return _on_branch(turn, self._carried[0].turned(frame))

    def _seen_turn(self, carried: float) -> float:
        """Return the span's own turn, in [-π, π), as seen from a carrier that turns so far."""
        course = self._morph.inbetween.course
        return 0.0 if course is None else float(wrap(np.array(course.turn - carried)))

    def _places(self, frame: float, seen: Seen = as_solved) -> Array:
        """Return where the carrier has its part of the joint (k, 2) at a frame."""
        return np.concatenate([points(frame, seen) for points in self._carried])


def _joined(points: Array, carrier: Run, frame: float) -> Indices:
    """Return the indices of points (n, 2) that lie on the carrier, or else are nearest to it."""
    rings = carrier.rings(frame)
    polygon = shapely.Polygon(rings[0], rings[1:])
    shapely.prepare(polygon)
    on: Indices = np.flatnonzero(shapely.intersects_xy(polygon, *points.T))
    if len(on) < LEAST_POINTS:
        distance = distances(points, rings)
        distance[on] = 0
        on = np.argsort(distance, kind="stable")[:LEAST_POINTS]
    return on[:: 1 + len(on) // MOST_POINTS]


def hinge(points: Array, slid: Array, close: float) -> Array:
    """Return weights (k,) of points (k, 2) that slide by so much (k, 2) on the carrier.

    Their mean so weighted is where nothing slides, if that is near: close to the points that slide
    least, sliding is taken to be affine.
    """
    weights = 1 / (1 + (slid**2).sum(axis=1) / close**2) ** 2
    weights /= weights.sum()
    x, mean = points - weights @ points, weights @ slid
    spread = np.linalg.pinv((weights * x.T) @ x)
    change = (weights * (slid - mean).T) @ x @ spread
    way = -np.linalg.solve(change.T @ change + STIFF**2 * np.eye(2), change.T @ mean)
    reach = float(np.sqrt(way @ spread @ way))
    way *= min(1, NEAR / reach) if reach else 1
    return cast(Array, weights * (1 + x @ spread @ way))


def _on_branch(turn: complex, near: float) -> float:
    """Return the angle of a rotation that is nearest to another angle."""
    return near + float(wrap(np.array(np.angle(turn) - near)))
