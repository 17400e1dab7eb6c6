"""Onion skin: the keyframes before and after, as tinted ghosts under what is being made."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from app.canvas.artboard import EVERYWHERE
from app.render.painter import outline_path
from core.geometry.flatten import flatten
from core.model import Outline

FILL_ALPHA = 36
BEFORE, AFTER = Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine
Ghost = tuple[Outline, str, Qt.PenStyle]
"""An outline, its colour, and the line that tells before from after without it."""


class OnionSkin(QGraphicsItem):
    """Tinted outlines: a faint fill and a thin line."""

    def __init__(self) -> None:
        super().__init__()
        self._shown: tuple[Ghost, ...] = ()
        self._ghosts: list[tuple[QPainterPath, QColor, QPen]] = []

    def show_outlines(self, outlines: Sequence[Ghost]) -> None:
        """Show ghosts of keyframes; none hides them."""
        if self._shown == tuple(outlines):
            return
        self._shown = tuple(outlines)
        self._ghosts = []
        for outline, colour, style in outlines:
            path = outline_path([polyline.points for polyline in flatten(outline)])
            fill = QColor(colour)
            fill.setAlpha(FILL_ALPHA)
            pen = QPen(QColor(colour), 1.0, style)
            pen.setCosmetic(True)
            self._ghosts.append((path, fill, pen))

    def boundingRect(self) -> QRectF:
        """Return everything."""
        return EVERYWHERE

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Paint the ghosts; a cosmetic pen counts device pixels, so it needs their ratio."""
        for path, fill, pen in self._ghosts:
            pen.setWidthF(painter.device().devicePixelRatioF())
            painter.setPen(pen)
            painter.setBrush(fill)
            painter.drawPath(path)
