"""Where the in-between on screen folds or crosses itself."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QPainter

from app.canvas.ink import draw_ring
from app.canvas.overlay import Overlay
from app.canvas.view import View
from app.style import colours
from core.model.outline import Array

RADIUS = 9.0


class TroubleRings(Overlay):
    """Quiet rings in the colour of errors; places close together share one."""

    def __init__(self, view: View) -> None:
        super().__init__(view)
        self.places = np.empty((0, 2))
        """(k, 2) document points that are ringed."""

    def show_places(self, places: Array) -> None:
        """Ring (k, 2) document points; none hides it."""
        self.places = places
        self.setVisible(len(places) > 0)
        self.update()

    def draw(self, painter: QPainter) -> None:
        """Paint the rings."""
        drawn: list[Array] = []
        for centre in self.view.to_screen(self.places):
            if all(np.hypot(*(centre - other)) > RADIUS for other in drawn):
                draw_ring(painter, centre, RADIUS, colours().error)
                drawn.append(centre)
