"""The place of a trouble: a bold ring that pulses when it appears, with a word about it."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF
from PySide6.QtGui import QPainter

from app.canvas.ink import draw_ring, draw_tag
from app.canvas.overlay import Overlay
from app.canvas.view import View
from app.style import colours
from core.errors import Repair, Trouble, Where
from core.model import Keyframe
from core.model.outline import Array

RADIUS = 15.0
SWELL = 12.0
"""How much larger the ring is at the height of a pulse."""


class ErrorRing(Overlay):
    """Rings around document points; the text stands below the lowest."""

    def __init__(self, view: View) -> None:
        super().__init__(view)
        self._points = np.empty((0, 2))
        self._text = ""
        self._colour = colours().error
        self._pulse = 0.0

    def show_error(self, points: Array, trouble: Trouble) -> None:
        """Ring (k, 2) document points; none hides it."""
        self._points, self._text = points, trouble.what
        mended = isinstance(trouble, Repair)
        self._colour = colours().accent if mended else colours().error
        self.setVisible(len(points) > 0)
        self.update()

    def set_pulse(self, pulse: float) -> None:
        """Set how far a pulse has swollen, 0 to 1."""
        self._pulse = pulse
        self.update()

    def draw(self, painter: QPainter) -> None:
        """Paint the rings and the text below them."""
        centres = self.view.to_screen(self._points)
        radius = RADIUS + SWELL * self._pulse
        for centre in centres:
            draw_ring(painter, centre, radius, self._colour, 3.5)
            draw_ring(painter, centre, 2.0, self._colour, 2.0)
        if self._text and len(centres):
            x, y = centres[np.argmax(centres[:, 1])]
            below = QPointF(x, y + RADIUS + SWELL + 12)
            draw_tag(painter, below, self._text, self._colour, "#ffffff")


def places_of(where: Where, keyframe: Keyframe) -> Array:
    """Return (k, 2) document points of a trouble's place on a keyframe."""
    outline = keyframe.outline
    points = [outline.position(keyframe.marks[m]) for m in where.marks if m < len(keyframe.marks)]
    if where.point is not None:
        points.append(np.array(where.point))
    elif where.ring is not None and where.ring < len(outline.rings):
        nodes = outline.rings[where.ring].points
        if where.node is None:
            points.append(nodes.mean(axis=0))
        elif 0 <= where.node < len(nodes):
            points.append(nodes[where.node])
    return np.array(points).reshape(-1, 2)
