"""The ruler: frames, seconds, the playback range, and the head of the playhead."""

from __future__ import annotations

from math import ceil, floor

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.style import colours
from app.timeline.gestures import Gesture, RangeDrag, Scrub
from app.timeline.scale import LABEL_ROOM, multiples, step_for
from app.timeline.time_view import TimeView
from app.timeline.time_widget import TimeWidget
from app.workspace import Workspace

HEIGHT = 46
RANGE_HEIGHT = 14
REACH = 12
"""Pixels to either side within which a handle of the range is grabbed."""
TICK_ROOM, SECOND_ROOM = 5.0, 44.0
"""Pixels that a tick and a time need."""


class Ruler(TimeWidget):
    """Scrubs where it is pressed; the strip along its top is the playback range."""

    def __init__(self, workspace: Workspace, view: TimeView, parent: QWidget | None = None) -> None:
        super().__init__(workspace, view, parent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(self.tr("Ruler"))
        self.setToolTip(
            self.tr(
                "Drag to scrub, with Shift between frames\n"
                "Drag the handles at the top to limit playback\n"
                "Wheel zooms, middle button pans, double click shows everything"
            )
        )

    def sizeHint(self) -> QSize:
        """Return the height of three lines."""
        return QSize(400, HEIGHT)

    def minimumSizeHint(self) -> QSize:
        """Return the least width that is of use."""
        return QSize(120, HEIGHT)

    # -- what the mouse does -------------------------------------------------------------------

    def begin(self, event: QMouseEvent) -> Gesture:
        """Grab a handle of the range, or scrub."""
        x = event.position().x()
        handle = self._handle_at(event.position())
        if handle is not None:
            return RangeDrag(self.workspace, self.view, handle)
        scrub = Scrub(self.workspace, self.view)
        scrub.move(x, event.modifiers())
        return scrub

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Show what a press would grab."""
        super().mouseMoveEvent(event)
        if not self.dragging:
            over = self._handle_at(event.position()) is not None
            self.setCursor(Qt.CursorShape.SizeHorCursor if over else Qt.CursorShape.ArrowCursor)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Show everything; on the strip, play everything again."""
        if event.button() == Qt.MouseButton.LeftButton:
            if event.position().y() <= RANGE_HEIGHT:
                self.workspace.playhead.set_range(None)
            self.view.fit()

    def _handle_at(self, position: QPointF) -> int | None:
        """Return which end of the range is under the mouse: 0, 1 or None."""
        if position.y() > RANGE_HEIGHT:
            return None
        away = [abs(self.view.scale.x(f) - position.x()) for f in self.workspace.playhead.range]
        nearest = 1 if away[1] <= away[0] else 0
        return nearest if away[nearest] <= REACH else None

    # -- painting ------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint what lies in the exposed part of time."""
        scale = self.view.scale
        first = floor(scale.frame(event.rect().left() - LABEL_ROOM))
        last = ceil(scale.frame(event.rect().right() + LABEL_ROOM))
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.fillRect(event.rect(), QColor(colours().window))
            self._paint_range(painter)
            self._paint_frames(painter, first, last)
            self._paint_seconds(painter, first, last)
            self._paint_head(painter)

    def _paint_range(self, painter: QPainter) -> None:
        c = colours()
        start, end = (self.view.scale.x(frame) for frame in self.workspace.playhead.range)
        limited = self.workspace.playhead.limited
        strip = QRectF(0, 3, self.width(), RANGE_HEIGHT - 6)
        painter.fillRect(strip, QColor(c.base))
        tint = QColor(c.accent if limited else c.disabled)
        tint.setAlphaF(0.55 if limited else 0.35)
        painter.fillRect(QRectF(start, strip.top(), end - start, strip.height()), tint)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(c.accent if limited else c.muted))
        for x, inward in ((start, 1), (end, -1)):
            painter.drawRoundedRect(
                QRectF(min(x, x + 6 * inward), 1, 6, RANGE_HEIGHT - 2), 2.0, 2.0
            )

    def _paint_frames(self, painter: QPainter, first: int, last: int) -> None:
        c, scale = colours(), self.view.scale
        step, tick = step_for(scale.pixels, LABEL_ROOM), step_for(scale.pixels, TICK_ROOM)
        lowest, base = self.workspace.playhead.lowest, self.height() - 1
        painter.setPen(QPen(QColor(c.disabled), 1))
        for frame in multiples(first, last, tick, lowest):
            painter.drawLine(QPointF(scale.x(frame), base), QPointF(scale.x(frame), base - 4))
        painter.setFont(self._font(-1.0))
        for frame in multiples(first, last, step, lowest):
            x = scale.x(frame)
            painter.setPen(QPen(QColor(c.muted), 1))
            painter.drawLine(QPointF(x, base), QPointF(x, base - 7))
            painter.setPen(QColor(c.text))
            box = QRectF(x - LABEL_ROOM / 2, base - 21, LABEL_ROOM, 14)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, str(frame))
        painter.setPen(QPen(QColor(c.line), 1))
        painter.drawLine(QPointF(0, base + 0.5), QPointF(self.width(), base + 0.5))

    def _paint_seconds(self, painter: QPainter, first: int, last: int) -> None:
        """Write the time of whole seconds, from the first frame, beside where a playhead goes."""
        fps, origin = self.workspace.session.document.fps, self.workspace.playhead.lowest
        step = step_for(self.view.scale.pixels * fps, SECOND_ROOM)
        painter.setPen(QColor(colours().muted))
        painter.setFont(self._font(-2.0))
        until = floor((last - origin) / fps)
        for second in multiples(floor((first - origin) / fps), until, step, 0):
            x = self.view.scale.x(origin + second * fps)
            box = QRectF(x + 4, RANGE_HEIGHT - 2, SECOND_ROOM, 12)
            painter.drawText(box, Qt.AlignmentFlag.AlignVCenter, self.tr("{} s").format(second))

    def _paint_head(self, painter: QPainter) -> None:
        """Draw the head of the playhead, with its frame."""
        frame = self.workspace.playhead.frame
        text = f"{frame:.2f}".rstrip("0").rstrip(".")
        font = self._font(-1.0)
        font.setBold(True)
        painter.setFont(font)
        half = max(painter.fontMetrics().horizontalAdvance(text) / 2 + 6, 12.0)
        x, top, bottom = self.view.scale.x(frame), self.height() - 24.0, self.height() - 7.0
        self.paint_playhead(painter)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(colours().accent))
        painter.drawRoundedRect(QRectF(x - half, top, 2 * half, bottom - top), 3.0, 3.0)
        tip = [QPointF(x - 5, bottom), QPointF(x + 5, bottom), QPointF(x, self.height() - 1)]
        painter.drawPolygon(QPolygonF(tip))
        painter.setPen(QColor(colours().on_accent))
        box = QRectF(x - half, top, 2 * half, bottom - top)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)

    def _font(self, larger: float) -> QFont:
        font = QFont(self.font())
        font.setPointSizeF(max(font.pointSizeF() + larger, 7.0))
        return font
