"""How keys, spans and their states look. State is told by pattern as well as by colour."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from app.jobs.solver import SpanState
from app.style import colours
from core.model import Layer

KEY = 7.0
"""Half the diagonal of a key's diamond."""
DISC = 0.85
"""Radius of a key's disc, to half the diagonal of a diamond of the same weight."""
BAR = 14.0
"""Height of a span."""
BAND = 5.0
"""Height of the band below it that shows its state."""
PERIOD = 8.0
"""Pixels after which every pattern of the band repeats."""
TICK = 3.0
"""Width of the tick at a troubled frame."""


def paint_span(painter: QPainter, box: QRectF, layer: Layer, *, hold: bool, current: bool) -> None:
    """Draw a span from key to key: a tinted bar with an arrow, or a plain stop for a hold."""
    c = colours()
    tint = QColor(layer.style.fill[:7] or c.muted)
    tint.setAlphaF((0.45 if current else 0.3) if layer.visible else 0.12)
    rim = QColor(c.muted)  # whatever the fill, the bar stands out from its ground
    rim.setAlphaF(0.4 if layer.visible else 0.2)
    painter.setPen(QPen(rim, 1))
    painter.setBrush(tint)
    painter.drawRoundedRect(box, 3.0, 3.0)
    start, end, y = box.left() + KEY + 4, box.right() - KEY - 4, box.center().y()
    if end - start < 10:
        return
    pen = QPen(QColor(c.text if layer.visible else c.disabled), 1.2)
    pen.setCapStyle(Qt.PenCapStyle.RoundCap)
    if hold:
        pen.setStyle(Qt.PenStyle.DotLine)
    painter.setPen(pen)
    painter.drawLine(QPointF(start, y), QPointF(end, y))
    pen.setStyle(Qt.PenStyle.SolidLine)
    painter.setPen(pen)
    if hold:
        painter.drawLine(QPointF(end, y - 4), QPointF(end, y + 4))
    else:
        painter.drawPolyline(
            [QPointF(end - 4, y - 3.5), QPointF(end, y), QPointF(end - 4, y + 3.5)]
        )


def paint_state(painter: QPainter, box: QRectF, state: SpanState) -> None:
    """Draw the band of a state: solid, blocks, zigzag, or dashes where there is no solution."""
    c, y = colours(), box.center().y()
    line = (QPointF(box.left(), y), QPointF(box.right(), y))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    match state:
        case SpanState.SOLVED:
            painter.fillRect(box.adjusted(0, 1, 0, -1), QColor(c.solved))
        case SpanState.SOLVING:
            painter.setPen(_dashed(c.solving, BAND, 4.0, 4.0))
            painter.drawLine(*line)
        case SpanState.FAILED:
            painter.setPen(QPen(QColor(c.error), 1.6))
            sides = (box.bottom(), box.top())
            peaks = range(int(box.width() / 4) + 1)
            painter.drawPolyline([QPointF(box.left() + 4 * i, sides[i % 2]) for i in peaks])
        case SpanState.NONE:
            painter.setPen(_dashed(c.disabled, 1.4, 5.0, 3.0))
            painter.drawLine(*line)


def paint_troubled(painter: QPainter, band: QRectF, places: Iterable[float]) -> None:
    """Draw a tick across the band at each x of a frame that folds or crosses."""
    for x in places:
        if band.left() - TICK <= x <= band.right() + TICK:
            tick = QRectF(x - TICK / 2, band.top() - 2, TICK, band.height() + 4)
            painter.fillRect(tick, QColor(colours().error))


def _dashed(colour: str, width: float, drawn: float, left_out: float) -> QPen:
    pen = QPen(QColor(colour), width)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    pen.setDashPattern([drawn / width, left_out / width])
    return pen


def paint_key(
    painter: QPainter, centre: QPointF, *, passed: bool, chosen: bool, hovered: bool, dim: bool
) -> None:
    """Draw a key's diamond, or a disc where the motion passes through it.

    The chosen one is larger, ringed and in the selection's colour.
    """
    c = colours()
    size = KEY + (1.5 if chosen else 0.0) + (1.0 if hovered else 0.0)
    painter.setPen(QPen(QColor(c.window if not chosen else c.text), 1.5))
    painter.setBrush(QColor(c.selection if chosen else c.disabled if dim else c.text))
    if passed:
        painter.drawEllipse(centre, DISC * size, DISC * size)
        return
    x, y = centre.x(), centre.y()
    corners = [(x, y - size), (x + size, y), (x, y + size), (x - size, y)]
    painter.drawPolygon(QPolygonF([QPointF(*corner) for corner in corners]))
