"""The timing curve of a span, with two handles to drag."""

from __future__ import annotations

from dataclasses import astuple, replace

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.style import RADIUS, colours
from core.model import Easing
from core.model.easing import LINEAR

LOWEST, HIGHEST = -0.6, 1.6
"""How far the curve may overshoot, in progress."""
SHOWN = (-0.25, 1.25)
"""How much progress is shown; handles beyond it lie on the edge."""
REACH = 16.0
"""Pixels within which a handle is grabbed."""
STEP, FINE = 0.05, 0.01
"""What an arrow key moves a handle by, and with Shift."""


class EasingEditor(QWidget):
    """Time runs to the right, progress upwards. A drag is told between ``began`` and ``ended``."""

    began = Signal()
    edited = Signal(object)
    """The Easing as it would be; outside of a drag, a step of the keyboard."""
    ended = Signal(bool)
    """Whether the drag is to be kept."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._easing = LINEAR
        self._time: float | None = None
        self._handle = 0
        self._dragging = False
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(self.tr("Easing curve"))
        self.setToolTip(
            self.tr("Drag the handles\nArrow keys move the one in use, Space takes the other")
        )

    def sizeHint(self) -> QSize:
        """Return a size at which the curve can be judged."""
        return QSize(200, 150)

    def show_value(self, easing: Easing) -> None:
        """Show an easing; nothing is emitted."""
        if easing != self._easing:
            self._easing = easing
            values = (f"{value:.2f}" for value in astuple(easing)[:4])
            self.setAccessibleDescription(self.tr("Hold") if easing.hold else ", ".join(values))
            self.update()

    def show_time(self, t: float | None) -> None:
        """Mark a time t ∈ [0, 1] on the curve, or none."""
        if t != self._time:
            self._time = t
            self.update()

    # -- where things are ----------------------------------------------------------------------

    def _plot(self) -> QRectF:
        return QRectF(self.rect()).adjusted(14, 10, -14, -10)

    def position(self, t: float, s: float) -> QPointF:
        """Return the pixel of a time and a progress."""
        plot, (low, high) = self._plot(), SHOWN
        s = min(max(s, low), high)
        x = plot.left() + t * plot.width()
        return QPointF(x, plot.bottom() - (s - low) / (high - low) * plot.height())

    def handle(self, index: int) -> QPointF:
        """Return the pixel of a handle: 0 of the start, 1 of the end."""
        e = self._easing
        return self.position(e.x1, e.y1) if index == 0 else self.position(e.x2, e.y2)

    # -- mouse and keyboard --------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take the nearer handle, if it is in reach."""
        if event.button() != Qt.MouseButton.LeftButton or self._easing.hold:
            return
        away = [_distance(self.handle(i), event.position()) for i in (0, 1)]
        nearest = 0 if away[0] < away[1] else 1
        if away[nearest] <= REACH:
            self._handle, self._dragging = nearest, True
            self.began.emit()
            self.update()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move the handle."""
        if self._dragging:
            plot, (low, high) = self._plot(), SHOWN
            x = (event.position().x() - plot.left()) / plot.width()
            y = low + (plot.bottom() - event.position().y()) / plot.height() * (high - low)
            self._move_handle(x, y)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        self._end(keep=True)

    def event(self, event: QEvent) -> bool:
        """Keep the keys that move a handle from the window's shortcuts."""
        override = event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent)
        if override and self._meant(event):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the handle in use, or take the other."""
        if not self._meant(event):
            super().keyPressEvent(event)
        elif event.key() == Qt.Key.Key_Escape:
            self._end(keep=False)
        elif event.key() == Qt.Key.Key_Space:
            self._handle = 1 - self._handle
            self.update()
        else:
            shift = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            dx, dy = _ARROWS[Qt.Key(event.key())]
            step, e = FINE if shift else STEP, self._easing
            x, y = (e.x1, e.y1) if self._handle == 0 else (e.x2, e.y2)
            self._move_handle(x + step * dx, y + step * dy)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show which handle is in use."""
        super().focusInEvent(event)
        self.update()

    def _meant(self, event: QKeyEvent) -> bool:
        if event.key() == Qt.Key.Key_Escape:
            return self._dragging
        plain = not event.modifiers() & ~Qt.KeyboardModifier.ShiftModifier
        arrow = event.key() in _ARROWS or event.key() == Qt.Key.Key_Space
        return plain and arrow and not self._easing.hold

    def _move_handle(self, x: float, y: float) -> None:
        x, y = round(min(max(x, 0.0), 1.0), 3), round(min(max(y, LOWEST), HIGHEST), 3)
        changes = {"x1": x, "y1": y} if self._handle == 0 else {"x2": x, "y2": y}
        self.edited.emit(replace(self._easing, **changes))

    def _end(self, *, keep: bool) -> None:
        if self._dragging:
            self._dragging = False
            self.ended.emit(keep)

    # -- painting ------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the plot, the curve, and its handles."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            self._paint_ground(painter)
            self._paint_curve(painter)
            if not self._easing.hold and self.isEnabled():
                for index in (0, 1):
                    self._paint_handle(painter, index)
            if self._time is not None:
                here = self.position(self._time, self._easing(self._time))
                painter.setPen(QPen(QColor(colours().base), 1.5))
                painter.setBrush(QColor(colours().accent))
                painter.drawEllipse(here, 4.5, 4.5)

    def _paint_ground(self, painter: QPainter) -> None:
        c = colours()
        painter.setPen(QPen(QColor(c.accent if self.hasFocus() else c.line), 1))
        painter.setBrush(QColor(c.base))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), RADIUS, RADIUS)
        painter.setPen(QPen(QColor(c.hover), 1))
        unit = QRectF(self.position(0, 1), self.position(1, 0))
        for i in range(5):
            x, y = unit.left() + i * unit.width() / 4, unit.top() + i * unit.height() / 4
            painter.drawLine(QPointF(x, unit.top()), QPointF(x, unit.bottom()))
            painter.drawLine(QPointF(unit.left(), y), QPointF(unit.right(), y))

    def _paint_curve(self, painter: QPainter) -> None:
        e, path = self._easing, QPainterPath(self.position(0, 0))
        if e.hold:
            path.lineTo(self.position(1, 0))
            path.lineTo(self.position(1, 1))
        else:
            painter.setClipRect(self.rect().adjusted(1, 1, -1, -1))
            path.cubicTo(self._control(0), self._control(1), self.position(1, 1))
        painter.setPen(QPen(QColor(colours().text), 2.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPath(path)
        painter.setClipping(False)

    def _control(self, index: int) -> QPointF:
        """Return the true place of a handle, which may lie outside the plot."""
        e = self._easing
        t, s = (e.x1, e.y1) if index == 0 else (e.x2, e.y2)
        zero, one = self.position(0, 0), self.position(1, 1)
        return QPointF(zero.x() + t * (one.x() - zero.x()), zero.y() + s * (one.y() - zero.y()))

    def _paint_handle(self, painter: QPainter, index: int) -> None:
        c, end = colours(), self.position(index, index)
        place, in_use = self.handle(index), self.hasFocus() and index == self._handle
        painter.setPen(QPen(QColor(c.selection), 1.2))
        painter.drawLine(end, place)
        painter.setPen(QPen(QColor(c.text if in_use else c.base), 1.5))
        painter.setBrush(QColor(c.selection))
        painter.drawEllipse(place, 6.0, 6.0)


_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}


def _distance(a: QPointF, b: QPointF) -> float:
    return float((a - b).manhattanLength())
