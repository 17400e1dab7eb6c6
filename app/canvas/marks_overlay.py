"""Marks: a dot on the outline, and its letter in a circle that stands off the shape."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from app.canvas.ink import HALO, pen
from app.canvas.overlay import Overlay
from app.canvas.pins import NO_PINS, Pins
from app.canvas.view import View
from app.style import colours
from core.model.outline import Array

RADIUS = 9.5
"""Of the circle around a letter, in pixels."""
STALK = 21.0
"""From the marked place to the middle of its letter."""
DOT = 3.5
BEHIND = 0.5
"""Opacity while they stand back."""
LEASH = 1.8
"""How many times as far a letter may go to make room for others."""
ROUNDS = 12


class MarksOverlay(Overlay):
    """The marks of one keyframe, or of an in-between."""

    def __init__(self, view: View) -> None:
        super().__init__(view)
        self._labels: tuple[str, ...] = ()
        self._pins = NO_PINS
        self._selected: int | None = None

    def show_marks(self, labels: Sequence[str], pins: Pins, selected: int | None) -> None:
        """Show marks, by their letters."""
        self._labels, self._pins, self._selected = tuple(labels), pins, selected
        self.update()

    def stand_back(self, back: bool) -> None:
        """Let what the tool in hand shows be seen through the marks, or show them in full."""
        self.setOpacity(BEHIND if back else 1.0)

    def draw(self, painter: QPainter) -> None:
        """Paint them, the selected one last."""
        places = self.view.to_screen(self._pins.places)
        letters = letter_centres(self.view, self._pins)
        order = sorted(range(len(places)), key=lambda i: i == self._selected)
        for i in order:
            self._draw_mark(painter, places[i], letters[i], self._labels[i], i == self._selected)

    def _draw_mark(
        self, painter: QPainter, place: Array, letter: Array, label: str, selected: bool
    ) -> None:
        amber, ink = QColor(colours().mark), QColor(colours().on_mark)
        painter.setPen(pen(HALO, 4.0))
        painter.drawLine(QPointF(*place), QPointF(*letter))
        painter.setPen(pen(ink, 1.5))
        painter.drawLine(QPointF(*place), QPointF(*letter))
        painter.setBrush(amber)
        painter.drawEllipse(QPointF(*place), DOT, DOT)
        if selected:
            painter.setPen(pen(colours().selection, 3.0))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawEllipse(QPointF(*letter), RADIUS + 3.5, RADIUS + 3.5)
            painter.setPen(pen(ink, 1.5))
            painter.setBrush(amber)
        painter.drawEllipse(QPointF(*letter), RADIUS, RADIUS)
        font = painter.font()
        font.setPixelSize(13 if len(label) == 1 else 10)
        font.setBold(True)
        painter.setFont(font)
        box = QRectF(letter[0] - RADIUS, letter[1] - RADIUS, 2 * RADIUS, 2 * RADIUS)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, label)


def letter_centres(view: View, pins: Pins) -> Array:
    """Return (k, 2) pixels of a view where the letters stand: off the shape, and side by side."""
    return _apart(stalk_ends(view, pins, STALK), view.to_screen(pins.places))


def stalk_ends(view: View, pins: Pins, stalk: float) -> Array:
    """Return (k, 2) pixels of a view that are ``stalk`` away from the pins, off the shape."""
    mirror = np.sign(view.to_screen([1.0, 0.0]) - view.to_screen([0.0, 0.0]))[0]
    return view.to_screen(pins.places) + stalk * pins.outward * [mirror, 1.0]


def _apart(letters: Array, places: Array) -> Array:
    """Push letters (k, 2) off each other and off marked places (k, 2), each on a leash.

    What moves little moves them little, so that they do not hop while a shape is scrubbed.
    """
    others = ~np.eye(len(letters), dtype=bool)
    for _ in range(ROUNDS):
        letters = letters + _push(letters, letters, RADIUS, others) / 2
        letters = letters + _push(letters, places, DOT + 1, others)
        stalks = letters - places
        length = np.maximum(np.hypot(*stalks.T), 1e-9)
        letters = places + stalks * (np.clip(length, STALK, LEASH * STALK) / length)[:, None]
    return letters


def _push(letters: Array, things: Array, radius: float, others: Array) -> Array:
    """Return how far (k, 2) letters have to go to be off things (k, 2) of a radius."""
    away = letters[:, None] - things
    distance = np.maximum(np.hypot(away[..., 0], away[..., 1]), 1e-9)
    overlap = np.where(others, np.maximum(RADIUS + radius + 1 - distance, 0.0), 0.0)
    return (away * (overlap / distance)[..., None]).sum(axis=1)


def mark_at(view: View, pins: Pins, pixel: Array, reach: float) -> int | None:
    """Return the mark whose letter or dot is at a pixel (2,) of a view; the dot counts first."""
    if not len(pins.places):
        return None
    for centres, radius in (
        (view.to_screen(pins.places), reach),
        (letter_centres(view, pins), RADIUS + 2),
    ):
        away = np.hypot(*(centres - pixel).T)
        nearest = int(np.argmin(away))
        if away[nearest] <= radius:
            return nearest
    return None
