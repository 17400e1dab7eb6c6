"""A few friendly words in a pane that has nothing to show yet."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from app.canvas.ink import pen
from app.canvas.overlay import Overlay
from app.canvas.view import View
from app.render.painter import colour
from app.style import colours

WIDTH, HEIGHT = 290.0, 116.0
INK_ON_LIGHT, INK_ON_DARK = "#3c4450", "#dfe4ec"


class Invitation(Overlay):
    """A dashed card in the colour of the artboard, so that it reads as part of it."""

    def __init__(self, view: View) -> None:
        super().__init__(view)
        self.title, self._advice, self._ground = "", "", QColor()

    def show_text(self, title: str, advice: str, background: str) -> None:
        """Set what it says, on a background of the document; empty texts hide it."""
        self.title, self._advice = title, advice
        self._ground = colour(background) if background else QColor(colours().base)
        self._ground.setAlpha(235)

    def make_room(self, drawing: bool) -> None:
        """Hide while something is being drawn, or when there is nothing to say."""
        self.setVisible(bool(self.title) and not drawing)

    def draw(self, painter: QPainter) -> None:
        """Paint the card with the words in the middle."""
        view = self.boundingRect()
        card = QRectF(0, 0, min(WIDTH, view.width() - 20), min(HEIGHT, view.height() - 20))
        card.moveCenter(view.center())
        ink = QColor(INK_ON_LIGHT if self._ground.lightnessF() > 0.5 else INK_ON_DARK)
        faint = QColor(ink)
        faint.setAlphaF(0.75)
        painter.setBrush(self._ground)
        painter.setPen(pen(faint, 1.2, Qt.PenStyle.DashLine))
        painter.drawRoundedRect(card, 8, 8)
        words, half = card.adjusted(12, 10, -12, -10), card.height() * 0.42
        flags = Qt.AlignmentFlag.AlignHCenter | Qt.TextFlag.TextWordWrap
        font = painter.font()
        font.setBold(True)
        painter.setFont(font)
        painter.setPen(ink)
        title = QRectF(words.left(), words.top(), words.width(), half)
        painter.drawText(title, flags | Qt.AlignmentFlag.AlignBottom, self.title)
        font.setBold(False)
        painter.setFont(font)
        painter.setPen(faint)
        painter.drawText(words.adjusted(0, half + 6, 0, 0), flags, self._advice)
