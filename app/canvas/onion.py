"""Onion skin: the keyframes before and after, as tinted ghosts under what is being made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from app.canvas.artboard import EVERYWHERE
from app.render.painter import colour, outline_path
from app.workspace import ViewOptions
from core.geometry.flatten import flatten
from core.model import Keyframe, Outline

FILL_ALPHA = 0.14
BEFORE, AFTER = Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine
FAINTER = 0.55
"""How strongly each key farther away is shown, compared with the one before it."""


@dataclass(frozen=True)
class Ghost:
    """A keyframe seen through the one at hand."""

    outline: Outline
    colour: str
    line: Qt.PenStyle
    """What tells before from after without colour."""
    strength: float


def ghosts_at(frame: float, keys: Sequence[Keyframe], view: ViewOptions) -> tuple[Ghost, ...]:
    """Return the ghosts of the keyframes around a frame, the faintest first."""
    before = [key for key in keys if key.frame < frame][::-1][: view.onion_before]
    after = [key for key in keys if key.frame > frame][: view.onion_after]
    sides = ((before, view.tint_before, BEFORE), (after, view.tint_after, AFTER))
    ghosts = [
        Ghost(key.outline, tint, line, FAINTER**away)
        for side, tint, line in sides
        for away, key in enumerate(side)
    ]
    return tuple(sorted(ghosts, key=lambda ghost: ghost.strength))


class OnionSkin(QGraphicsItem):
    """Tinted outlines: a faint fill and a thin line."""

    def __init__(self) -> None:
        super().__init__()
        self._shown: tuple[Ghost, ...] = ()
        self._ghosts: list[tuple[QPainterPath, QColor, QPen]] = []

    def show_ghosts(self, ghosts: tuple[Ghost, ...]) -> None:
        """Show ghosts of keyframes; none hides them."""
        if self._shown == ghosts:
            return
        self._shown = ghosts
        self._ghosts = []
        for ghost in ghosts:
            path = outline_path([polyline.points for polyline in flatten(ghost.outline)])
            fill, ink = colour(ghost.colour), colour(ghost.colour)
            fill.setAlphaF(FILL_ALPHA * fill.alphaF() * ghost.strength)
            ink.setAlphaF(ink.alphaF() * ghost.strength)
            pen = QPen(ink, 1.0, ghost.line)
            pen.setCosmetic(True)
            self._ghosts.append((path, fill, pen))

    def boundingRect(self) -> QRectF:
        """Return everything."""
        return EVERYWHERE

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Paint the ghosts; a cosmetic pen counts device pixels, so it needs their ratio."""
        for path, fill, pen in self._ghosts:
            pen.setWidthF(painter.device().devicePixelRatioF())
            painter.setPen(pen)
            painter.setBrush(fill)
            painter.drawPath(path)
