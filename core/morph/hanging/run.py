"""A layer through all time, as it is shown: carried along by what it hangs on."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from functools import cached_property, lru_cache
from weakref import ReferenceType

from core.geometry.flatten import flatten
from core.model import Easing, Outline
from core.model.easing import HOLD
from core.model.outline import Array
from core.morph.hanging.joint import Joint, MovingJoint, StillJoint
from core.morph.hanging.rigid import STILL, RigidMotion
from core.morph.hanging.seen import Seen, as_solved
from core.morph.morph import Morph
from core.morph.motion.passing import bumps

KEPT = 128
"""How many joints are remembered; they keep no solution alive."""


@dataclass(frozen=True)
class Phase:
    """A key that stands still, or a span; solutions are compared by identity."""

    first: float
    last: float
    outline: Outline
    """The key's; the first one's of a span."""
    drawn: float
    """The key's frame."""
    easing: Easing = HOLD
    solution: ReferenceType[Morph] | None = None
    """None where nothing moves, or while nothing is solved."""
    passes: tuple[bool, bool] = (False, False)
    """Whether the motion passes through its ends, and is not stopped there by a carrier's."""

    @property
    def morph(self) -> Morph | None:
        """The solution; whoever uses the phase keeps it alive."""
        return None if self.solution is None else self.solution()

    def progress(self, frame: float) -> float:
        """Return s at a frame, taken to lie in the phase."""
        if self.solution is None:
            return 0.0
        return self.easing((frame - self.first) / (self.last - self.first))

    def as_drawn(self, frame: float) -> bool:
        """Return whether a frame shows a key where it was drawn."""
        return frame == self.drawn or (
            self.solution is not None and frame in (self.first, self.last)
        )


@dataclass(frozen=True)
class Run:
    """Phases of a layer that follow each other without a gap; compared by value."""

    phases: tuple[Phase, ...]
    carrier: Run | None = None

    def smooth(self, frame: float) -> bool:
        """Return whether the motion neither starts nor ends anew at a frame."""
        carried = self.carrier is None or self.carrier.smooth(frame)
        return carried and all(p.passes[0] for p in self.phases if p.first == frame)

    def index(self, frame: float) -> int:
        """Return the phase that a frame is in; a key begins one."""
        return bisect_right(self._firsts, frame) - 1

    def index_before(self, frame: float) -> int:
        """Return the phase that a frame is in; a key ends one."""
        return bisect_left(self._firsts, frame) - 1

    def joint(self, index: int) -> Joint | None:
        """Return how a phase is joined to the carrier, if there is one."""
        if index not in self._joints:
            phase = self.phases[index]
            unsolved = phase.solution is None and not phase.easing.hold
            joint = None if self.carrier is None or unsolved else _joint(phase, self.carrier)
            self._joints[index] = joint
        return self._joints[index]

    def turn(self, span: int) -> float | None:
        """Return how far a span turns, as seen from the carrier."""
        joint = self.joint(span + 1)
        return joint.angle if isinstance(joint, MovingJoint) else None

    def motion(self, index: int, frame: float, seen: Seen = as_solved) -> RigidMotion:
        """Return how the carrier moves what is in a phase at a frame."""
        drawn = self.carrier is None or self.phases[index].as_drawn(frame)
        joint = None if drawn else self.joint(index)
        if joint is None:
            return STILL
        motion = joint(frame, seen)
        return RigidMotion(motion.turn, motion.shift + self._smoothing(index, frame))

    def _smoothing(self, index: int, frame: float) -> complex:
        """Return what moves a span besides, so that joints on both sides of a key that the motion
        passes through have one velocity there: that between theirs.
        """
        phase, shift = self.phases[index], 0j
        for end, bump in enumerate(bumps(phase.progress(frame))):
            if phase.passes[end]:
                joint, other = self.joint(index), self.joint(index - 1 + 2 * end)
                if isinstance(joint, MovingJoint) and isinstance(other, MovingJoint):
                    apart = other.rates[1 - end] - joint.rates[end]
                    shift += bump * (phase.last - phase.first) * apart / 2
        return shift

    def turned(self, index: int, frame: float) -> float:
        """Return the angle of that motion, whole turns included."""
        joint = self.joint(index)
        return 0.0 if joint is None else joint.turned(frame)

    def rings(self, frame: float) -> tuple[Array, ...]:
        """Return what is shown at a frame, as closed polylines (k, 2), exterior first."""
        index = self.index(frame)
        phase = self.phases[index]
        if phase.morph is None:
            rings = tuple(line.points for line in flatten(phase.outline))
        else:
            points = phase.morph.at(phase.progress(frame))
            rings = tuple(points[ring] for ring in phase.morph.rings)
        return tuple(map(self.motion(index, frame), rings))

    @cached_property
    def _joints(self) -> dict[int, Joint | None]:
        """Those that were looked up: comparing all that they depend on takes a while."""
        return {}

    @cached_property
    def _firsts(self) -> list[float]:
        return [phase.first for phase in self.phases]


@lru_cache(KEPT)
def _joint(phase: Phase, carrier: Run) -> Joint:
    if phase.solution is None:
        return StillJoint(phase, carrier)
    return MovingJoint(phase, carrier)
