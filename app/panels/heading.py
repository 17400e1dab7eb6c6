"""The heading of a section: a bar that folds away what is below it."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy, QWidget

from app.style import TARGET_SIZE, colours


class Heading(QAbstractButton):
    """Checked while the section is open."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent, checkable=True, checked=True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        font = self.font()
        font.setBold(True)
        self.setFont(font)
        self.setToolTip(self.tr("Fold away, or unfold"))

    def sizeHint(self) -> QSize:
        """Return the height of a target; any width will do."""
        return QSize(100, TARGET_SIZE)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the bar, an arrow, and as much of the text as there is room for."""
        c, middle = colours(), self.height() / 2
        lit = self.underMouse() or self.hasFocus()
        room = self.rect().adjusted(24, 0, -8, 0)
        text = self.fontMetrics().elidedText(self.text(), Qt.TextElideMode.ElideRight, room.width())
        down, right = ((-4, -2), (0, 2), (4, -2)), ((-2, -4), (2, 0), (-2, 4))
        arrow = down if self.isChecked() else right
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.fillRect(self.rect(), QColor(c.hover if lit else c.raised))
            painter.setPen(QPen(QColor(c.muted), 1.6))
            painter.drawPolyline([QPointF(13 + x, middle + y) for x, y in arrow])
            painter.setPen(QColor(c.text))
            painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)
            if self.hasFocus():
                painter.setPen(QPen(QColor(c.accent), 1))
                painter.drawRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5))
