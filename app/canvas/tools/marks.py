"""Marks: say which points of the keyframes belong together."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QPainter

from app.canvas.ink import draw_line, draw_ring
from app.canvas.marks_overlay import mark_at
from app.canvas.moment import Role
from app.canvas.pins import pins_on_key
from app.canvas.pointer import REACH, Pointer
from app.canvas.suggestions_overlay import suggestion_at
from app.canvas.tools.mark_drags import DragMark, added_mark, moved_mark
from app.canvas.tools.mark_keys import MarkKeys
from app.canvas.tools.tool import Command, Gesture, Tool
from app.style import colours
from app.workspace import Workspace
from core.geometry.places import nearest_place
from core.model import Layer, Outline, RingPoint
from core.morph.layer_match import Suggestion
from core.morph.suggest import snap

if TYPE_CHECKING:
    from app.canvas.pane import Pane

NEAR = 3.0
"""A click places a mark within this many times the reach of the outline."""


class MarksTool(Tool):
    """Places and drags marks, and makes marks of suggestions."""

    name = "marks"
    aims = True
    places_marks = True

    def __init__(self, workspace: Workspace, parent: QObject) -> None:
        super().__init__(workspace, parent)
        self.suggestions = workspace.suggestions
        self.suggestions.placed.connect(self._on_placed)
        self._pane: Pane | None = None
        self._mark: int | None = None
        self._suggestion: Suggestion | None = None
        """What is under the mouse, if it is current, …"""
        self._suggested_key = 0
        """… and the keyframe on which that is."""
        self._places: dict[int, RingPoint] = {}
        """Where a click would put a mark, by keyframe: the one under the mouse and its mate's."""
        self._keys = MarkKeys(self.session, self.selection, self.suggestions)
        self._placed = ""
        """The letter that was placed last."""

    def hover(self, pointer: Pointer) -> None:
        """Find the mark or suggestion under the mouse, or where a click would place a mark."""
        self._look_at(pointer)
        self._places = {}
        layer, key = self.layer, pointer.pane.key
        hit = self._mark is not None or self._suggestion is not None
        if not hit and layer is not None and key is not None:
            place = self._place_at(pointer)
            self._places = self._proposed(layer, key, place) if place else {}
        taken = hit or self._places
        self.cursor = Qt.CursorShape.PointingHandCursor if taken else Qt.CursorShape.ArrowCursor

    def leave(self) -> None:
        """Forget the hover."""
        super().leave()
        self._pane, self._mark, self._suggestion, self._places = None, None, None, {}

    def grab(self, pointer: Pointer) -> Gesture | None:
        """Take the mark under the mouse, selecting it, or the suggestion."""
        self._keys.chosen = None
        layer, keyframe = self.editable(pointer.pane), pointer.pane.keyframe
        self._look_at(pointer)
        if layer is None or keyframe is None:
            return None
        key, outline = self.selection.key, keyframe.outline
        if self._mark is not None:
            self.selection.select_mark(self._mark)
            mark, place = self._mark, keyframe.marks[self._mark]
            text = self.tr("Move mark {letter}").format(letter=layer.labels[mark])
            put = partial(moved_mark, layer.id, key, mark)
        elif self._suggestion is not None:
            key = self._suggested_key
            mark, place = len(layer.labels), self._suggestion.places[key]
            outline = layer.keyframes[key].outline
            text = self.tr("Place mark {letter}").format(letter=layer.next_label)
            put = partial(added_mark, layer.id, key, self._suggestion)
        else:
            return None
        offset = outline.position(place) - pointer.position
        return DragMark(self.drag, self.selection, text, mark, outline, offset, put)

    def click(self, pointer: Pointer) -> None:
        """Accept the suggestion under the mouse, or place a mark on the outline."""
        if self._mark is not None:
            return
        if self._suggestion is not None:
            self.suggestions.accept(self._suggestion)
            return
        place, key = self._place_at(pointer), pointer.pane.key
        layer = self.editable(pointer.pane)
        if layer is None or key is None:
            return
        if place is None:
            self.selection.select_mark(None)
            return
        self.suggestions.place({key: place})

    def key(self, key: int, modifiers: Qt.KeyboardModifier) -> Command | None:
        """Add a mark, accept suggestions, step through both, move or delete the selected mark."""
        layer = self.layer
        return None if layer is None else self._keys.command(layer, key, modifiers, self.held)

    def advice(self) -> str:
        """Say what the next click does."""
        layer = self.selection.layer
        if layer is None:
            return self.tr("Marks go on outlines: press P or B and draw one first")
        letter, shown = layer.next_label, self.suggestions.shown
        pointed = self._suggestion or self._keys.chosen
        number = shown.index(pointed) + 1 if pointed in shown else 0
        if self._mark is not None and self._mark < len(layer.labels):
            letter = layer.labels[self._mark]
            text = self.tr("Drag mark {letter} along the outline; Del deletes it")
            if letter == self._placed and len(layer.keyframes) > 1:
                text = self.tr(
                    "Mark {letter} is placed: drag it on the other outline if its mate is not right"
                )
        elif number and pointed is self._suggestion:
            text = self.tr(
                "Click to accept suggestion {number} as mark {letter}, or drag it elsewhere"
            )
        elif number:
            text = self.tr("Enter accepts suggestion {number} as mark {letter}; Tab goes on")
        elif self.suggestions.waiting:
            text = self.tr("Looking for the mate of mark {letter}…")
        elif len(self._places) > 1:
            text = self.tr("Click to place mark {letter}; its mate is proposed as shown")
        elif self._places and len(layer.keyframes) > 1:
            text = self.tr("Click to place mark {letter}; its mate is proposed too")
        elif self._pane is not None and self._pane.key is None:
            text = self.tr("Marks go on the source or the target outline, not in between")
        elif shown and self.suggestions.current:
            text = self.tr("Click a corner to place mark {letter}, or a suggestion · Enter: all")
            if self.workspace.view.suggestions == "with the tool":
                text += self.tr(" · Esc: hide")
        else:
            text = self.tr("Click a corner of the outline to place mark {letter}")
        return text.format(letter=letter, number=number)

    @property
    def seen(self) -> object:
        """What is under the mouse."""
        pointed = self._mark, self._suggestion, self._keys.chosen
        return self._pane, *pointed, tuple(self._places.items()), self.suggestions.waiting

    @property
    def busy(self) -> bool:
        """Whether Esc has something to abandon."""
        return super().busy or self._keys.chosen is not None

    def abandon(self) -> None:
        """Take back the drag under way; go from the suggestions."""
        super().abandon()
        self._keys.chosen = None

    def paint(self, painter: QPainter, pane: Pane) -> None:
        """Paint where a click would place a mark, here and on the other keyframe; and what is
        pointed at.
        """
        keyframe, key = pane.keyframe, pane.key
        if keyframe is None or key is None:
            return
        self.paint_key(painter, pane)
        if self._pane is not None and key in self._places:
            self._paint_ghost(painter, pane, keyframe.outline, self._places[key])
        for known in self.suggestions.waiting:
            if key in known:
                self._paint_ghost(painter, pane, keyframe.outline, known[key])
        shown, ends = pane.suggested.suggestions, pane.suggested.ends
        for suggestion in (self._suggestion, self._keys.chosen):
            if suggestion in shown:
                for _, pins in ends:
                    at = pane.view.to_screen(pins.places[shown.index(suggestion)])
                    draw_ring(painter, at, REACH, colours().selection)

    # -- helpers of the mouse ------------------------------------------------------------------

    def _look_at(self, pointer: Pointer) -> None:
        """Note the mark under the mouse, or else the suggestion."""
        self._pane, self._mark, self._suggestion = pointer.pane, None, None
        keyframe, view = pointer.pane.keyframe, pointer.pane.view
        if keyframe is None:
            return
        pixel = view.to_screen(pointer.position)
        self._mark = mark_at(view, pins_on_key(keyframe), pixel, REACH)
        if self._mark is None and self.suggestions.current and not pointer.shift:
            found = suggestion_at(view, pointer.pane.suggested, pixel, REACH)
            if found is not None and found[0] in self.suggestions.shown:
                self._suggestion, self._suggested_key = found

    def _place_at(self, pointer: Pointer) -> RingPoint | None:
        """Return where a click places a mark: at a corner within reach, or on the edge."""
        keyframe = pointer.pane.keyframe
        if keyframe is None:
            return None
        place, distance = nearest_place(keyframe.outline, pointer.position)
        if distance > NEAR * pointer.reach:
            return None
        return place if pointer.shift else snap(keyframe.outline, place, pointer.reach)

    def _proposed(self, layer: Layer, key: int, place: RingPoint) -> dict[int, RingPoint]:
        """Return a place with its mate on the other keyframe in view, once that is at hand."""
        assert self._pane is not None
        other = key + {Role.SOURCE: 1, Role.TARGET: -1}.get(self._pane.role, 0)
        if other == key or not 0 <= other < len(layer.keyframes):
            return {key: place}
        places = self.suggestions.mates({key: place})
        return {key: place} if places is None else {key: place, other: places[other]}

    def _paint_ghost(
        self, painter: QPainter, pane: Pane, outline: Outline, place: RingPoint
    ) -> None:
        at = outline.position(place)
        view, colour = pane.view, colours().mark
        here = view.to_screen(at)
        draw_ring(painter, here, REACH if pane is self._pane else REACH - 3, colour)
        if pane is self._pane and place.at == int(place.at):  # a corner: a cross says it snaps
            arm = np.array([[REACH + 4, 0.0], [0.0, REACH + 4]])
            for reach in arm:
                draw_line(painter, np.array([here - reach, here + reach]), colour, width=1.2)

    def _on_placed(self, letter: str) -> None:
        self._placed = letter
