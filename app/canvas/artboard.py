"""The artboard: its background, and its edge against the pasteboard."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPen, QPixmap, QTransform
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from app.render.painter import colour
from app.style import colours

EVERYWHERE = QRectF(-1e6, -1e6, 2e6, 2e6)
"""Bounds of items in document coordinates; every change repaints the whole view anyway."""
CHECK = 8
"""Pixels: a square of the pattern that stands for no background."""


class Artboard(QGraphicsItem):
    """What lies under the layers; a checked ground where the document has no background."""

    def __init__(self) -> None:
        super().__init__()
        self._rect = QRectF()
        self._background = ""

    def show_board(self, size: tuple[float, float], background: str) -> None:
        """Set its size and colour."""
        self._rect, self._background = QRectF(0, 0, *size), background

    def boundingRect(self) -> QRectF:
        """Return everything."""
        return EVERYWHERE

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Paint the ground, then a line that is as thin at every zoom."""
        ground = colour(self._background)
        if ground.alpha() < 255:
            zoom = abs(painter.worldTransform().m11())
            brush = QBrush(_checks())
            brush.setTransform(QTransform.fromScale(1 / zoom, 1 / zoom))
            painter.fillRect(self._rect, brush)
        painter.fillRect(self._rect, ground)
        painter.setPen(QPen(QColor(colours().line), 0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(self._rect)


def _checks() -> QPixmap:
    pattern = QPixmap(2 * CHECK, 2 * CHECK)
    pattern.fill(QColor("#ffffff"))
    painter = QPainter(pattern)
    for x, y in ((0, 0), (CHECK, CHECK)):
        painter.fillRect(x, y, CHECK, CHECK, QColor("#e3e5e9"))
    painter.end()
    return pattern
