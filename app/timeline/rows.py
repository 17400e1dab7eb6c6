"""Where layers, keys and spans lie on the tracks, and what is under the mouse."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QPointF

from app.timeline.scale import TimeScale
from core.model import Document, Layer

ROW = 34
"""Pixels: the height of a layer's row."""
REACH = 12.0
"""Pixels to either side within which a key is grabbed."""

Place = tuple[int, int]
"""(layer id, index) of a key, or of the span that it begins."""


@dataclass(frozen=True)
class Rows:
    """The rows of a document, top layer first, at a scale."""

    document: Document
    scale: TimeScale

    @property
    def height(self) -> int:
        """Return how many pixels all rows take."""
        return ROW * len(self.document.layers)

    def layers(self) -> tuple[Layer, ...]:
        """Return the layers from top to bottom."""
        return self.document.layers[::-1]

    def layer_at(self, y: float) -> Layer | None:
        """Return the layer of the row at y."""
        row = int(y // ROW)
        return self.layers()[row] if 0 <= row < len(self.document.layers) else None

    def key_at(self, position: QPointF) -> Place | None:
        """Return (layer id, index) of the key nearest to a position, if it is within reach."""
        layer = self.layer_at(position.y())
        if layer is None:
            return None
        away, key = min(
            (abs(self.scale.x(key.frame) - position.x()), i)
            for i, key in enumerate(layer.keyframes)
        )
        return (layer.id, key) if away <= REACH else None

    def span_at(self, position: QPointF) -> Place | None:
        """Return (layer id, index) of the span at a position."""
        layer, frame = self.layer_at(position.y()), self.scale.frame(position.x())
        if layer is None or not layer.keyframes[0].frame < frame < layer.keyframes[-1].frame:
            return None
        return layer.id, layer.span_at(frame)[0]
