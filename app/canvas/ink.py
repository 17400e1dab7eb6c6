"""The strokes that overlays and tools share: halos, nodes, handles, rings, tags."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen, QPixmap

from app.canvas.view import View
from app.style import colours
from core.geometry.places import measured
from core.model import Outline
from core.model.outline import Array

HALO = QColor("#ffffff")
NODE = 4.0
"""Half the side of a node's square, in pixels."""
TAG_WIDTH = 320
"""Pixels beyond which a tag breaks into lines."""


def pen(
    colour: str | QColor, width: float = 1.5, style: Qt.PenStyle = Qt.PenStyle.SolidLine
) -> QPen:
    """Return a pen with round joins."""
    return QPen(QColor(colour), width, style, Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin)


def draw_line(
    painter: QPainter,
    points: Array,
    colour: str,
    *,
    closed: bool = False,
    halo: bool = True,
    style: Qt.PenStyle = Qt.PenStyle.SolidLine,
    width: float = 1.5,
) -> None:
    """Draw a polyline (n, 2), on a light halo that shows it on any artwork.

    Solid lines are drawn segment by segment, which paints ten times as fast as one long stroke.
    """
    if len(points) < 2:
        return
    corners = [QPointF(x, y) for x, y in points.tolist()]
    corners += corners[:1] if closed else []
    segments = [QLineF(a, b) for a, b in pairwise(corners)]
    painter.setBrush(Qt.BrushStyle.NoBrush)
    if halo:
        painter.setPen(_segment_pen(HALO, width + 2))
        painter.drawLines(segments)
    if style is Qt.PenStyle.SolidLine:
        painter.setPen(_segment_pen(colour, width))
        painter.drawLines(segments)
    else:
        painter.setPen(pen(colour, width, style))
        painter.drawPolyline(corners)


def _segment_pen(colour: str | QColor, width: float) -> QPen:
    """Return an opaque pen whose segments meet without a gap."""
    return QPen(QColor(colour), width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.SquareCap)


def draw_outline(painter: QPainter, view: View, outline: Outline, colour: str) -> None:
    """Draw all rings of an outline, given in the document."""
    for measure in measured(outline):
        draw_line(painter, view.to_screen(measure.polyline.points), colour, closed=True)


def draw_nodes(
    painter: QPainter,
    centres: Array,
    colour: str,
    *,
    smooth: bool = False,
    selected: bool = False,
    size: float = NODE,
) -> None:
    """Draw nodes (n, 2): squares for corners, discs where the curve passes smoothly.

    They are stamped, on whole device pixels: sharp, and ten times as fast as stroking each.
    """
    ratio = painter.device().devicePixelRatioF()
    fill = colours().selection if selected else "#ffffff"
    stamp = _stamp(colour, fill, smooth, size, ratio)
    corner = centres - stamp.width() / (2 * ratio)
    for x, y in (np.round(corner * ratio) / ratio).tolist():
        painter.drawPixmap(QPointF(x, y), stamp)


@lru_cache(maxsize=64)
def _stamp(line: str, fill: str, smooth: bool, size: float, ratio: float) -> QPixmap:
    """Return the picture of one node, for a screen of this pixel ratio."""
    side = 2 * math.ceil((size + 3) * ratio) + 1  # odd: the node's middle is a pixel's
    pixmap = QPixmap(side, side)
    pixmap.setDevicePixelRatio(ratio)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    middle = side / (2 * ratio)
    box = QRectF(middle - size, middle - size, 2 * size, 2 * size)
    for ink, brush in ((pen(HALO, 3.6), Qt.BrushStyle.NoBrush), (pen(line, 1.6), QColor(fill))):
        painter.setPen(ink)
        painter.setBrush(brush)
        (painter.drawEllipse if smooth else painter.drawRect)(box)
    painter.end()
    return pixmap


def draw_ring(painter: QPainter, at: Array, radius: float, colour: str, width: float = 2.0) -> None:
    """Draw a circle around a place."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(pen(HALO, width + 2))
    painter.drawEllipse(QPointF(*at), radius, radius)
    painter.setPen(pen(colour, width))
    painter.drawEllipse(QPointF(*at), radius, radius)


def draw_tag(painter: QPainter, at: QPointF, text: str, ground: str, ink: str) -> None:
    """Draw text on a rounded ground, its first line on a point, and kept inside the view."""
    font = QFont(painter.font())
    font.setBold(True)
    metrics = QFontMetricsF(font)
    view = QRectF(painter.viewport()).adjusted(6, 6, -6, -6)
    flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
    room = QRectF(0, 0, min(view.width(), TAG_WIDTH) - 20, view.height())
    box = metrics.boundingRect(room, flags, text).adjusted(-8, -3, 8, 3)
    box.moveCenter(at)
    box.moveTop(at.y() - metrics.height() / 2 - 3)
    box.moveLeft(min(max(box.left(), view.left()), view.right() - box.width()))
    box.moveTop(min(max(box.top(), view.top()), view.bottom() - box.height()))
    painter.setFont(font)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(ground))
    corner = metrics.height() / 2 + 3
    painter.drawRoundedRect(box, corner, corner)
    painter.setPen(QColor(ink))
    painter.drawText(box, flags, text)
