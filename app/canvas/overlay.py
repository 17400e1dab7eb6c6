"""What is painted over the artwork in screen pixels, so that it is as sharp at every zoom."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

if TYPE_CHECKING:
    from app.canvas.tools.tool import Tool
    from app.canvas.view import View


class Overlay(QGraphicsItem):
    """An item over the whole view; subclasses paint in its pixels."""

    def __init__(self, view: View) -> None:
        super().__init__()
        self.view = view

    def update(self) -> None:
        """Have the view painted anew, unless nothing of this is to be seen in it."""
        if self.isVisible():
            self.view.viewport().update()

    def setVisible(self, visible: bool) -> None:
        """Show or hide it."""
        if visible != self.isVisible():
            super().setVisible(visible)
            self.view.viewport().update()

    def boundingRect(self) -> QRectF:
        """Return the whole view."""
        return QRectF(self.view.viewport().rect())

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Paint antialiased, whatever the items before left set."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self.draw(painter)

    def draw(self, painter: QPainter) -> None:
        """Paint in pixels of the view."""
        raise NotImplementedError


class ToolOverlay(Overlay):
    """What the tool in hand shows in this pane: handles, rubber lines, what the next click hits."""

    def __init__(self, view: View) -> None:
        super().__init__(view)
        self.tool: Tool | None = None

    def draw(self, painter: QPainter) -> None:
        """Let the tool paint."""
        if self.tool is not None:
            self.tool.paint(painter, self.view.pane)
