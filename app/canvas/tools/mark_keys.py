"""What the keyboard does with marks and suggestions."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QCoreApplication, Qt

from app.canvas.tools.tool import Command, arrow_step
from app.document.selection import Selection
from app.document.session import Session
from app.jobs.suggestions import Suggestions
from core.model import Layer, RingPoint, edits
from core.model.outline import Array
from core.morph import edits as composed
from core.morph.layer_match import Suggestion


class MarkKeys:
    """Goes through marks and suggestions, accepts these, and adds, moves and deletes those."""

    def __init__(self, session: Session, selection: Selection, suggestions: Suggestions) -> None:
        self._session, self._selection, self._suggestions = session, selection, suggestions
        self.chosen: Suggestion | None = None
        """The suggestion that the keys have come to."""

    def command(
        self, layer: Layer, key: int, modifiers: Qt.KeyboardModifier, held: object
    ) -> Command | None:
        """Return what a key does now; all that it does while it is held is one step."""
        mark, shown = self._selection.mark, self._suggestions.shown
        if key == Qt.Key.Key_Insert:
            return partial(self._insert, layer)
        if shown and key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            return self._accept
        if (layer.labels or shown) and key in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            return partial(self._step, layer, -1 if key == Qt.Key.Key_Backtab else 1)
        if mark is None:
            return None
        step = arrow_step(key, modifiers)
        if step is not None:
            return partial(self._nudge, layer, mark, step, held)
        if key in (Qt.Key.Key_Delete, Qt.Key.Key_Backspace):
            return partial(self._delete, layer, mark)
        return None

    def _step(self, layer: Layer, by: int) -> None:
        """Go on among the marks, and after them the suggestions."""
        marks, shown = len(layer.labels), self._suggestions.shown
        at = self._selection.mark
        if self.chosen in shown:
            at = marks + shown.index(self.chosen)
        at = ((-1 if by > 0 else 0) if at is None else at) + by
        at %= marks + len(shown)
        self.chosen = shown[at - marks] if at >= marks else None
        self._selection.select_mark(at if at < marks else None)

    def _accept(self) -> None:
        """Accept the suggestion that the keys have come to, or else all."""
        chosen, self.chosen = self.chosen, None
        if chosen is None:
            self._suggestions.accept_all()
        else:
            self._suggestions.accept(chosen)

    def _insert(self, layer: Layer) -> None:
        """Place a mark at the first node without one, after the selected mark."""
        key, mark = self._selection.key, self._selection.mark
        keyframe = layer.keyframes[key]
        waiting = [known[key] for known in self._suggestions.waiting if key in known]
        taken = {(place.ring, place.at) for place in (*keyframe.marks, *waiting)}
        start = RingPoint(0, 0.0) if mark is None else keyframe.marks[mark]
        count = len(keyframe.outline.rings[start.ring])
        nodes = [float((int(start.at) + i) % count) for i in range(count)]
        free = next((node for node in nodes if (start.ring, node) not in taken), None)
        if free is not None:
            self._suggestions.place({key: RingPoint(start.ring, free)})

    def _nudge(self, layer: Layer, mark: int, step: Array, held: object) -> None:
        """Move a mark along the outline, the way round that goes with the arrow."""
        key = self._selection.key
        keyframe = layer.keyframes[key]
        along = composed.length_along(keyframe.outline, keyframe.marks[mark], step)
        text = _tr("Move mark {letter}").format(letter=layer.labels[mark])
        self._session.amend(held, text, composed.slide_mark, layer.id, key, mark, along)

    def _delete(self, layer: Layer, mark: int) -> None:
        text = _tr("Delete mark {letter}").format(letter=layer.labels[mark])
        self._session.apply(text, edits.remove_marks, layer.id, [mark])


def _tr(text: str) -> str:
    return QCoreApplication.translate("MarksTool", text)
