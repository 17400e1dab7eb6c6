"""What is done to frames in the background: they are made, and looked at."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import perf_counter
from typing import TYPE_CHECKING

from core.model.outline import Array
from core.morph.scene import TimedSpan
from core.progress import Progress

if TYPE_CHECKING:
    from core.morph.morph import Morph
    from core.morph.soundness import FrameCheck, SpanCheck

PIECE = 0.012
"""Seconds after which a look ends with what it has, so that what is more urgent need not wait."""


@dataclass(frozen=True, eq=False)
class Task:
    """Frames of a solved span that are still to be looked at."""

    span: TimedSpan
    morph: Morph
    seen: tuple[FrameCheck, ...] | None
    """What was found in all the others; None while more than these are still to be looked at."""
    unseen: tuple[tuple[int, float], ...]
    """Number and s of each, the most urgent first."""
    made: Mapping[float, Array]
    """Positions (n, 2) of frames that need not be made, by s."""


@dataclass(frozen=True, eq=False)
class Sight:
    """What came of a look."""

    frames: Mapping[float, Array]
    """Positions (n, 2) by s."""
    checks: tuple[FrameCheck, ...]
    verdict: SpanCheck | None
    """On the span, if now every frame was seen."""


Look = Callable[[Task, Progress], Sight]


def look(task: Task, progress: Progress) -> Sight:
    """Make and check frames, at least one, until the time of a piece of work is over."""
    # what it loads a solve has loaded before
    from core.morph.soundness import SpanCheck, check_frame

    end = perf_counter() + PIECE
    frames, checks = {}, []
    for number, s in task.unseen:
        progress(len(checks) / len(task.unseen), "checking")
        frames[s] = task.made[s] if s in task.made else task.morph.at(s)
        checks.append(check_frame(number, task.morph, frames[s]))
        if perf_counter() > end:
            break
    verdict = None
    if task.seen is not None and len(checks) == len(task.unseen):
        verdict = SpanCheck.of(task.span.span, task.morph, (*task.seen, *checks))
    return Sight(frames, tuple(checks), verdict)


def make(morph: Morph, s: float, progress: Progress) -> Mapping[float, Array]:
    """Make one frame."""
    return {s: morph.at(s)}
