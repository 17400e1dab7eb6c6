"""Maps that were solved a while ago: however the shape is to move, they need no solving again."""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock

from core.morph.morph import Morph
from core.morph.pipeline import solve_outlines
from core.morph.scene import Span
from core.progress import Progress, silent

KEPT = 64
"""How many are remembered."""

_known: OrderedDict[Span, Morph] = OrderedDict()
_lock = Lock()


def solve_map(span: Span, progress: Progress = silent) -> Morph:
    """Solve a span as if it had no neighbours and turned the shorter way, or remember it."""
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
