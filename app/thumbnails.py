"""Small pictures of outlines and of whole documents, for lists to choose from."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPixmap

from app.render.painter import brush_of, colour, outline_path, pen_of
from app.style import RADIUS, colours
from core.geometry.flatten import flatten
from core.model import Document, Outline, Style
from core.model.outline import Array

PAPER, CONTRAST = "#ffffff", "#6b7280"
PALE = 0.8
"""Lighter than this, a fill would not show on paper."""
MARGIN = 0.1
"""Free space at each side, as a part of the picture."""


def outline_thumbnail(outline: Outline, style: Style, size: QSize, ratio: float = 1.0) -> QPixmap:
    """Draw an outline as large as it fits."""
    rings = _rings(outline)
    pale = style.fill and colour(style.fill).lightnessF() > PALE
    image, painter = _sheet(size, ratio, CONTRAST if pale else PAPER)
    _aim(painter, size, [rings])
    _paint(painter, rings, style)
    painter.end()
    return image


def document_thumbnail(document: Document, size: QSize, ratio: float = 1.0) -> QPixmap:
    """Draw what every layer ends as, as much of it as was drawn on."""
    image, painter = _sheet(size, ratio, document.background)
    last = [
        (_rings(layer.keyframes[-1].outline), layer.style)
        for layer in document.layers
        if layer.visible
    ]
    if last:
        _aim(painter, size, [rings for rings, _ in last])
    for rings, style in last:
        _paint(painter, rings, style)
    painter.end()
    return image


def _rings(outline: Outline) -> tuple[Array, ...]:
    return tuple(polyline.points for polyline in flatten(outline, 1e-3))


def _sheet(size: QSize, ratio: float, ground: str) -> tuple[QPixmap, QPainter]:
    image = QPixmap(size * ratio)
    image.setDevicePixelRatio(ratio)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour(ground) if ground else QColor(colours().pasteboard))
    painter.drawRoundedRect(0, 0, size.width(), size.height(), RADIUS, RADIUS)
    return image, painter


def _aim(painter: QPainter, size: QSize, shapes: Sequence[tuple[Array, ...]]) -> None:
    """Map the bounds of the shapes to the middle of the picture."""
    points = np.concatenate([ring for rings in shapes for ring in rings])
    low, high = points.min(axis=0), points.max(axis=0)
    extent = np.maximum(high - low, 1e-12)
    room = (1 - 2 * MARGIN) * np.array([size.width(), size.height()])
    scale = float((room / extent).min())
    painter.translate(QPointF(size.width(), size.height()) / 2)
    painter.scale(scale, scale)
    painter.translate(-QPointF(*(low + high)) / 2)


def _paint(painter: QPainter, rings: tuple[Array, ...], style: Style) -> None:
    pen = pen_of(style)
    pen.setCosmetic(True)
    pen.setWidthF(1.0)
    painter.setPen(pen)
    painter.setBrush(brush_of(style))
    painter.drawPath(outline_path(rings))
