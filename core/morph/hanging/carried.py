"""Points that a layer carries along, through all its keys."""

from __future__ import annotations

from typing import TYPE_CHECKING

from core.geometry.location import Located
from core.model.outline import Array
from core.morph.hanging.seen import Seen, as_solved

if TYPE_CHECKING:
    from core.morph.hanging.run import Run


class CarriedPoints:
    """Where points go that are fixed to a layer at some frame.

    Every span has a mesh of its own: at a key, they are located anew.
    """

    def __init__(self, run: Run, frame: float, points: Array, *, ends: bool = False) -> None:
        """Fix points (k, 2) at a frame; if that is a key, to what begins or to what ends there."""
        self._run, self._frame = run, frame
        self._start = run.index_before(frame) if ends else run.index(frame)
        self._pins = {self._start: self._pin(self._start, frame, points)}

    def __call__(self, frame: float, seen: Seen = as_solved) -> Array:
        """Return the points (k, 2) at a frame."""
        return self._at(self._reach(frame), frame, seen)

    def _reach(self, frame: float) -> int:
        """Locate the points on every mesh on the way to a frame; return its phase."""
        index = self._run.index(frame)
        if index > self._start:
            index = self._run.index_before(frame)
        step = 1 if index > self._start else -1
        for here in range(self._start, index, step):
            if here + step not in self._pins:
                phase = self._run.phases[here]
                key = phase.last if step > 0 else phase.first
                self._pins[here + step] = self._pin(
                    here + step, key, self._at(here, key, as_solved)
                )
        return index

    def turned(self, frame: float) -> float:
        """Return about how far they have turned at a frame, whole turns included."""
        index, total = self._reach(frame), 0.0
        low, high = sorted((self._start, index))
        for here in range(low, high + 1):
            phase = self._run.phases[here]
            ends = (max(min(f, phase.last), phase.first) for f in (self._frame, frame))
            before, after = (self._angle(here, end) for end in ends)
            total += after - before
        return total

    def _angle(self, index: int, frame: float) -> float:
        """Return how far the points have turned since a phase began."""
        phase, pin = self._run.phases[index], self._pins[index]
        angle = self._run.turned(index, frame)
        if isinstance(pin, Located):
            assert phase.morph is not None
            angles = phase.morph.inbetween.angles
            local = angles[pin.triangle] if len(angles) > 1 else angles
            angle += phase.progress(frame) * float(local.mean())
        return angle

    def _pin(self, index: int, frame: float, points: Array) -> Located | Array:
        """Locate points on a phase's mesh; where it has none, say where they were before it."""
        phase = self._run.phases[index]
        before = self._run.motion(index, frame).back(points)
        if phase.morph is None:
            return before
        vertices = phase.morph.at(phase.progress(frame))
        return Located.on(vertices, phase.morph.triangles, before)

    def _at(self, index: int, frame: float, seen: Seen) -> Array:
        phase, pin = self._run.phases[index], self._pins[index]
        if isinstance(pin, Located):
            assert phase.morph is not None
            points = pin.interpolate(seen(phase.morph, phase.progress(frame)))
        else:
            points = pin
        return self._run.motion(index, frame, seen)(points)
