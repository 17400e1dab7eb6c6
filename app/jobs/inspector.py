"""Keeps every solved span checked, in the background, so that its verdict is always right."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from enum import Enum
from functools import partial
from math import ceil, floor
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Signal, SignalInstance

from app.document.playhead import Playhead
from app.document.selection import Selection
from app.document.session import Session
from app.jobs.frames import Frames
from app.jobs.joining import Joining, join
from app.jobs.looking import Look, Sight, Task, look, make
from app.jobs.remembered import Remembered
from app.jobs.solver import Solver, SpanState
from app.jobs.urgency import Key, nearness
from app.jobs.worker import Worker
from core.errors import Cancelled, MorphError
from core.model import Document
from core.model.outline import Array
from core.morph.scene import TimedSpan, timed_span_of

if TYPE_CHECKING:
    from app.jobs.frames import Instant
    from core.morph.soundness import FrameCheck, SpanCheck

PORTION = 100
"""Frames that are handed over at one time, to be looked at as far as a piece of work gets."""
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


class _Search:
    """How far the look at a span has come."""

    def __init__(self, span: TimedSpan) -> None:
        self.unseen = np.arange(span.first, span.last + 1)
        """Numbers of frames, in order."""
        self.seen: dict[int, FrameCheck] = {}

    def note(self, checks: Iterable[FrameCheck]) -> None:
        """Take note of frames that were looked at."""
        found = {check.frame: check for check in checks}
        self.seen.update(found)
        self.unseen = np.setdiff1d(self.unseen, list(found), assume_unique=True)

    def next(self, playhead: Playhead, count: int) -> list[int]:
        """Return so many of the frames that were not looked at, those first that are seen soon.

        They lie around the playhead; while it plays, ahead of it and where it starts again.
        """
        here = int(np.searchsorted(self.unseen, playhead.frame))
        around = self.unseen[max(here - count, count) : here + count]
        found = np.concatenate([self.unseen[:count], around]).tolist()
        return sorted(found, key=nearness(playhead))[:count]


class Inspector(QObject):
    """Checks what the solver has solved, while the solver rests.

    The frames that it makes for that are kept, nearest to the playhead first, so that they are
    ready when they are to be shown. One that is missing on screen comes before all others.
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
        frames: Frames,
        look: Look = look,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._selection, self._playhead = session, selection, playhead
        self._solver, self._frames, self._look = solver, frames, look
        self._document: Document | None = None
        self._spans: dict[Key, TimedSpan] = {}
        """Those of that document."""
        self._standings: dict[Key, Standing] = {}
        self._searches: dict[TimedSpan, _Search] = {}
        """Those that have begun and not ended."""
        self._outcomes: Remembered[TimedSpan, SpanCheck | MorphError] = Remembered(REMEMBERED)
        self._joined: Joining | None = None
        """What was joined last to what it hangs on."""
        self._job: Task | Joining | Instant | None = None
        """Frames that are looked at, or one that is missing on screen."""
        self._worker = Worker("inspector", self)
        self._worker.done.connect(self._on_done)
        for signal in self._followed():
            signal.connect(self._advance)
        session.replaced.connect(frames.give_all_up)
        self._advance()

    @property
    def busy(self) -> bool:
        """Whether frames are being made or looked at."""
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
        key = layer_id, self._session.document.layer(layer_id).span_at(frame)[0]
        if (span := self._spans.get(key)) is None:
            return None
        frame = min(max(float(frame), span.first), span.last)
        beside = [self._seen(key, number) for number in {floor(frame), ceil(frame)}]
        known = [seen for seen in beside if seen is not None]
        if len(known) < len(beside):
            return None
        return max(known, key=lambda seen: seen.folds + seen.crossings)

    def _seen(self, key: Key, number: int) -> FrameCheck | None:
        """Return what was seen in a frame of a span, if it was looked at."""
        if self.standing(*key) is Standing.CHECKING:
            return self._search(key).seen.get(number)
        check = self.check(*key)
        return None if check is None else check.frames[number - self._spans[key].first]

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
        for signal in self._followed():
            signal.disconnect(self._advance)
        self._session.replaced.disconnect(self._frames.give_all_up)
        self._worker.close()

    # -- the flow ------------------------------------------------------------------------------

    def _followed(self) -> tuple[SignalInstance, ...]:
        return (
            self._session.changed,
            self._solver.updated,
            self._solver.busy_changed,
            self._frames.missed,
        )

    def _advance(self) -> None:
        """Bring the standings up to date, end a look that nobody wants, and begin the next."""
        self._look_at_document()
        standings = {key: self._standing(key, span) for key, span in self._spans.items()}
        waiting = [key for key, found in standings.items() if found is Standing.CHECKING]
        if self._job is None:
            self._begin(waiting)
        elif not self._wanted(self._job, waiting):
            self._worker.cancel()
        if standings != self._standings:
            self._standings = standings
            self.changed.emit()

    def _wanted(self, job: Task | Joining | Instant, waiting: list[Key]) -> bool:
        if isinstance(job, Task):
            return not self._solver.busy and any(self._spans[key] == job.span for key in waiting)
        if isinstance(job, Joining):
            return self._frames.missing is None and job.same_as(self._hanging())
        return True

    def _look_at_document(self) -> None:
        if self._document is not self._session.document:
            self._document, self._joined = self._session.document, None
            self._spans = {
                (layer.id, index): timed_span_of(layer, index)
                for layer in self._document.layers
                for index in range(layer.spans)
            }
            there = frozenset(self._spans.values())
            self._searches = {s: found for s, found in self._searches.items() if s in there}

    def _begin(self, waiting: list[Key]) -> None:
        """Make the frame that is missing on screen, or else look at more of what is solved."""
        if (missing := self._frames.missing) is not None:
            self._job = missing
            self._worker.start(partial(make, *missing))
        elif self._solver.busy:
            return
        elif (hanging := self._hanging()) is not None and not hanging.same_as(self._joined):
            self._job = hanging
            self._worker.start(partial(join, hanging))
        elif waiting:
            self._job = self._most_urgent(waiting)
            self._worker.start(partial(self._look, self._job))

    def _hanging(self) -> Joining | None:
        """Return what is to be joined, if anything hangs."""
        spans = (span.span for span in self._spans.values())
        solved = self._solver.morph_of
        return Joining.of(self._session.document, spans, solved, self._playhead.frame)

    def _most_urgent(self, waiting: list[Key]) -> Task:
        """Return what to look at next: of the current layer, soon seen."""
        current, soon = self._selection.layer, nearness(self._playhead)

        def urgency(key: Key) -> tuple[bool, float]:
            [first] = self._search(key).next(self._playhead, 1)
            return self._session.document.layer(key[0]) is not current, soon(first)

        span = self._spans[min(waiting, key=urgency)]
        search, morph = self._searches[span], self._solver.morph_of(span.span)
        assert morph is not None, "what is checked is solved"
        unseen = [(k, span.progress(k)) for k in search.next(self._playhead, PORTION)]
        seen = tuple(search.seen.values()) if len(unseen) == len(search.unseen) else None
        kept = self._frames.made(morph)
        made = {s: kept[s] for _, s in unseen if s in kept}
        return Task(span, morph, seen, tuple(unseen), made)

    def _search(self, key: Key) -> _Search:
        span = self._spans[key]
        if span not in self._searches:
            self._searches[span] = _Search(span)
        return self._searches[span]

    def _on_done(
        self, _number: int, outcome: Sight | Mapping[float, Array] | MorphError | Cancelled | None
    ) -> None:
        job, self._job = self._job, None
        if isinstance(job, Task):
            self._note(job, outcome)
        elif isinstance(job, Joining):
            self._joined = None if isinstance(outcome, Cancelled) else job
        elif job is not None:
            if isinstance(outcome, Mapping):
                self._frames.keep(job[0], outcome)
            self._frames.give_up(job)
        self._advance()

    def _note(self, task: Task, sight: Sight | MorphError | Cancelled) -> None:
        outcome = sight
        if isinstance(sight, Sight):
            self._frames.keep(task.morph, sight.frames)
            if (search := self._searches.get(task.span)) is not None:
                search.note(sight.checks)
            outcome = sight.verdict
        if outcome is not None and not isinstance(outcome, Cancelled):
            self._searches.pop(task.span, None)
            self._outcomes.put(task.span, outcome, frozenset(self._spans.values()))

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
