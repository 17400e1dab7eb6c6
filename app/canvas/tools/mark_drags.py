"""Drags of marks and of suggestions along an outline, and what they put where."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.canvas.pointer import Pointer
from app.canvas.tools.tool import Apply
from app.document.selection import Selection
from core.geometry.places import nearest_place
from core.model import Document, Outline, RingPoint, edits
from core.model.outline import Array
from core.morph.layer_match import Suggestion
from core.morph.suggest import snap


@dataclass
class DragMark:
    """A drag of a mark along an outline; it snaps to corners unless Shift is held."""

    drag: Apply
    selection: Selection
    text: str
    mark: int
    outline: Outline
    offset: Array
    """From the mouse to the marked place, at the press."""
    put: Callable[[Document, RingPoint], Document]
    """The edit that puts the mark at a place."""

    def move(self, pointer: Pointer) -> None:
        """Put the mark where the mouse points."""
        place, _ = nearest_place(self.outline, pointer.position + self.offset)
        if not pointer.shift:
            place = snap(self.outline, place, pointer.reach)
        self.drag(self.put, place)
        self.selection.select_mark(self.mark)

    def end(self, pointer: Pointer) -> None:
        """Nothing is left to do."""


def moved_mark(
    layer_id: int, key: int, mark: int, document: Document, place: RingPoint
) -> Document:
    """Move a mark on one keyframe."""
    return edits.move_mark(document, layer_id, key, mark, place)


def added_mark(
    layer_id: int, key: int, suggestion: Suggestion, document: Document, place: RingPoint
) -> Document:
    """Add a suggested mark, but on one keyframe at another place."""
    places = (*suggestion.places[:key], place, *suggestion.places[key + 1 :])
    return edits.add_mark(document, layer_id, places)
