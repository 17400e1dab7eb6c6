"""How a layer is painted."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

FILLS = ("#4a90d9", "#e8833a", "#5aa469", "#c0556e", "#8a6fc9", "#d9b23c", "#3ea6a6", "#9a7b5f")
"""What new layers are filled with, one after the other, to be told apart."""


@dataclass(frozen=True)
class Style:
    """Colours are "#rrggbb" or "#rrggbbaa"; an empty string paints nothing."""

    fill: str = FILLS[0]
    stroke: str = "#1b2a41"
    stroke_width: float = 2.0
    """In document units."""


def style_apart(fills: Collection[str]) -> Style:
    """Return a style whose fill is none of those in use, as long as there are others."""
    return Style(fill=next((fill for fill in FILLS if fill not in fills), FILLS[0]))
