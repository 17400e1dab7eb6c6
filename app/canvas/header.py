"""The title of a pane: which side it is, and whether what it shows is up to date."""

from __future__ import annotations

from html import escape

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QWidget

from app.style import Colours, colours

LINE, FOCUSED_LINE = 1, 2
"""Pixels of the coloured line under the title, thicker where the keys go."""


class Header(QWidget):
    """A bold name, the details, a tag at the right, and a line in the colour of the side."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._title, self._tag = QLabel(self), QLabel(self)
        self._title.setTextFormat(Qt.TextFormat.RichText)
        self._title.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        row = QHBoxLayout(self)
        row.setContentsMargins(10, 5, 10, 7)
        row.addWidget(self._title, 1)
        row.addWidget(self._tag, 0)
        self._tint, self._focused = "", False
        self._shown: tuple[str, str, str, str, Colours] | None = None

    @property
    def tag(self) -> str:
        """What is said about the state."""
        return self._tag.text()

    def show_title(self, name: str, details: str, tag: str, tint: str) -> None:
        """Set the words, and the colour of the line and of the dot before the name."""
        c = colours()
        if (name, details, tag, tint, c) == self._shown:
            return
        self._shown = (name, details, tag, tint, c)
        self._title.setText(
            f'<span style="color:{tint}">●</span>&nbsp; <b>{escape(name)}</b>'
            f'<span style="color:{c.muted}">&nbsp; {escape(details)}</span>'
        )
        self._tag.setText(tag)
        self._tag.setStyleSheet(
            f"color: {c.text}; background: {c.hover}; border-radius: 7px; padding: 0 7px;"
        )
        self._tag.setVisible(bool(tag))
        self._tint = tint
        self.update()

    def set_focused(self, focused: bool) -> None:
        """Show that the keys go to this pane."""
        self._focused = focused
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the line."""
        height = FOCUSED_LINE if self._focused else LINE
        colour = QColor(self._tint)
        colour.setAlphaF(1.0 if self._focused else 0.45)
        line = QRect(0, self.height() - height, self.width(), height)
        QPainter(self).fillRect(line, colour)
