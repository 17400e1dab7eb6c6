"""Suggests marks for the span in view, and finds the mates of those that are placed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from PySide6.QtCore import QObject, QTimer, Signal, SignalInstance

from app.document.playhead import Playhead
from app.document.selection import Selection
from app.document.session import Session
from app.jobs.solver import Solver, SpanState
from app.jobs.worker import Worker
from app.workspace import ViewOptions
from core.errors import Cancelled, MarkError, MorphError
from core.model import Document, Keyframe, Layer, RingPoint, edits
from core.morph.layer_match import LayerMatch, Proposed, Suggestion, match_layer
from core.morph.scene import span_of
from core.progress import Progress

Known = Mapping[int, RingPoint]
"""Where a mark is, on some adjacent keyframes."""


@dataclass(frozen=True)
class _Question:
    """All that suggestions depend on."""

    layer_id: int
    keyframes: tuple[Keyframe, ...]
    span: int
    proposed: Proposed | None
    """What the span was solved with where it has no marks; None while that is not known."""

    @property
    def open(self) -> bool:
        """Whether the solver may still bring marks of its own, which then are the ones to show."""
        return self.proposed is None

    def alike(self, other: _Question | None) -> bool:
        """Whether the mates are those of another question."""
        mine = self.layer_id, self.keyframes
        return other is not None and mine == (other.layer_id, other.keyframes)


@dataclass(frozen=True, eq=False)
class _Answer:
    question: _Question
    match: LayerMatch | None = None
    """None if the outlines could not be matched."""
    suggestions: tuple[Suggestion, ...] = ()


class Suggestions(QObject):
    """Matches the current layer in the background while its marks are worked on.

    Nothing of it is in the document. During a drag, and until the answer to the last edit is there,
    what was suggested before is still shown, but is not current: it cannot be accepted.
    """

    changed = Signal()
    """What is suggested changed, or whether it is current."""
    placed = Signal(str)
    """A mark was placed; its letter."""

    def __init__(
        self,
        session: Session,
        selection: Selection,
        playhead: Playhead,
        solver: Solver,
        view: ViewOptions,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._selection, self._playhead = session, selection, playhead
        self._solver, self._view = solver, view
        self.placing = False
        """Whether the tool that places marks is in hand."""
        self._seen: object = None
        """What was announced last."""
        self._asked: _Question | None = None
        """What the worker is at."""
        self._answer: _Answer | None = None
        self._waiting: list[Known] = []
        """Marks that were clicked and wait for their mates, …"""
        self._waiting_on: _Question | None = None
        """… and what was in view then."""
        self._worker = Worker("suggestions", self)
        self._worker.done.connect(self._on_done)
        for signal in self._followed():
            signal.connect(self._follow_soon)
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._follow)

    # -- what is known -------------------------------------------------------------------------

    @property
    def visible(self) -> bool:
        """Whether suggestions are to be seen."""
        when = {"always": True, "with the tool": self.placing, "never": False}
        return self._view.marks and when[self._view.suggestions]

    @property
    def current(self) -> bool:
        """Whether what is shown holds for the document as it is now."""
        return self._answer is not None and self._answer.question == self._question()

    @property
    def shown(self) -> tuple[Suggestion, ...]:
        """The marks suggested for the span in view; while not current, those that still fit in."""
        now, before = self._question(), self._answer and self._answer.question
        if not self.visible or now is None or before is None or self._contradicted(now):
            return ()
        if now == before:
            return self._answer.suggestions
        if (now.layer_id, now.span) != (before.layer_id, before.span):
            return ()
        return tuple(s for s in self._answer.suggestions if _fits(s, now.keyframes))

    @property
    def used(self) -> bool:
        """Whether the span is solved with what is shown, having no marks that count instead."""
        question = self._question()
        return bool(question and question.proposed and not question.keyframes[0].marks)

    @property
    def span(self) -> int:
        """Index of the span that the suggestions are for."""
        question = self._question()
        return 0 if question is None else question.span

    def mates(self, known: Known) -> tuple[RingPoint, ...] | None:
        """Return a mark's place on every keyframe of the current layer, or None if not at hand."""
        match = self._match()
        return match and match.mates(known)

    # -- what the artist does ------------------------------------------------------------------

    def set_placing(self, placing: bool) -> None:
        """Say whether the tool that places marks is in hand."""
        self.placing = placing
        self._follow()

    def place(self, known: Known) -> None:
        """Place a mark on the current layer; if its mates are not at hand, once they are."""
        self._waiting.append(known)
        self._waiting_on = self._question()
        self._advance()

    @property
    def waiting(self) -> tuple[Known, ...]:
        """The marks that are about to be placed."""
        return tuple(self._waiting)

    def accept(self, suggestion: Suggestion) -> None:
        """Make a mark of a suggestion, unless it is no longer current."""
        if self.current and suggestion in self.shown:
            self._add(suggestion.places)

    def accept_all(self) -> None:
        """Make all shown suggestions marks, in one step."""
        if self.current and self.shown:
            text = self.tr("Accept suggested marks")
            layer_id = self._answer.question.layer_id
            self._session.apply(text, _with_all, layer_id, self.shown)

    def close(self) -> None:
        """Stop, and end the thread."""
        if self._worker.closed:
            return
        for signal in self._followed():
            signal.disconnect(self._follow_soon)
        self._soon.stop()
        self._worker.close()

    # -- the flow ------------------------------------------------------------------------------

    def _followed(self) -> tuple[SignalInstance, ...]:
        return (
            self._session.changed,
            self._session.undo_stack.indexChanged,  # a drag has ended
            self._selection.changed,
            self._playhead.moved,
            self._solver.updated,
            self._view.changed,
        )

    def _follow_soon(self) -> None:
        """Follow once what several signals announce, when all have heard of it."""
        self._soon.start()

    def _follow(self) -> None:
        """Take note of what is in view now."""
        question = self._question()
        if self._waiting and not (question and question.alike(self._waiting_on)):
            self._waiting.clear()  # the artist has gone on to something else
        seen = question, self.visible, self.placing
        if seen != self._seen:
            self._seen = seen
            self.changed.emit()
        self._advance()

    def _question(self) -> _Question | None:
        """Return what is to be found out; None while nobody wants to know."""
        layer = self._selection.layer
        wanted = self.placing or self.visible or self._waiting
        if not wanted or layer is None or layer.locked or not layer.visible:
            return None
        span, _ = layer.span_at(self._playhead.frame)
        return _Question(layer.id, layer.keyframes, span, self._proposed(layer, span))

    def _contradicted(self, question: _Question) -> bool:
        """Whether the marks that are set contradict each other: more of them would not help."""
        error = self._solver.errors.get((question.layer_id, question.span))
        return isinstance(error, MarkError)

    def _proposed(self, layer: Layer, span: int) -> Proposed | None:
        key = layer.keyframes[span]
        if {mark.ring for mark in key.marks} == set(range(len(key.outline.rings))):
            return ()  # where marks decide, there is nothing to wait for
        state = self._solver.state(layer.id, span)
        if state is not SpanState.SOLVED:
            return None if state is SpanState.SOLVING else ()
        morph = self._solver.morph_of(span_of(layer, span))
        return morph and morph.report.proposed

    def _advance(self) -> None:
        """Place what waits, if its mates are at hand; find out what is not known yet."""
        if self._waiting and (match := self._match()) is not None:
            known = self._waiting.pop(0)
            self._add(match.mates(known))
            self._waiting_on = self._question()
        question = self._question()
        if self._worker.busy:
            if question is None or not question.alike(self._asked):
                self._worker.cancel()
            return
        ready = question and not question.open and not self._session.dragging
        if question and not self.current and (ready or self._waiting):
            self._asked = question
            self._worker.start(partial(_answer, question))

    def _on_done(self, _number: int, outcome: _Answer | MorphError | Cancelled) -> None:
        asked, self._asked = self._asked, None
        if isinstance(outcome, MorphError):
            if self._waiting:
                self._session.failed.emit(outcome)
            outcome = _Answer(asked)
            self._waiting.clear()
        if isinstance(outcome, _Answer):
            self._answer = outcome
            self.changed.emit()
        self._advance()

    def _match(self) -> LayerMatch | None:
        """Return the match of the current layer, if it is at hand."""
        answer, question = self._answer, self._question()
        if answer is None or question is None or not question.alike(answer.question):
            return None
        return answer.match

    def _add(self, places: tuple[RingPoint, ...]) -> None:
        layer = self._selection.layer
        text = self.tr("Place mark {letter}").format(letter=layer.next_label)
        if self._session.apply(text, edits.add_mark, layer.id, places):
            self._selection.select_mark(len(layer.labels))
            self.placed.emit(layer.next_label)


def _with_all(document: Document, layer_id: int, marks: tuple[Suggestion, ...]) -> Document:
    for mark in marks:
        document = edits.add_mark(document, layer_id, mark.places)
    return document


def _answer(question: _Question, progress: Progress) -> _Answer:
    proposed = question.proposed or ()
    match = match_layer(question.keyframes, question.span, proposed, progress)
    found = () if question.open or not match.spans else match.suggestions(question.span, proposed)
    return _Answer(question, match, found)


def _fits(suggestion: Suggestion, keyframes: tuple[Keyframe, ...]) -> bool:
    """Whether a suggestion can be shown on keyframes: there is such a place, and no mark on it."""
    return len(suggestion.places) == len(keyframes) and all(
        place.ring < len(key.outline.rings)
        and place.at < len(key.outline.rings[place.ring])
        and place not in key.marks
        for place, key in zip(suggestion.places, keyframes, strict=True)
    )
