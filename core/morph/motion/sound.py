"""Fitted frames, held where a triangle nears a fold or the boundary nears itself.

A motion is surveyed beforehand: frames at some moments, its anchors, are settled, and what they
depart from their fits is carried smoothly from one to the next. So a frame depends on the motion
and the moment alone, whatever was asked for before.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from operator import attrgetter

import numpy as np

from core.geometry.rotation import Complex, phasor, to_complex, to_points
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.motion.contact import Contact, NoContact, aligned
from core.morph.motion.departures import Departures
from core.morph.motion.fit import GradientFit
from core.morph.motion.gradients import determinant
from core.morph.motion.guard import FoldGuard
from core.morph.motion.hold import Hold, Wanted
from core.morph.motion.series import Series
from core.progress import Watch, unwatched

SURVEY = 16
"""Intervals between the moments at which a motion is surveyed."""
SHORTEST_STEP = 1 / 32
"""Of the walk from one moment to the next, which is made in parts where the way is far."""
LEVELS = 2
"""How often an interval is halved where what is carried between its anchors does not do."""
MEETING = 0.01
"""How close two walks are halfway that are one motion, at unit area. Others differ by far more."""
WATCHED = 0.6
"""Between moments with a margin above this, frames are not checked for folds."""

Ideal = Callable[[float], Complex]
"""Ideal gradients at t, as turns and mirrors (2, m)."""


@dataclass(frozen=True, eq=False)
class Anchor:
    """A sound frame found beforehand."""

    t: float
    wanted: Wanted
    """The plain fit."""
    turned: Complex
    """(n,) how far the shape has turned around each vertex."""
    frame: Complex
    """(n,)"""
    margin: float
    """The smallest ratio of a triangle's area in the frame to the ideal one."""
    held: bool = False
    """Whether the frame is not the plain fit."""

    @property
    def departure(self) -> Complex:
        """(n,) what the frame departs from its fit, seen from the turning shape."""
        return np.conj(self.turned) * (self.frame - self.wanted.fitted)

    @property
    def strain(self) -> float:
        """How far the frame departs from its fit in all."""
        return float(np.linalg.norm(self.departure))


Ends = tuple[Anchor, Anchor]


@dataclass(frozen=True, eq=False)
class Interval:
    """A while in which frames may need to be held."""

    anchors: tuple[Anchor, ...]
    """At its ends; one alone for all time beyond it."""
    hold: Hold
    """It leaves the anchors as they are."""
    pairs: Indices | None
    """Those that may come near each other, if that is known."""


class SoundFrames:
    """Frames of a motion that do not fold, nor cross unless limbs pass, wherever they lie."""

    def __init__(
        self,
        ideal: Ideal,
        turning: Array,
        fit: GradientFit,
        guard: FoldGuard,
        contact: Contact,
        watch: Watch,
    ) -> None:
        """Walk through the motion once. Both its ends must be sound.

        ``turning`` (n,) is how far the shape turns around each vertex.
        """
        self._ideal, self._turning = ideal, turning
        self._fitted = Series(lambda t: fit(ideal(t)))
        self._hold = Hold(fit, guard, contact)
        self._known: dict[Ends, Interval | None] = {}
        anchors, met = self._survey(watch)
        self.limbs_pass = not met
        """Whether limbs pass one another, as no way round was found: the boundary crosses then.

        Then no part of the boundary is kept from any other, from end to end of the motion.
        """
        if self.limbs_pass:
            self._hold = Hold(fit, guard, NoContact())
            self._known.clear()
            anchors, _ = self._survey(watch)
        self._lay(anchors)
        for _ in range(LEVELS):
            if not (more := self._missing(anchors, watch)):
                break
            anchors = sorted([*anchors, *more], key=attrgetter("t"))
            self._lay(anchors)
        self._known.clear()

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        x, trouble = self._carried(t)
        if trouble is None:
            return x
        return to_points(self._settled(t, *trouble))

    def plain(self, t: float) -> Array | None:
        """Return positions (n, 2) at t if they need not be settled, which costs little."""
        x, trouble = self._carried(t)
        return x if trouble is None else None

    def _carried(self, t: float) -> tuple[Array, tuple[Wanted, Interval] | None]:
        """Return the fit (n, 2) at t, departed from as at the anchors nearby.

        With it comes what it takes to settle it, if it must be settled.
        """
        x = self._fitted(t)
        if self._departures is not None and 0 < t < 1:
            x += to_points(self._departures(t))
        interval = self._intervals[bisect_left(self._times, t)]
        if interval is None:
            return x, None
        wanted = Wanted(to_complex(x), determinant(self._ideal(t)))
        return x, None if interval.hold.free(wanted, interval.pairs) else (wanted, interval)

    def _settled(
        self, t: float, wanted: Wanted, interval: Interval, watch: Watch = unwatched
    ) -> Complex:
        start = wanted.fitted
        if not interval.hold.sound(start, wanted):
            nearest = min(interval.anchors, key=lambda anchor: (abs(anchor.t - t), anchor.strain))
            start = aligned(nearest.frame, start)
        return interval.hold(wanted, start, interval.pairs, watch)

    # -- the survey ----------------------------------------------------------------------------

    def _survey(self, watch: Watch) -> tuple[list[Anchor], bool]:
        """Return anchors, and whether the walks from both ends meet in the middle.

        So the swapped motion goes the same way back. Where the walks do not meet, no way
        round was found for limbs that hold each other off: contact would let them pass in a jump.
        """
        plain = [self._plain_anchor(float(t)) for t in np.linspace(0, 1, SURVEY + 1)]
        self._learn(plain)
        half = SURVEY // 2
        ways = plain[: half + 1], plain[: half - 1 : -1]
        first, last = (self._walk(way, watch) for way in ways)
        halfway = first.pop(), last.pop()
        apart = np.abs(halfway[1].frame - halfway[0].frame).max()
        middle = min(halfway, key=lambda anchor: anchor.strain)
        return [*first, middle, *reversed(last)], bool(apart < MEETING)

    def _walk(self, plain: Sequence[Anchor], watch: Watch) -> list[Anchor]:
        """Return anchors, each settled from those before where it must be held."""
        anchors, clear = [plain[0]], True
        for last, anchor in pairwise(plain):
            watch("in-between")
            interval = self._interval((last, anchor) if last.t < anchor.t else (anchor, last))
            pairs = interval.pairs if clear and interval is not None else None
            clear = (clear and interval is None) or self._hold.free(anchor.wanted, pairs)
            anchors.append(anchor if clear else self._walked(anchors[-2:], anchor, watch))
        return anchors

    def _plain_anchor(self, t: float) -> Anchor:
        wanted = Wanted(to_complex(self._fitted(t)), determinant(self._ideal(t)))
        turned, frame = phasor(t * self._turning), wanted.fitted
        return Anchor(t, wanted, turned, frame, self._hold.margin(frame, wanted))

    def _held_anchor(self, plain: Anchor, frame: Complex) -> Anchor:
        return replace(plain, frame=frame, margin=self._hold.margin(frame, plain.wanted), held=True)

    def _walked(self, last: Sequence[Anchor], plain: Anchor, watch: Watch) -> Anchor:
        """Return an anchor, settled from earlier ones."""
        wanted, latest = plain.wanted, last[-1]
        start = wanted.fitted + plain.turned * _carried_on(last, plain.t)
        if not self._hold.sound(start, wanted):
            if abs(plain.t - latest.t) > SHORTEST_STEP:
                halfway = self._plain_anchor((latest.t + plain.t) / 2)
                walked = self._walked(last, halfway, watch)
                return self._walked([latest, walked], plain, watch)
            start = aligned(latest.frame, wanted.fitted)
        return self._held_anchor(plain, self._hold(wanted, start, watch=watch))

    def _lay(self, anchors: Sequence[Anchor]) -> None:
        """Carry departures from anchor to anchor."""
        self._times = [anchor.t for anchor in anchors]
        self._departures: Departures | None = None
        if any(anchor.held for anchor in anchors):
            self._departures = Departures(
                self._turning, self._times, np.array([anchor.departure for anchor in anchors])
            )
        beyond = (Interval((end,), self._hold, None) for end in (anchors[0], anchors[-1]))
        self._intervals = [next(beyond), *map(self._interval, pairwise(anchors)), next(beyond)]

    def _interval(self, ends: Ends) -> Interval | None:
        """Return the interval between anchors, or None where no frame can need to be settled."""
        if ends not in self._known:
            self._learn(ends)
        return self._known[ends]

    def _learn(self, anchors: Sequence[Anchor]) -> None:
        """Find all intervals between anchors that follow each other."""
        meetings = self._hold.meetings([anchor.frame for anchor in anchors])
        for ends, pairs in zip(pairwise(anchors), meetings, strict=True):
            quiet = not len(pairs) and min(end.margin for end in ends) > WATCHED
            frames = [(end.frame, end.wanted) for end in ends]
            self._known[ends] = None if quiet else Interval(ends, self._hold.leaving(frames), pairs)

    def _missing(self, anchors: Sequence[Anchor], watch: Watch) -> list[Anchor]:
        """Return anchors in the middle of intervals where what is carried must be settled."""
        found = []
        for ends in filter(self._interval, pairwise(anchors)):
            t = (ends[0].t + ends[1].t) / 2
            _, trouble = self._carried(t)
            if trouble is not None:
                watch("in-between")
                frame = self._settled(t, *trouble, watch)
                found.append(self._held_anchor(self._plain_anchor(t), frame))
        return found


def _carried_on(last: Sequence[Anchor], t: float) -> Complex:
    """Return what departures lead to at t if they go on as they did."""
    *earlier, latest = last
    departure = latest.departure
    for one in earlier:
        departure += (t - latest.t) / (latest.t - one.t) * (latest.departure - one.departure)
    return departure
