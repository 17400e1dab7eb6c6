"""Where all panes look: one centre and one zoom, so that they move together."""

from __future__ import annotations

from PySide6.QtCore import QObject, QPointF, QRectF, QSizeF, Signal

MIN_ZOOM, MAX_ZOOM = 0.02, 64.0
FIT_MARGIN = 0.08
"""Fraction of the pane that "fit" leaves free, both sides together."""


class Camera(QObject):
    """The document point in the middle of each pane, and screen pixels per document unit."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.centre = QPointF()
        self.zoom = 1.0
        self.flipped = False
        """Whether left and right are swapped, which shows an artist what is crooked."""
        self.fitted = True
        """Whether the artist has left framing to "fit" so far."""

    def pan(self, dx: float, dy: float) -> None:
        """Move the picture by screen pixels."""
        sign = -1.0 if self.flipped else 1.0
        self._look(self.centre - QPointF(sign * dx, dy) / self.zoom, self.zoom)

    def zoom_at(self, anchor: QPointF, factor: float) -> None:
        """Zoom by a factor; the document point ``anchor`` stays where it is on the screen."""
        self.zoom_to(anchor, self.zoom * factor)

    def zoom_to(self, anchor: QPointF, zoom: float) -> None:
        """Set the zoom, as far as it goes; the document point ``anchor`` stays where it is."""
        zoom = min(max(zoom, MIN_ZOOM), MAX_ZOOM)
        self._look(anchor + (self.centre - anchor) * (self.zoom / zoom), zoom)

    def fit(self, rect: QRectF, size: QSizeF) -> None:
        """Show a document rectangle whole in a pane of this size, and again on resizing."""
        self.show(rect, size)
        self.fitted = True

    def show(self, rect: QRectF, size: QSizeF) -> None:
        """Show a document rectangle whole in a pane of this size in pixels."""
        width, height = max(rect.width(), 1e-9), max(rect.height(), 1e-9)
        zoom = (1 - FIT_MARGIN) * min(size.width() / width, size.height() / height)
        self._look(rect.center(), min(max(zoom, MIN_ZOOM), MAX_ZOOM))

    def flip(self) -> None:
        """Mirror the view, not the document."""
        self.flipped = not self.flipped
        self.changed.emit()

    def _look(self, centre: QPointF, zoom: float) -> None:
        self.fitted = False
        if (centre, zoom) != (self.centre, self.zoom):
            self.centre, self.zoom = centre, zoom
            self.changed.emit()
