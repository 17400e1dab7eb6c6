"""Labelled pictures in a row: how figures and sweeps show what they found."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QGuiApplication, QImage, QPainter, QPen

from app.render.painter import outline_path

INK, PAPER, FILL, FOLD, GRID = "#1b2a41", "#ffffff", "#bcd7f2", "#ff2d7a", "#6f9fcf"
TITLE = 26


@dataclass(frozen=True, eq=False)
class Panel:
    """One shape: its boundary, and its mesh if ``triangles`` are given."""

    title: str
    points: np.ndarray
    rings: Sequence[np.ndarray]
    triangles: np.ndarray | None = None
    folded: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=int))
    dots: np.ndarray = field(default_factory=lambda: np.zeros((0, 2)))
    rainbow: bool = False
    """Whether hues run along the rings, so that panels show which places correspond."""


def draw_row(panels: Sequence[Panel], side: int = 220, *, same_scale: bool = True) -> QImage:
    """Return the panels side by side; with ``same_scale`` all share one scale."""
    spans = [max(np.ptp(panel.points, axis=0).max(), 1e-9) for panel in panels]
    image = QImage(side * len(panels), side + TITLE, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(QColor(PAPER))
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    for i, (panel, span) in enumerate(zip(panels, spans, strict=True)):
        painter.save()
        painter.translate(i * side, 0)
        painter.setPen(QColor(INK))
        painter.setFont(QFont("sans-serif", 9))
        painter.drawText(QRectF(0, 4, side, TITLE), Qt.AlignmentFlag.AlignCenter, panel.title)
        painter.translate(side / 2, TITLE + side / 2)
        _draw(painter, panel, 0.86 * side / (max(spans) if same_scale else span))
        painter.restore()
    painter.end()
    return image


def stack(rows: Sequence[QImage]) -> QImage:
    """Return rows below each other."""
    width, height = max(row.width() for row in rows), sum(row.height() for row in rows)
    image = QImage(width, height, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(QColor(PAPER))
    painter = QPainter(image)
    y = 0
    for row in rows:
        painter.drawImage(0, y, row)
        y += row.height()
    painter.end()
    return image


def save(image: QImage, path: Path) -> None:
    """Write a PNG, making its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not image.save(str(path)):
        raise OSError(f"cannot write {path}")


def application() -> QGuiApplication:
    """Return the running application; text needs one."""
    return QGuiApplication.instance() or QGuiApplication([])  # type: ignore[return-value]


def _draw(painter: QPainter, panel: Panel, scale: float) -> None:
    centre = (panel.points.min(axis=0) + panel.points.max(axis=0)) / 2
    points = scale * (panel.points - centre)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(FILL))
    painter.drawPath(outline_path([points[ring] for ring in panel.rings]))
    if panel.triangles is not None:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(GRID), 0.5))
        for corners in points[panel.triangles]:
            painter.drawPolyline([QPointF(*corner) for corner in corners])
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(FOLD))
        for corners in points[panel.triangles[panel.folded]]:
            painter.drawPolygon([QPointF(*corner) for corner in corners])
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for ring in panel.rings:
        _draw_ring(painter, points[ring], rainbow=panel.rainbow)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(FOLD))
    for dot in scale * (panel.dots - centre) if len(panel.dots) else ():
        painter.drawEllipse(QPointF(*dot), 3, 3)


def _draw_ring(painter: QPainter, ring: np.ndarray, *, rainbow: bool) -> None:
    corners = [QPointF(*point) for point in ring]
    painter.setPen(QPen(QColor(INK), 1.2))
    for k, edge in enumerate(itertools.pairwise([*corners, corners[0]])):
        if rainbow:
            painter.setPen(QPen(QColor.fromHsvF(k / len(corners), 1, 0.85), 3))
        painter.drawLine(QLineF(*edge))
