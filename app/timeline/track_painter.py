"""Paints the rows of the tracks."""

from __future__ import annotations

from math import ceil, floor

from PySide6.QtCore import QCoreApplication, QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from app.style import colours
from app.timeline import painting
from app.timeline.badge import ROOM, paint_badge
from app.timeline.rows import ROW, Place, Rows
from app.timeline.scale import LABEL_ROOM, multiples, step_for
from app.verdict import troubled_frames
from app.workspace import Workspace
from core.model import Layer

MIDDLE = 14.0
"""Where in a row keys and spans lie."""
BAND = 25.0
"""Where in a row the band of the state begins."""


def paint_tracks(
    painter: QPainter, workspace: Workspace, rows: Rows, hovered: Place | None, exposed: QRect
) -> None:
    """Paint the exposed part of all rows."""
    painter.fillRect(exposed, QColor(colours().base))
    _paint_out_of_range(painter, workspace, rows, exposed)
    _paint_grid(painter, rows, exposed, workspace.playhead.lowest)
    for row, layer in enumerate(rows.layers()):
        top = float(row * ROW)
        if exposed.top() <= top + ROW and top <= exposed.bottom():
            _paint_row(painter, workspace, rows, layer, top, exposed)
            _paint_keys(painter, workspace, rows, layer, top, hovered)
    if not rows.document.layers:
        painter.setPen(QColor(colours().muted))
        text = QCoreApplication.translate("Timeline", "The keyframes of what you draw appear here.")
        painter.drawText(painter.viewport(), Qt.AlignmentFlag.AlignCenter, text)


def _paint_grid(painter: QPainter, rows: Rows, exposed: QRect, lowest: int) -> None:
    """Draw a faint line at each frame that the ruler names."""
    first = floor(rows.scale.frame(exposed.left()))
    last = ceil(rows.scale.frame(exposed.right()))
    painter.setPen(QPen(QColor(colours().window), 1))
    for frame in multiples(first, last, step_for(rows.scale.pixels, LABEL_ROOM), lowest):
        x = rows.scale.x(frame)
        painter.drawLine(QPointF(x, exposed.top()), QPointF(x, exposed.bottom() + 1))


def _paint_row(
    painter: QPainter, workspace: Workspace, rows: Rows, layer: Layer, top: float, exposed: QRect
) -> None:
    c, current = colours(), workspace.selection.layer is layer
    if current:
        tint = QColor(c.accent)
        tint.setAlphaF(0.13)
        painter.fillRect(QRectF(exposed.left(), top, exposed.width(), ROW - 1), tint)
    painter.setPen(QPen(QColor(c.line), 1))
    line = top + ROW - 0.5
    painter.drawLine(QPointF(exposed.left(), line), QPointF(exposed.right() + 1, line))
    for index in range(layer.spans):
        source, target = layer.keyframes[index : index + 2]
        left, right = rows.scale.x(source.frame), rows.scale.x(target.frame)
        if right < exposed.left() or left > exposed.right():
            continue
        bar = QRectF(left, top + MIDDLE - painting.BAR / 2, right - left, painting.BAR)
        painting.paint_span(painter, bar, layer, hold=source.easing.hold, current=current)
        state = workspace.solver.state(layer.id, index)
        band = _visible(QRectF(left + 1, top + BAND, right - left - 2, painting.BAND), exposed)
        painting.paint_state(painter, band, state)
        troubled = troubled_frames(workspace.inspector.check(layer.id, index))
        painting.paint_troubled(painter, band, [rows.scale.x(frame) for frame in troubled])
        if layer.visible and bar.width() >= ROOM:
            paint_badge(painter, bar.center(), workspace.inspector.standing(layer.id, index))


def _visible(band: QRectF, exposed: QRect) -> QRectF:
    """Cut a band to what is exposed, so that its pattern stays where it was."""
    hidden = max((exposed.left() - band.left()) // painting.PERIOD, 0) * painting.PERIOD
    return QRectF(
        band.left() + hidden,
        band.top(),
        min(band.right(), exposed.right() + painting.PERIOD) - band.left() - hidden,
        band.height(),
    )


def _paint_keys(
    painter: QPainter,
    workspace: Workspace,
    rows: Rows,
    layer: Layer,
    top: float,
    hovered: Place | None,
) -> None:
    current = workspace.selection.layer is layer
    for index, key in enumerate(layer.keyframes):
        painting.paint_key(
            painter,
            QPointF(rows.scale.x(key.frame), top + MIDDLE),
            passed=layer.passes(index),
            chosen=current and workspace.selection.key == index,
            hovered=hovered == (layer.id, index),
            dim=layer.locked or not layer.visible,
        )


def _paint_out_of_range(
    painter: QPainter, workspace: Workspace, rows: Rows, exposed: QRect
) -> None:
    """Darken what is not played."""
    if not workspace.playhead.limited:
        return
    start, end = (rows.scale.x(frame) for frame in workspace.playhead.range)
    veil = QColor(colours().line)
    veil.setAlphaF(0.55)
    area = QRectF(exposed)
    painter.fillRect(area.intersected(QRectF(-1e6, area.top(), start + 1e6, area.height())), veil)
    painter.fillRect(area.intersected(QRectF(end, area.top(), 1e6, area.height())), veil)
