"""How a layer is painted."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Style:
    """Colours are "#rrggbb" or "#rrggbbaa"; an empty string paints nothing."""

    fill: str = "#4a90d9"
    stroke: str = "#1b2a41"
    stroke_width: float = 2.0
    """In document units."""
