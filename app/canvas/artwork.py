"""The layers of a frame, painted as they are exported."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QBrush, QPainter, QPainterPath, QPen
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from app.canvas.artboard import EVERYWHERE
from app.render.painter import brush_of, outline_path, pen_of
from core.model.outline import Array
from core.model.picture import Shape


@dataclass(frozen=True, eq=False)
class _Prepared:
    layer_id: int
    path: QPainterPath
    pen: QPen
    brush: QBrush
    opacity: float


class Artwork(QGraphicsItem):
    """Shapes whose paths are built once a frame, not once a paint."""

    def __init__(self) -> None:
        super().__init__()
        self._shapes: list[_Prepared] = []

    def show_shapes(self, shapes: tuple[Shape, ...], opacities: Mapping[int, float]) -> None:
        """Show shapes, bottom first; some layers, by id, at less than full opacity."""
        self._shapes = [
            _Prepared(
                shape.layer_id,
                outline_path(shape.rings),
                pen_of(shape.style),
                brush_of(shape.style),
                opacities.get(shape.layer_id, 1.0),
            )
            for shape in shapes
        ]

    def layer_at(self, point: Array, prefer: int | None = None) -> int | None:
        """Return the id of the topmost layer at a document point (2,), or of a preferred one."""
        here = QPointF(*point)
        hits = [shape.layer_id for shape in self._shapes if shape.path.contains(here)]
        return prefer if prefer in hits else (hits[-1] if hits else None)

    def boundingRect(self) -> QRectF:
        """Return everything."""
        return EVERYWHERE

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Paint the shapes, bottom first."""
        for shape in self._shapes:
            painter.setOpacity(shape.opacity)
            painter.setPen(shape.pen)
            painter.setBrush(shape.brush)
            painter.drawPath(shape.path)
