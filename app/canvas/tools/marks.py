"""Marks: say which points of the keyframes belong together."""

from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QPainter

from app.canvas.ink import draw_line, draw_ring
from app.canvas.marks_overlay import mark_at
from app.canvas.moment import Role
from app.canvas.pins import pins_on_key
from app.canvas.pointer import REACH, Pointer
from app.canvas.tools import edits as composed
from app.canvas.tools.tool import Command, Gesture, Tool, arrow_step
from app.document.session import Session
from app.style import colours
from app.workspace import Workspace
from core.geometry.places import nearest_place, tracks
from core.geometry.polyline import points_at
from core.model import Layer, Outline, RingPoint, edits
from core.model.layer import mark_labels
from core.model.outline import Array
from core.morph.suggest import mate, snap

if TYPE_CHECKING:
    from app.canvas.pane import Pane

NEAR = 3.0
"""A click places a mark within this many times the reach of the outline."""


@dataclass
class MoveMark:
    """A drag of a mark along its outline; it snaps to corners unless Shift is held."""

    session: Session
    text: str
    layer_id: int
    key: int
    mark: int
    outline: Outline
    offset: Array
    """From the mouse to the marked place, at the press."""

    def move(self, pointer: Pointer) -> None:
        """Put the mark where the mouse points."""
        place, _ = nearest_place(self.outline, pointer.position + self.offset)
        if not pointer.shift:
            place = snap(self.outline, place, pointer.reach)
        self.session.apply(self.text, edits.move_mark, self.layer_id, self.key, self.mark, place)

    def end(self, pointer: Pointer) -> None:
        """Nothing is left to do."""


class MarksTool(Tool):
    """Places and drags marks."""

    name = "marks"
    aims = True

    def __init__(self, workspace: Workspace, parent: QObject) -> None:
        super().__init__(workspace, parent)
        self._pane: Pane | None = None
        self._mark: int | None = None
        self._places: dict[int, RingPoint] = {}
        """Where a click would put a mark, by keyframe: the one under the mouse and its mate's."""
        self._thread = ThreadPoolExecutor(1, "mates")
        self._matched: object = None
        """The outlines whose mates are being looked for, or are at hand."""
        self._matching: Future[RingPoint] | None = None
        self._placed = ""
        """The letter that was placed last."""

    def hover(self, pointer: Pointer) -> None:
        """Find the mark under the mouse, or where a click would place one."""
        self._pane, self._mark, self._places = pointer.pane, self._mark_at(pointer), {}
        layer, key = self.layer, pointer.pane.key
        if self._mark is None and layer is not None and key is not None:
            place = self._place_at(pointer)
            self._places = self._proposed(layer, key, place) if place else {}
        taken = self._mark is not None or self._places
        self.cursor = Qt.CursorShape.PointingHandCursor if taken else Qt.CursorShape.ArrowCursor

    def leave(self) -> None:
        """Forget the hover."""
        super().leave()
        self._pane, self._mark, self._places = None, None, {}

    def grab(self, pointer: Pointer) -> Gesture | None:
        """Select the mark under the mouse and take it."""
        layer, keyframe = self.editable(pointer.pane), pointer.pane.keyframe
        self._mark = self._mark_at(pointer)
        if layer is None or keyframe is None or self._mark is None:
            return None
        self.selection.select_mark(self._mark)
        offset = keyframe.outline.position(keyframe.marks[self._mark]) - pointer.position
        text = self.tr("Move mark {letter}").format(letter=layer.labels[self._mark])
        return MoveMark(
            self.session, text, layer.id, self.selection.key, self._mark, keyframe.outline, offset
        )

    def click(self, pointer: Pointer) -> None:
        """Place a mark on the outline."""
        if self._mark is not None:
            return
        place, key = self._place_at(pointer), pointer.pane.key
        layer = self.editable(pointer.pane)
        if layer is None or key is None:
            return
        if place is None:
            self.selection.select_mark(None)
            return
        self._add(layer, key, place)

    def key(self, key: int, modifiers: Qt.KeyboardModifier) -> Command | None:
        """Add a mark, step through them, move the selected one along the outline, delete it."""
        layer, mark = self.layer, self.selection.mark
        if layer is None:
            return None
        if key == Qt.Key.Key_Insert:
            return self._insert
        if not layer.labels:
            return None
        if key in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            return self._previous if key == Qt.Key.Key_Backtab else self._next
        if mark is None:
            return None
        step = arrow_step(key, modifiers)
        if step is not None:
            return lambda: self._nudge(layer, mark, step)
        if key in (Qt.Key.Key_Delete, Qt.Key.Key_Backspace):
            return self._delete
        return None

    def advice(self) -> str:
        """Say what the next click does."""
        layer = self.selection.layer
        if layer is None:
            return self.tr("Marks go on outlines: press P or B and draw one first")
        letter = _next_letter(layer)
        if self._mark is not None and self._mark < len(layer.labels):
            letter = layer.labels[self._mark]
            text = self.tr("Drag mark {letter} along the outline; Del deletes it")
            if letter == self._placed and len(layer.keyframes) > 1:
                text = self.tr(
                    "Mark {letter} is placed: drag it on the other outline if its mate is not right"
                )
        elif len(self._places) > 1:
            text = self.tr("Click to place mark {letter}; its mate is proposed as shown")
        elif self._places and len(layer.keyframes) > 1:
            text = self.tr("Click to place mark {letter}; its mate is proposed too")
        elif self._pane is not None and self._pane.key is None:
            text = self.tr("Marks go on the source or the target outline, not in between")
        else:
            text = self.tr("Click a corner of the outline to place mark {letter}")
        return text.format(letter=letter)

    @property
    def seen(self) -> object:
        """What is under the mouse."""
        return self._pane, self._mark, tuple(self._places.items())

    def paint(self, painter: QPainter, pane: Pane) -> None:
        """Paint where a click would place a mark, here and on the other keyframe."""
        keyframe, key = pane.keyframe, pane.key
        if keyframe is None or key is None:
            return
        self.paint_key(painter, pane)
        if self._pane is not None and key in self._places:
            self._paint_ghost(painter, pane, keyframe.outline, self._places[key])

    # -- helpers of the mouse ------------------------------------------------------------------

    def _mark_at(self, pointer: Pointer) -> int | None:
        keyframe, view = pointer.pane.keyframe, pointer.pane.view
        if keyframe is None:
            return None
        return mark_at(view, pins_on_key(keyframe), view.to_screen(pointer.position), REACH)

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
        """Return a place with its mate on the other keyframe in view, once that is at hand.

        To match outlines takes too long while the mouse moves; the next move shows what came of it.
        """
        assert self._pane is not None
        other = key + {Role.SOURCE: 1, Role.TARGET: -1}.get(self._pane.role, 0)
        if other == key or not 0 <= other < len(layer.keyframes):
            return {key: place}
        here, there = layer.keyframes[key], layer.keyframes[other]
        pairs = tuple(zip(here.marks, there.marks, strict=True))
        wanted = here.outline, there.outline, pairs, place.ring
        if self._matching is None or (self._matching.done() and self._matched != wanted):
            self._matched = wanted
            self._matching = self._thread.submit(mate, here.outline, there.outline, place, pairs)
        if self._matched != wanted or not self._matching.done():
            return {key: place}
        return {key: place, other: mate(here.outline, there.outline, place, pairs)}

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

    # -- keys ----------------------------------------------------------------------------------

    def _next(self) -> None:
        self._step(1)

    def _previous(self) -> None:
        self._step(-1)

    def _step(self, by: int) -> None:
        layer, mark = self.selection.layer, self.selection.mark
        assert layer is not None
        start = -1 if by > 0 else 0
        self.selection.select_mark(((start if mark is None else mark) + by) % len(layer.labels))

    def _nudge(self, layer: Layer, mark: int, step: Array) -> None:
        """Move a mark along the outline, the way round that goes with the arrow."""
        key = self.selection.key
        keyframe = layer.keyframes[key]
        along = _along(keyframe.outline, keyframe.marks[mark], step)
        text = self.tr("Move mark {letter}").format(letter=layer.labels[mark])
        self.session.amend(self.held, text, composed.slide_mark, layer.id, key, mark, along)

    def _insert(self) -> None:
        """Place a mark at the first node without one, after the selected mark."""
        layer, keyframe, mark = self.selection.layer, self.selection.keyframe, self.selection.mark
        assert layer is not None
        assert keyframe is not None
        taken = {(place.ring, place.at) for place in keyframe.marks}
        start = RingPoint(0, 0.0) if mark is None else keyframe.marks[mark]
        count = len(keyframe.outline.rings[start.ring])
        nodes = [(int(start.at) + i) % count for i in range(count)]
        free = (node for node in nodes if (start.ring, float(node)) not in taken)
        node = next(free, None)
        if node is not None:
            self._add(layer, self.selection.key, RingPoint(start.ring, float(node)))

    def _add(self, layer: Layer, key: int, place: RingPoint) -> None:
        letter = _next_letter(layer)
        text = self.tr("Place mark {letter}").format(letter=letter)
        if self.session.apply(text, composed.place_mark, layer.id, key, place):
            self._placed = letter
            self.selection.select_mark(len(layer.labels))

    def _delete(self) -> None:
        layer, mark = self.selection.layer, self.selection.mark
        assert layer is not None
        assert mark is not None
        text = self.tr("Delete mark {letter}").format(letter=layer.labels[mark])
        self._mark = None
        self.session.apply(text, edits.remove_marks, layer.id, [mark])


def _next_letter(layer: Layer) -> str:
    return next(label for label in mark_labels() if label not in layer.labels)


def _along(outline: Outline, place: RingPoint, step: Array) -> float:
    """Return how far along the outline an arrow's step (2,) goes: forward is positive."""
    track = tracks(outline)[place.ring]
    length, size = track.length_of(place.at), float(np.hypot(*step))
    around = np.array([length - size, length + size])
    behind, ahead = points_at(track.polyline.points, track.lengths, around)
    return size if (ahead - behind) @ step >= 0 else -size
