"""A colour to pick or type, with alpha, or none at all."""

from __future__ import annotations

import re

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import (
    QAbstractButton,
    QColorDialog,
    QHBoxLayout,
    QLineEdit,
    QToolButton,
    QWidget,
)

from app.icons import set_icon
from app.render.painter import colour
from app.style import RADIUS, TARGET_SIZE, colours

CHECK = 5
"""Pixels of a square of the chequered ground that shows through alpha."""


class ColourField(QWidget):
    """A swatch that opens a picker, the colour as text, and a button for none.

    While the picker is open, every colour tried is told by ``edited``, between ``opened`` and
    ``closed``; what is typed, and none, is told by ``edited`` alone.
    """

    opened = Signal()
    edited = Signal(str)
    """A model colour: "#rrggbb", "#rrggbbaa", or an empty string for none."""
    closed = Signal(bool)
    """Whether the colour picked is to be kept."""

    def __init__(self, name: str, parent: QWidget | None = None, *, optional: bool = True) -> None:
        """Make one; unless ``optional``, there is always a colour."""
        super().__init__(parent)
        self._name, self._colour, self._last = name, "", "#808080"
        self._optional = optional
        self._swatch = Swatch()
        self._swatch.setAccessibleName(self.tr("{}: pick a colour").format(name))
        self._swatch.setToolTip(self.tr("Pick a colour"))
        self._swatch.clicked.connect(self._pick)
        self._text = QLineEdit(maxLength=9)
        self._text.setAccessibleName(self.tr("{}: colour as #rrggbb or #rrggbbaa").format(name))
        self._text.setPlaceholderText(self.tr("none"))
        self._text.setMinimumSize(40, TARGET_SIZE)
        self._text.editingFinished.connect(self._take_text)
        self._none = QToolButton(autoRaise=True, checkable=True)
        set_icon(self._none, "none")
        self._none.setMinimumSize(TARGET_SIZE, TARGET_SIZE)
        self._none.setAccessibleName(self.tr("{}: none").format(name))
        self._none.setToolTip(self.tr("None"))
        self._none.setVisible(optional)
        self._none.clicked.connect(self._toggle_none)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(4)
        row.addWidget(self._swatch)
        row.addWidget(self._text, 1)
        row.addWidget(self._none)
        self.setFocusProxy(self._text)

    def show_value(self, value: str) -> None:
        """Show a model colour; nothing is emitted."""
        if value:
            self._last = value
        if value != self._colour or not self._text.hasFocus():
            self._text.setText(value)
        self._colour = value
        self._none.setChecked(not value)
        self._swatch.show_colour(value)

    def _take_text(self) -> None:
        value = parse(self._text.text())
        if value is not None and value != self._colour and (value or self._optional):
            self.edited.emit(value)
        self._text.setText(self._colour)

    def _toggle_none(self) -> None:
        self.edited.emit("" if self._colour else self._last)
        self._none.setChecked(not self._colour)

    def _pick(self) -> None:
        """Open the picker; it is not waited for."""
        picker = QColorDialog(self)
        picker.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        picker.setWindowTitle(self._name)
        picker.setOption(QColorDialog.ColorDialogOption.ShowAlphaChannel)
        picker.setOption(QColorDialog.ColorDialogOption.DontUseNativeDialog)
        picker.setCurrentColor(colour(self._last))
        picker.currentColorChanged.connect(self._try)
        picker.finished.connect(self._finish)
        self.opened.emit()
        picker.open()

    def _try(self, tried: QColor) -> None:
        self.edited.emit(written(tried))

    def _finish(self, result: int) -> None:
        self.closed.emit(bool(result))


class Swatch(QAbstractButton):
    """A button that shows a colour on a chequered ground, or a stroke through it for none."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._colour = ""
        self.setFixedSize(TARGET_SIZE, TARGET_SIZE)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)

    def sizeHint(self) -> QSize:
        """Return the size of a target."""
        return QSize(TARGET_SIZE, TARGET_SIZE)

    def show_colour(self, value: str) -> None:
        """Show a model colour."""
        self._colour = value
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint it, and a ring around it while it has the focus."""
        c = colours()
        box = QRectF(self.rect()).adjusted(2.5, 2.5, -2.5, -2.5)
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            if self._colour:
                paint_colour(painter, box, self._colour)
            else:
                painter.fillRect(box, QColor(c.base))
                painter.setPen(QPen(QColor(c.error), 1.5))
                painter.drawLine(box.bottomLeft(), box.topRight())
            ringed = self.hasFocus() or self.underMouse()
            painter.setPen(QPen(QColor(c.accent if ringed else c.disabled), 1.2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRoundedRect(box, RADIUS - 2, RADIUS - 2)


def paint_colour(painter: QPainter, box: QRectF, value: str) -> None:
    """Fill a box with a model colour, over a chequered ground where it is not opaque."""
    shown = colour(value)
    if shown.alpha() < 255:
        painter.fillRect(box, Qt.GlobalColor.white)
        for row in range(int(box.height() / CHECK) + 1):
            for column in range(row % 2, int(box.width() / CHECK) + 1, 2):
                corner = box.topLeft() + QPointF(column * CHECK, row * CHECK)
                square = QRectF(corner, corner + QPointF(CHECK, CHECK)).intersected(box)
                painter.fillRect(square, Qt.GlobalColor.lightGray)
    painter.fillRect(box, shown)


def parse(text: str) -> str | None:
    """Return typed text as a model colour; None if it is none. The # may be left out."""
    digits = text.strip().lower().removeprefix("#")
    if digits in ("", "none"):
        return ""
    if re.fullmatch("[0-9a-f]{3}", digits):
        digits = "".join(2 * digit for digit in digits)
    if not re.fullmatch("[0-9a-f]{6}([0-9a-f]{2})?", digits):
        return None
    return f"#{digits.removesuffix('ff') if len(digits) == 8 else digits}"


def written(value: QColor) -> str:
    """Return a colour as the model writes it."""
    alpha = f"{value.alpha():02x}" if value.alpha() < 255 else ""
    return value.name(QColor.NameFormat.HexRgb) + alpha
