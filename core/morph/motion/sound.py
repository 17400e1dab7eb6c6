"""Fitted frames, held where a triangle nears a fold or the boundary nears itself.

A motion is surveyed beforehand: held frames at some moments, its anchors, are what others start
from. So a frame depends on the motion and the moment alone, whatever was asked for before.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.geometry.rotation import Complex
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.motion.contact import Contact, rotation_between
from core.morph.motion.fit import GradientFit
from core.morph.motion.guard import FoldGuard
from core.morph.motion.hold import WARY, Grip, Hold, Wanted
from core.progress import Watch

SURVEY = 16
"""Stretches of time between the moments at which a motion is surveyed."""
FINEST = 1 / 64
"""Shortest stretch, where frames depart so far from the fit that anchors must lie closer."""
WATCHED = 0.6
"""Between moments with a margin above this, frames are not checked for folds."""


Ideal = Callable[[float], Complex]
"""Ideal gradients at t, as turns and mirrors (2, m)."""


@dataclass(frozen=True, eq=False)
class Anchor:
    """A sound frame found beforehand."""

    t: float
    wanted: Wanted
    frame: Complex
    """(n,)"""
    grip: Grip | None
    """None where the plain fit is sound."""
    margin: float
    """The plain fit's."""

    def carried(self, fitted: Complex) -> Complex:
        """Return what the frame departs from its fit, turned as another fit (n,) has turned."""
        if self.grip is None:
            return np.zeros_like(fitted)
        turn = rotation_between(self.wanted.fitted, fitted)
        return turn * (self.frame - self.wanted.fitted)

    def moved(self, fitted: Complex) -> Complex:
        """Return the frame, moved rigidly as close as it can be to another fit (n,)."""
        turn = rotation_between(self.wanted.fitted, fitted)
        return fitted.mean() + turn * (self.frame - self.wanted.fitted.mean())


@dataclass(frozen=True, eq=False)
class Stretch:
    """A stretch of time in which frames may need to be held."""

    anchors: tuple[Anchor, ...]
    """At its ends; one alone for all time beyond it."""
    pairs: Indices | None
    """Those that may come near each other, if that is known."""
    grip: Grip | None
    """What is likely to be held."""


class SoundFrames:
    """Frames of a motion that neither fold nor cross, wherever they lie."""

    def __init__(
        self,
        ideal: Ideal,
        fit: GradientFit,
        guard: FoldGuard,
        contact: Contact,
        watch: Watch,
    ) -> None:
        """Walk through the motion once. Both its ends must be sound."""
        self._ideal, self._fit = ideal, fit
        self._contact, self._hold = contact, Hold(fit, guard, contact)
        wanted = self._wanted(0.0)
        anchors = [Anchor(0.0, wanted, wanted.fitted, None, 1.0)]
        for t in np.linspace(0, 1, SURVEY + 1)[1:]:
            watch("in-between")
            self._walk(float(t), anchors)
        self._times = np.array([anchor.t for anchor in anchors])
        self._stretches = [
            Stretch((anchors[0],), None, None),
            *(self._stretch(*ends) for ends in pairwise(anchors)),
            Stretch((anchors[-1],), None, None),
        ]

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        x, trouble = self._fitted(t)
        if trouble is None:
            return x
        z = self._held(t, *trouble)
        return np.column_stack([z.real, z.imag])

    def plain(self, t: float) -> Array | None:
        """Return positions (n, 2) at t if they need not be held, which costs little; else None."""
        x, trouble = self._fitted(t)
        return x if trouble is None else None

    def _fitted(self, t: float) -> tuple[Array, tuple[Wanted, Stretch] | None]:
        """Return the plain fit (n, 2) at t, and what it takes to hold it, if it must be held."""
        ideal = self._ideal(t)
        x = self._fit(ideal)
        stretch = self._stretches[np.searchsorted(self._times, t)]
        if stretch is None:
            return x, None
        wanted = self._hold.wanted(ideal, x)
        return x, None if self._free(wanted, stretch.pairs) else (wanted, stretch)

    def _held(self, t: float, wanted: Wanted, stretch: Stretch) -> Complex:
        start = self._start(t, wanted, stretch.anchors)
        tight = self._hold.tight(start, wanted, WARY, stretch.pairs)
        grip = stretch.grip
        if grip is None or tight - grip.tight:
            grip = self._hold.grip(tight)
        return self._hold(wanted, start, grip, stretch.pairs)[0]

    def _start(self, t: float, wanted: Wanted, anchors: tuple[Anchor, ...]) -> Complex:
        """Return a sound frame: the fit and what nearby frames depart from theirs, if it is one."""
        start, nearest = wanted.fitted, anchors[0]
        if len(anchors) == 2:
            before, after = anchors
            share = (t - before.t) / (after.t - before.t)
            nearest = after if share > 0.5 else before
            start = start + (1 - share) * before.carried(start) + share * after.carried(start)
        return start if self._hold.sound(start, wanted) else nearest.moved(wanted.fitted)

    def _wanted(self, t: float) -> Wanted:
        ideal = self._ideal(t)
        return self._hold.wanted(ideal, self._fit(ideal))

    def _free(self, wanted: Wanted, pairs: Indices | None = None) -> bool:
        """Whether the plain fit is sound, and nothing of what holds frames is felt."""
        tight = self._hold.tight(wanted.fitted, wanted, among=pairs)
        return not tight and not self._contact.crosses(wanted.fitted)

    def _walk(self, t: float, anchors: list[Anchor]) -> None:
        """Add an anchor at t, and others before it where the way there is far."""
        wanted, last = self._wanted(t), anchors[-1]
        margin = self._hold.margin(wanted.fitted, wanted)
        if self._free(wanted):
            anchors.append(Anchor(t, wanted, wanted.fitted, None, margin))
            return
        start = wanted.fitted + last.carried(wanted.fitted)
        if not self._hold.sound(start, wanted):
            if t - last.t > FINEST:
                self._walk((last.t + t) / 2, anchors)
                self._walk(t, anchors)
                return
            start = last.moved(wanted.fitted)
        grip = self._hold.grip(self._hold.tight(start, wanted, WARY))
        anchors.append(Anchor(t, wanted, *self._hold(wanted, start, grip), margin))

    def _stretch(self, before: Anchor, after: Anchor) -> Stretch | None:
        """Return the stretch between two anchors, or None where no frame can need to be held."""
        ends = before, after
        pairs = self._contact.meeting(before.wanted.fitted, after.wanted.fitted)
        held = [end.grip.tight for end in ends if end.grip is not None]
        if not held:
            quiet = not len(pairs) and min(before.margin, after.margin) > WATCHED
            return None if quiet else Stretch(ends, pairs, None)
        pairs = np.union1d(pairs, self._contact.meeting(before.frame, after.frame))
        tight = [self._hold.tight(end.frame, end.wanted, WARY) for end in ends]
        return Stretch(ends, pairs, self._hold.grip(tight[0] | tight[1]))
