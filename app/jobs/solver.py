"""Keeps every visible span solved, in the background, the most urgent first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection
from enum import Enum
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from PySide6.QtCore import QObject, QTimer, Signal

from app.document.playhead import Playhead
from app.document.selection import Selection
from app.document.session import Session
from app.jobs.remembered import Remembered
from app.jobs.urgency import Key, most_urgent
from app.jobs.worker import Worker
from core.errors import Cancelled, MorphError
from core.model import Document
from core.morph.scene import Span, solve_span, span_of
from core.progress import Progress

if TYPE_CHECKING:
    from core.morph.morph import Morph

Solve = Callable[[Span, Progress], "Morph"]

REMEMBERED = 64
"""Outcomes kept beyond those of the document as it is, so that undo shows at once."""
QUIET_MS = 100
"""How long after the last edit a job that edit made obsolete may still go on."""


class SpanState(Enum):
    """How the solution of a span stands; whatever is shown in any state but SOLVED is stale."""

    NONE = "none"
    """Nothing to solve, or solving was cancelled."""
    SOLVED = "solved"
    SOLVING = "solving"
    FAILED = "failed"


class _Job(NamedTuple):
    number: int
    key: Key | None
    """Where its result is shown; None once that place is gone or may be another one."""
    span: Span


class Solver(QObject):
    """Solves the spans of the visible layers as the document changes.

    One job runs at a time, on a value-type snapshot of one span. While edits keep coming, as in a
    drag, a job goes on though it is obsolete, and its result is shown as a stale preview, so that
    something moves; once the artist pauses, an obsolete job is cancelled in favour of the newest.
    """

    updated = Signal()
    """A solution or a state changed: repaint."""
    progress = Signal(float, str)
    busy_changed = Signal(bool)
    failed = Signal(object)
    """The MorphError of a span that could not be solved; it is also in ``errors``."""

    def __init__(
        self,
        session: Session,
        selection: Selection,
        playhead: Playhead,
        solve: Solve = solve_span,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._selection, self._playhead = session, selection, playhead
        self._solve = solve
        self.errors: dict[Key, MorphError] = {}
        """What went wrong, by span; kept until that span is solved."""
        self._spans: dict[Key, Span] = {}
        self._keys: dict[Span, Key] = {}
        self._outcomes: Remembered[Span, Morph | MorphError] = Remembered(REMEMBERED)
        self._last_good: dict[Key, Morph] = {}
        self._states: dict[Key, SpanState] = {}
        self._job: _Job | None = None
        self._busy = False
        self._held = False
        self._quiet = QTimer(self, singleShot=True, interval=QUIET_MS)
        self._quiet.timeout.connect(self._cancel_obsolete)
        self._worker = Worker("solver", self)
        self._worker.done.connect(self._on_done)
        self._worker.progressed.connect(self.progress)
        session.changed.connect(self._on_changed)
        session.replaced.connect(self._forget)
        self._on_changed(session.document)

    # -- what is known -------------------------------------------------------------------------

    @property
    def busy(self) -> bool:
        """Whether something is being solved."""
        return self._busy

    def morph_of(self, span: Span) -> Morph | None:
        """Return the solution of a span, or else the last good one in its place, which is stale."""
        outcome = self._outcomes.get(span)
        if outcome is not None and not isinstance(outcome, MorphError):
            return outcome
        key = self._keys.get(span)
        return None if key is None else self._last_good.get(key)

    def solutions(self) -> dict[Span, Morph]:
        """Return every exact solution that is known."""
        return {
            span: outcome
            for span, outcome in self._outcomes.items()
            if not isinstance(outcome, MorphError)
        }

    def state(self, layer_id: int, index: int) -> SpanState:
        """Return how the solution of a span stands."""
        return self._states.get((layer_id, index), SpanState.NONE)

    # -- what the artist asks ------------------------------------------------------------------

    def cancel(self) -> None:
        """Stop solving until the next edit or ``resume``; what is shown stays, as stale."""
        self._held = True
        self._worker.cancel()
        self._refresh()

    def resume(self) -> None:
        """Solve what is not solved, after ``cancel``; try again what failed."""
        self._held = False
        for span in self._spans.values():
            if isinstance(self._outcomes.get(span), MorphError):
                self._outcomes.forget(span)
        self._advance()

    def close(self) -> None:
        """Stop solving and end the thread."""
        if self._worker.closed:
            return
        self._session.changed.disconnect(self._on_changed)
        self._session.replaced.disconnect(self._forget)
        self._quiet.stop()
        self._worker.close()

    # -- the flow ------------------------------------------------------------------------------

    def _on_changed(self, document: Document) -> None:
        before = Counter(layer_id for layer_id, _ in self._spans)
        self._spans = {
            (layer.id, index): span_of(layer, index)
            for layer in document.moving
            for index in range(layer.spans)
        }
        self._keys = {span: key for key, span in self._spans.items()}
        after = Counter(layer_id for layer_id, _ in self._spans)
        self._leave_places({layer for layer in before if before[layer] != after[layer]})
        self._held = False
        self._quiet.start()
        self._advance()

    def _leave_places(self, layers: Collection[int]) -> None:
        """Keep nothing by its place in layers whose keys were inserted or removed.

        Every place may be another span's now; or another layer's, which was given the same id.
        """
        for kept in (self.errors, self._last_good):
            for key in [key for key in kept if key[0] in layers]:
                del kept[key]
        if self._job and self._job.key and self._job.key[0] in layers:
            self._job = self._job._replace(key=None)

    def _forget(self) -> None:
        """Start over with another document: nothing of the last one may show in its place."""
        self._leave_places({layer_id for layer_id, _ in self._spans})
        self._cancel_obsolete()
        self._refresh()

    def _advance(self) -> None:
        """Bring the states up to date and start the next job."""
        self._refresh()
        if self._job is None and not self._held and (key := self._most_urgent()) is not None:
            span = self._spans[key]
            self._job = _Job(self._worker.start(partial(self._solve, span)), key, span)
        if self._busy != (self._job is not None):
            self._busy = not self._busy
            self.busy_changed.emit(self._busy)

    def _most_urgent(self) -> Key | None:
        """Return the unsolved span to solve first: of the current layer, under the playhead."""
        unsolved = (key for key, span in self._spans.items() if span not in self._outcomes)
        return most_urgent(unsolved, self._session.document, self._selection, self._playhead)

    def _cancel_obsolete(self) -> None:
        """Cancel the job under way unless it is what should be solved first."""
        key = self._most_urgent()
        if self._job and (key is None or self._spans[key] != self._job.span):
            self._worker.cancel()

    def _on_done(self, number: int, outcome: Morph | MorphError | Cancelled) -> None:
        if self._job is None or number != self._job.number:
            return
        job, self._job = self._job, None
        if not isinstance(outcome, Cancelled):
            self._outcomes.put(job.span, outcome, self._keys)
            self._preview(job.key, outcome)
        self._advance()

    def _preview(self, key: Key | None, outcome: Morph | MorphError) -> None:
        """Show a result in the place it was solved for, though the span has changed since."""
        wanted = self._spans.get(key) if key else None
        if wanted and wanted not in self._outcomes and not isinstance(outcome, MorphError):
            self._last_good[key] = outcome
            self.updated.emit()

    def _refresh(self) -> None:
        """Derive states, errors and last good solutions from the outcomes that are known."""
        states, fresh = {}, []
        for key, span in self._spans.items():
            outcome = self._outcomes.use(span)
            if outcome is None:
                states[key] = SpanState.NONE if self._held else SpanState.SOLVING
            elif isinstance(outcome, MorphError):
                states[key] = SpanState.FAILED
                if self.errors.get(key) is not outcome:
                    self.errors[key] = outcome
                    fresh.append(outcome)
            else:
                states[key] = SpanState.SOLVED
                self._last_good[key] = outcome
                self.errors.pop(key, None)
        if states != self._states:
            self._states = states
            self.updated.emit()
        for error in fresh:
            self.failed.emit(error)
