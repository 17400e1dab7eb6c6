"""The mesh over a shape: all edges as one curve, and the folded triangles filled."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QPainterPath, QPolygonF
from PySide6.QtWidgets import QGraphicsPathItem

from app.canvas.view import View
from app.render.painter import colour
from app.style import colours
from core.geometry.orientation import orientations
from core.model.outline import Array

if TYPE_CHECKING:
    from core.geometry.triangulation import Indices

CONTRAST = 0.45
"""How far the lines are from the fill towards black, or towards white on a dark fill."""
LINE = "#7f8895"
"""Where there is no fill."""


class MeshOverlay:
    """Two items of a view, created once and updated for each frame."""

    def __init__(self, view: View, z: float) -> None:
        self._edges = pg.PlotCurveItem(connect="pairs", skipFiniteCheck=True, antialias=False)
        self._edges.setSegmentedLineMode("on")
        self._folds = QGraphicsPathItem()
        self._triangles: Indices | None = None
        self._pairs = np.empty(0, dtype=np.intp)
        view.add_artwork(self._folds, z)
        view.add_artwork(self._edges, z + 0.1)
        self.hide()

    def hide(self) -> None:
        """Show nothing."""
        self._edges.hide()
        self._folds.hide()

    def show_mesh(self, triangles: Indices, positions: Array, fill: str) -> None:
        """Show triangles (m, 3) at positions (n, 2), on a shape of this fill colour."""
        if triangles is not self._triangles:
            self._triangles, self._pairs = triangles, edges_of(triangles).ravel()
        ends = positions[self._pairs]
        self._edges.setData(ends[:, 0], ends[:, 1], pen=pg.mkPen(line_on(fill), width=1))
        self._edges.show()
        folded = positions[triangles[orientations(positions, triangles) <= 0]]
        self._folds.setVisible(len(folded) > 0)
        if len(folded):
            self._folds.setPath(_triangle_path(folded))
            self._folds.setBrush(QColor(colours().error))
            self._folds.setPen(pg.mkPen(colours().error, width=2))


def line_on(fill: str) -> QColor:
    """Return a colour for lines on a fill. It is opaque: translucent lines paint far slower."""
    if not fill:
        return QColor(LINE)
    ground = colour(fill)
    end = 0.0 if ground.lightnessF() > 0.4 else 1.0
    mixed = ((1 - CONTRAST) * part + CONTRAST * end for part in ground.getRgbF()[:3])
    return QColor.fromRgbF(*mixed)


def edges_of(triangles: Indices) -> Indices:
    """Return (e, 2) vertex indices of the edges of (m, 3) triangles, each once."""
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return np.unique(sides, axis=0)


def _triangle_path(corners: Array) -> QPainterPath:
    path = QPainterPath()
    for triangle in corners:
        path.addPolygon(QPolygonF([QPointF(*corner) for corner in triangle]))
        path.closeSubpath()
    return path
