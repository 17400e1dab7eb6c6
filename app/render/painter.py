"""Shapes to pixels: the one way pictures are painted, on the canvas and into files."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QBrush, QColor, QImage, QPainter, QPainterPath, QPen, QPolygonF
from shiboken6 import VoidPtr

from core.errors import FileError
from core.model import Style
from core.model.outline import Array
from core.model.picture import Picture

DOTS_PER_METRE = 3780
"""96 dots per inch; said aloud, because Qt's own value depends on the screen."""


def colour(text: str) -> QColor:
    """Return a model colour: "#rrggbb", "#rrggbbaa" (Qt reads those as "#aarrggbb"), or ""."""
    if not text:
        return QColor(Qt.GlobalColor.transparent)
    return QColor(*bytes.fromhex(text[1:]))


def brush_of(style: Style) -> QBrush:
    """Return what fills a shape."""
    return QBrush(colour(style.fill)) if style.fill else QBrush(Qt.BrushStyle.NoBrush)


def pen_of(style: Style) -> QPen:
    """Return what strokes a shape, in document units."""
    if not style.stroke or style.stroke_width <= 0:
        return QPen(Qt.PenStyle.NoPen)
    return QPen(
        colour(style.stroke),
        style.stroke_width,
        Qt.PenStyle.SolidLine,
        Qt.PenCapStyle.RoundCap,
        Qt.PenJoinStyle.RoundJoin,
    )


def outline_path(rings: Sequence[Array]) -> QPainterPath:
    """Return closed polylines (k, 2) as one path, filled by the even-odd rule."""
    path = QPainterPath()
    path.setFillRule(Qt.FillRule.OddEvenFill)
    for ring in rings:
        path.addPolygon(_polygon(ring))
        path.closeSubpath()
    return path


def paint_picture(painter: QPainter, picture: Picture) -> None:
    """Paint the shapes of a picture in document coordinates; the background is not painted."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    for shape in picture.shapes:
        painter.setBrush(brush_of(shape.style))
        painter.setPen(pen_of(shape.style))
        painter.drawPath(outline_path(shape.rings))


def render_image(
    picture: Picture, size: tuple[int, int] | None = None, background: str | None = None
) -> QImage:
    """Return a picture as an image, fitted into a size in pixels with its proportions kept.

    Without a size it has the document's; without a background, the picture's own ("" is
    transparent). FileError when there is no memory for it.
    """
    width, height = picture.size
    pixels = size or (max(round(width), 1), max(round(height), 1))
    image = QImage(*pixels, QImage.Format.Format_ARGB32_Premultiplied)
    if image.isNull():
        raise FileError(
            f"An image of {pixels[0]} × {pixels[1]} pixels is too large.",
            hint="Choose a smaller size.",
        )
    image.setDotsPerMeterX(DOTS_PER_METRE)
    image.setDotsPerMeterY(DOTS_PER_METRE)
    image.fill(colour(picture.background if background is None else background))
    scale = min(pixels[0] / width, pixels[1] / height)
    painter = QPainter(image)
    painter.translate(QPointF(pixels[0] - scale * width, pixels[1] - scale * height) / 2)
    painter.scale(scale, scale)
    paint_picture(painter, picture)
    painter.end()
    return image


def _polygon(ring: Array) -> QPolygonF:
    """Copy points (k, 2) in one go; point by point takes a thousand times longer."""
    polygon = QPolygonF()
    polygon.resize(len(ring))
    memory = np.frombuffer(VoidPtr(polygon.data(), ring.nbytes, True), dtype=float)
    memory[:] = np.ascontiguousarray(ring, dtype=float).ravel()
    return polygon
