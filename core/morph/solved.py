"""Spans solved: the map of each by itself, remembered for a while, and then how it moves."""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock

from core.errors import MorphError
from core.model.outline import Array
from core.morph.morph import Morph
from core.morph.passage import shared_velocity
from core.morph.pipeline import solve_outlines
from core.morph.scene import Passage, Span
from core.progress import Progress, silent

KEPT = 64
"""How many maps are remembered."""

_known: OrderedDict[Span, Morph] = OrderedDict()
_lock = Lock()


def solve(span: Span, progress: Progress = silent) -> Morph:
    """Solve a span; see ``solve_outlines`` for errors and progress."""
    morph = solve_by_itself(span, progress)
    start, end = _shared_start(span, morph, progress), _shared_end(span, morph, progress)
    if start is None and end is None:
        return morph
    return morph.passing(start, end, lambda stage: progress(1.0, stage))


def solve_by_itself(span: Span, progress: Progress = silent) -> Morph:
    """Solve a span as if it had no neighbours."""
    return _solve_map(span.map, progress).along(span.turning)


def _shared_start(span: Span, morph: Morph, progress: Progress) -> Array | None:
    """Return the velocities (n, 2) that a span has to start with, if it passes through there."""
    earlier = _neighbour(span.before, morph, progress)
    if span.before is None or earlier is None:
        return None
    return shared_velocity(earlier, morph, (span.before.duration, 1.0))[1]


def _shared_end(span: Span, morph: Morph, progress: Progress) -> Array | None:
    later = _neighbour(span.after, morph, progress)
    if span.after is None or later is None:
        return None
    return shared_velocity(morph, later, (1.0, span.after.duration))[0]


def _neighbour(passage: Passage | None, morph: Morph, progress: Progress) -> Morph | None:
    """Return the solution beyond a key; None where there is none that motion could pass to."""
    if passage is None or not morph.inbetween.can_pass:
        return None
    try:
        other = solve_by_itself(passage.beyond, progress)
    except MorphError:  # reported where that span itself is solved
        return None
    return other if other.inbetween.can_pass else None


def _solve_map(span: Span, progress: Progress) -> Morph:
    with _lock:
        if span in _known:
            _known.move_to_end(span)
            return _known[span]
    morph = solve_outlines(
        span.source,
        span.target,
        span.marks,
        labels=span.labels,
        recipe=span.recipe,
        progress=progress,
    )
    with _lock:
        _known[span] = morph
        if len(_known) > KEPT:
            _known.popitem(last=False)
    return morph
