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
from core.progress import Progress, part, silent

KEPT = 64
"""How many maps are remembered."""

_known: OrderedDict[Span, Morph] = OrderedDict()
_lock = Lock()


def solve(span: Span, progress: Progress = silent) -> Morph:
    """Solve a span; see ``solve_outlines`` for errors and progress."""
    before, after = span.before, span.after
    parts = 1 + (before is not None) + (after is not None)
    morph = solve_by_itself(span, part(progress, 0, parts))
    start = end = None
    if before is not None:
        start = _shared_start(before, morph, part(progress, 1, parts))
    if after is not None:
        end = _shared_end(morph, after, part(progress, parts - 1, parts))
    if start is None and end is None:
        return morph
    return morph.passing(start, end, lambda stage: progress(1.0, stage))


def solve_by_itself(span: Span, progress: Progress = silent) -> Morph:
    """Solve a span as if it had no neighbours."""
    return _solve_map(span.map, progress).along(span.turning)


def _shared_start(before: Passage, morph: Morph, progress: Progress) -> Array | None:
    """Return the velocities (n, 2) that a span has to start with; None if none can be shared."""
    earlier = _neighbour(before, morph, progress)
    if earlier is None:
        return None
    return shared_velocity(earlier, morph, (before.duration, 1.0))[1]


def _shared_end(morph: Morph, after: Passage, progress: Progress) -> Array | None:
    later = _neighbour(after, morph, progress)
    return None if later is None else shared_velocity(morph, later, (1.0, after.duration))[0]


def _neighbour(passage: Passage, morph: Morph, progress: Progress) -> Morph | None:
    """Return the solution beyond a key; None where there is none that motion could pass to."""
    if not morph.inbetween.can_pass:
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
