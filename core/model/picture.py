"""One frame as it is seen: what every canvas, renderer and exporter draws."""

from __future__ import annotations

from dataclasses import dataclass

from core.model.outline import Array
from core.model.style import Style


@dataclass(frozen=True, eq=False)
class Shape:
    """What one layer shows at a frame."""

    layer_id: int
    name: str
    style: Style
    rings: tuple[Array, ...]
    """Closed polylines (k, 2), exterior first, to be filled by the even-odd rule."""


@dataclass(frozen=True, eq=False)
class Picture:
    """The visible layers at a frame, bottom first."""

    frame: float
    size: tuple[float, float]
    background: str
    shapes: tuple[Shape, ...]
