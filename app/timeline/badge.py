"""The badge of a span: how it stands, told by shape as well as by colour."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from app.jobs.inspector import Standing
from app.style import colours

RADIUS = 8.0
ROOM = 64.0
"""Pixels that a span must be long for its badge to fit between the keys."""


def paint_badge(painter: QPainter, centre: QPointF, standing: Standing) -> None:
    """Draw a tick, a warning triangle, a cross, dots, or a dash, on a ground of its own."""
    c, x, y = colours(), centre.x(), centre.y()
    match standing:
        case Standing.SOUND:
            _disc(painter, centre, c.solved)
            _strokes(painter, c.on_accent, [(x - 3.5, y), (x - 1, y + 3), (x + 4, y - 3)])
        case Standing.UNSOUND:
            _triangle(painter, centre, c.error)
            _strokes(painter, c.on_accent, [(x, y - 3.5), (x, y + 1)])
            _dot(painter, QPointF(x, y + 4.5), c.on_accent)
        case Standing.FAILED:
            _disc(painter, centre, c.error)
            _strokes(painter, c.on_accent, [(x - 3, y - 3), (x + 3, y + 3)])
            _strokes(painter, c.on_accent, [(x - 3, y + 3), (x + 3, y - 3)])
        case Standing.SOLVING | Standing.CHECKING:
            colour = c.solving if standing is Standing.SOLVING else c.solved
            _disc(painter, centre, c.base, rim=colour)
            for dx in (-3.6, 0.0, 3.6):
                _dot(painter, QPointF(x + dx, y), colour)
        case Standing.STALE | Standing.NONE:
            colour = c.solving if standing is Standing.STALE else c.muted
            _disc(painter, centre, c.base, rim=colour)
            _strokes(painter, colour, [(x - 3, y), (x + 3, y)])


def _disc(painter: QPainter, centre: QPointF, fill: str, rim: str = "") -> None:
    """Draw a disc; its rim sets it off from the bar, unless it has a colour of its own."""
    painter.setPen(QPen(QColor(rim or colours().base), 1.5))
    painter.setBrush(QColor(fill))
    painter.drawEllipse(centre, RADIUS, RADIUS)


def _triangle(painter: QPainter, centre: QPointF, fill: str) -> None:
    x, y = centre.x(), centre.y()
    pen = QPen(QColor(colours().base), 1.5)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    painter.setPen(pen)
    painter.setBrush(QColor(fill))
    corners = [QPointF(x, y - 9.5), QPointF(x + 10.5, y + 8), QPointF(x - 10.5, y + 8)]
    painter.drawPolygon(QPolygonF(corners))


def _strokes(painter: QPainter, colour: str, points: list[tuple[float, float]]) -> None:
    pen = QPen(QColor(colour), 2.0)
    pen.setCapStyle(Qt.PenCapStyle.RoundCap)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    painter.setPen(pen)
    painter.drawPolyline([QPointF(*point) for point in points])


def _dot(painter: QPainter, centre: QPointF, colour: str) -> None:
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(colour))
    painter.drawEllipse(QRectF(centre.x() - 1.2, centre.y() - 1.2, 2.4, 2.4))
