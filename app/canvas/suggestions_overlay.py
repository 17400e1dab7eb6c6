"""Suggested marks: small hollow diamonds with a number, fainter than any mark that is set.

Where nothing stands out on the outline there is but a dot: a mark as good, but none to look at.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from app.canvas.ink import HALO, pen
from app.canvas.marks_overlay import letter_centres, stalk_ends
from app.canvas.overlay import Overlay
from app.canvas.pins import NO_PINS, Pins, pins_at
from app.canvas.view import View
from app.style import colours
from core.model import Layer
from core.model.outline import Array
from core.morph.layer_match import Suggestion

SIZE = 4.5
"""From the middle of a diamond to its corners, in pixels."""
STALK = 13.0
"""From the suggested place to the middle of its number."""
NUMBER = 6.0
"""Half the side of the room that a number takes."""
FAINTEST, CLEAREST = 0.35, 0.85
"""Opacity at no confidence, and at full confidence."""
STALE = 0.5
"""What is left of it while the suggestion is not current."""
DOT = 2.0
"""Radius of what does not stand out."""


@dataclass(frozen=True, eq=False)
class SuggestedPins:
    """What is suggested, as far as one pane shows it."""

    suggestions: tuple[Suggestion, ...] = ()
    ends: tuple[tuple[int, Pins], ...] = ()
    """The keyframes of the span that are seen here, and where the suggestions are on each."""
    current: bool = False

    @classmethod
    def on(
        cls, layer: Layer, keys: Sequence[int], suggestions: Sequence[Suggestion], current: bool
    ) -> Self:
        """Find the places of suggestions on keyframes of a layer."""
        ends = (
            (key, pins_at(layer.keyframes[key].outline, [s.places[key] for s in suggestions]))
            for key in keys
        )
        return cls(tuple(suggestions), tuple(ends), current)


class SuggestionsOverlay(Overlay):
    """The suggested marks of one pane."""

    def __init__(self, view: View) -> None:
        super().__init__(view)
        self._suggested, self._marks = SuggestedPins(), NO_PINS

    def show_suggestions(self, suggested: SuggestedPins, marks: Pins) -> None:
        """Show suggestions, whose numbers keep clear of the letters of marks."""
        self._suggested, self._marks = suggested, marks
        self.update()

    def draw(self, painter: QPainter) -> None:
        """Paint them, the surest last."""
        suggested = self._suggested
        if not suggested.ends:
            return
        pins = suggested.ends[0][1]
        ends = [self.view.to_screen(end.places) for _, end in suggested.ends]
        numbers = stalk_ends(self.view, pins, STALK)
        confidence = np.array([suggestion.confidence for suggestion in suggested.suggestions])
        legible = self._legible(numbers, ends[0], confidence)
        strength = FAINTEST + (CLEAREST - FAINTEST) * confidence
        strength *= 1.0 if suggested.current else STALE
        for i in np.argsort(confidence).tolist():
            painter.setOpacity(strength[i])
            if not suggested.suggestions[i].sure:
                _draw_dots(painter, [end[i] for end in ends])
                continue
            for mates in ends[1:]:
                _draw_leader(painter, ends[0][i], mates[i])
            _draw_diamond(painter, ends[0][i], SIZE)
            if legible[i]:
                _draw_number(painter, numbers[i], str(i + 1))
        painter.setOpacity(1.0)

    def _legible(self, numbers: Array, places: Array, confidence: Array) -> list[bool]:
        """Return which numbers of sure places are clear of letters, places and surer numbers."""
        sure = np.array([suggestion.sure for suggestion in self._suggested.suggestions])
        taken = [*letter_centres(self.view, self._marks), *places[sure]]
        legible = [False] * len(numbers)
        for i in np.argsort(-confidence, kind="stable").tolist():
            away = [np.hypot(*(numbers[i] - other)) for other in taken]
            if sure[i] and min(away, default=np.inf) > 2 * NUMBER:
                legible[i] = True
                taken.append(numbers[i])
        return legible


def _draw_diamond(painter: QPainter, at: Array, size: float) -> None:
    x, y = at
    corners = QPolygonF(
        [QPointF(x, y - size), QPointF(x + size, y), QPointF(x, y + size), QPointF(x - size, y)]
    )
    painter.setPen(pen(colours().on_mark, 2.8))
    painter.setBrush(HALO)
    painter.drawPolygon(corners)
    painter.setPen(pen(colours().mark, 1.4))
    painter.drawPolygon(corners)


def _draw_dots(painter: QPainter, places: Sequence[Array]) -> None:
    painter.setPen(pen(colours().on_mark, 1.0))
    painter.setBrush(QColor(colours().mark))
    for place in places:
        painter.drawEllipse(QPointF(*place), DOT, DOT)


def _draw_leader(painter: QPainter, at: Array, mate: Array) -> None:
    """Draw a thin line from a suggested mark to its mate."""
    for colour, width in ((HALO, 2.4), (QColor(colours().on_mark), 0.8)):
        painter.setPen(pen(colour, width))
        painter.drawLine(QPointF(*at), QPointF(*mate))
    _draw_diamond(painter, mate, SIZE - 2)


def _draw_number(painter: QPainter, at: Array, text: str) -> None:
    """Draw a number centred on a pixel (2,), on a halo."""
    font = painter.font()
    font.setPixelSize(10)
    font.setBold(True)
    painter.setFont(font)
    box = QRectF(at[0] - 10, at[1] - 10, 20, 20)
    painter.setPen(HALO)
    for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        painter.drawText(box.translated(dx, dy), Qt.AlignmentFlag.AlignCenter, text)
    painter.setPen(QColor(colours().on_mark))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)


def suggestion_at(
    view: View, suggested: SuggestedPins, pixel: Array, reach: float
) -> tuple[Suggestion, int] | None:
    """Return the suggestion at a pixel (2,) of a view, and the keyframe on which that is."""
    for key, pins in suggested.ends:
        away = np.hypot(*(view.to_screen(pins.places) - pixel).T)
        nearest = int(np.argmin(away))
        if away[nearest] <= reach:
            return suggested.suggestions[nearest], key
    return None
