"""Keeps every solved span checked, in the background, so that its verdict is always right."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from app.document.playhead import Playhead
from app.document.selection import Selection
from app.document.session import Session
from app.jobs.remembered import Remembered
from app.jobs.solver import Solver, SpanState
from app.jobs.urgency import Key, most_urgent
from app.jobs.worker import Worker
from core.errors import Cancelled, MorphError
from core.model import Document
from core.morph.scene import TimedSpan, timed_span_of
from core.progress import Progress

if TYPE_CHECKING:
    from core.morph.morph import Morph
    from core.morph.soundness import FrameCheck, SpanCheck

Check = Callable[[TimedSpan, "Morph", float, Progress], "SpanCheck"]
"""Looks at the frames of a span, those near a frame first."""

REMEMBERED = 64
"""Checks kept beyond those of the document as it is, so that undo shows at once."""


class Standing(Enum):
    """What is known of a span as it is now."""

    NONE = "none"
    """Nothing: it is not being solved, or could not be checked."""
    STALE = "stale"
    """Solving was cancelled; what is on screen is from before the last change."""
    SOLVING = "solving"
    FAILED = "failed"
    """It could not be solved."""
    CHECKING = "checking"
    """Solved; its frames are being looked at."""
    SOUND = "sound"
    UNSOUND = "unsound"
    """Some of its frames fold or cross, or its ends are not as drawn."""


def check_outwards(span: TimedSpan, morph: Morph, frame: float, progress: Progress) -> SpanCheck:
    """Look at every frame of a span, those near a frame first."""
    from core.morph.soundness import check_span  # what it loads a solve has loaded before

    frames = sorted(span.frames(), key=lambda entry: abs(entry[0] - frame))
    return check_span(span.span, morph, frames, progress)


class Inspector(QObject):
    """Checks what the solver has solved, while the solver rests.

    A verdict belongs to a span by value, its timing included: whatever changes the span takes the
    verdict away at once.
    """

    changed = Signal()
    """A standing changed: repaint."""

    def __init__(
        self,
        session: Session,
        selection: Selection,
        playhead: Playhead,
        solver: Solver,
        check: Check = check_outwards,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._selection, self._playhead = session, selection, playhead
        self._solver, self._check = solver, check
        self._document: Document | None = None
        self._spans: dict[Key, TimedSpan] = {}
        """Those of that document."""
        self._standings: dict[Key, Standing] = {}
        self._outcomes: Remembered[TimedSpan, SpanCheck | MorphError] = Remembered(REMEMBERED)
        self._job: TimedSpan | None = None
        self._worker = Worker("inspector", self)
        self._worker.done.connect(self._on_done)
        for signal in (session.changed, solver.updated, solver.busy_changed):
            signal.connect(self._advance)
        self._advance()

    @property
    def busy(self) -> bool:
        """Whether frames are being looked at."""
        return self._job is not None

    def standing(self, layer_id: int, index: int) -> Standing:
        """Return what is known of a span."""
        return self._standings.get((layer_id, index), Standing.NONE)

    def check(self, layer_id: int, index: int) -> SpanCheck | None:
        """Return what was seen in the frames of a span as it is now; None while not all were."""
        if self.standing(layer_id, index) not in (Standing.SOUND, Standing.UNSOUND):
            return None
        return self._outcomes.get(self._spans[layer_id, index])

    def frame_check(self, layer_id: int, frame: float) -> FrameCheck | None:
        """Return what was seen in a frame of a layer; between frames, in the worse neighbour."""
        index, _ = self._session.document.layer(layer_id).span_at(frame)
        check = self.check(layer_id, index)
        if check is None:
            return None
        frame = min(max(frame, check.frames[0].frame), check.frames[-1].frame)
        beside = (seen for seen in check.frames if abs(seen.frame - frame) < 1)
        return max(beside, key=lambda seen: seen.folds + seen.crossings)

    def error(self, layer_id: int, index: int) -> MorphError | None:
        """Return why a span could not be solved or checked."""
        key = layer_id, index
        if self.standing(*key) is Standing.FAILED:
            return self._solver.errors.get(key)
        outcome = self._outcomes.get(self._spans[key]) if key in self._spans else None
        return outcome if isinstance(outcome, MorphError) else None

    def close(self) -> None:
        """Stop checking and end the thread."""
        if self._worker.closed:
            return
        for signal in (self._session.changed, self._solver.updated, self._solver.busy_changed):
            signal.disconnect(self._advance)
        self._worker.close()

    # -- the flow ------------------------------------------------------------------------------

    def _advance(self) -> None:
        """Bring the standings up to date, end a check that nobody wants, and begin the next."""
        self._look_at_document()
        standings = {key: self._standing(key, span) for key, span in self._spans.items()}
        waiting = [key for key, found in standings.items() if found is Standing.CHECKING]
        if self._job is not None:
            if self._solver.busy or all(self._spans[key] != self._job for key in waiting):
                self._worker.cancel()
        elif not self._solver.busy:
            self._begin(waiting)
        if standings != self._standings:
            self._standings = standings
            self.changed.emit()

    def _look_at_document(self) -> None:
        if self._document is not self._session.document:
            self._document = self._session.document
            self._spans = {
                (layer.id, index): timed_span_of(layer, index)
                for layer in self._document.layers
                for index in range(layer.spans)
            }

    def _begin(self, waiting: list[Key]) -> None:
        key = most_urgent(waiting, self._session.document, self._selection, self._playhead)
        if key is None:
            return
        self._job = self._spans[key]
        morph = self._solver.morph_of(self._job.span)
        self._worker.start(partial(self._check, self._job, morph, self._playhead.frame))

    def _on_done(self, _number: int, outcome: SpanCheck | MorphError | Cancelled) -> None:
        assert self._job is not None
        job, self._job = self._job, None
        if not isinstance(outcome, Cancelled):
            self._outcomes.put(job, outcome, frozenset(self._spans.values()))
        self._advance()

    def _standing(self, key: Key, span: TimedSpan) -> Standing:
        match self._solver.state(*key):
            case SpanState.SOLVED:
                outcome = self._outcomes.use(span)
                if outcome is None:
                    return Standing.CHECKING
                if isinstance(outcome, MorphError):
                    return Standing.NONE
                return Standing.SOUND if outcome.sound else Standing.UNSOUND
            case SpanState.SOLVING:
                return Standing.SOLVING
            case SpanState.FAILED:
                return Standing.FAILED
            case SpanState.NONE:
                known = self._solver.morph_of(span.span) is not None
                return Standing.STALE if known else Standing.NONE
