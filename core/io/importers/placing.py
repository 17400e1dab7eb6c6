"""Bringing what was read onto the artboard."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core.io.importers.part import Part
from core.model.structure import MOST_SIDE

FILLED = 0.7
"""The part of the artboard that a fitted import fills at most."""


def bounds(parts: Sequence[Part]) -> tuple[float, float, float, float]:
    """(left, top, right, bottom) of all parts together."""
    each = np.array([part.outline.bounds() for part in parts])
    left, top = each[:, :2].min(axis=0)
    right, bottom = each[:, 2:].max(axis=0)
    return float(left), float(top), float(right), float(bottom)


def fitted(parts: Sequence[Part], size: tuple[float, float]) -> list[Part]:
    """Scale and move all parts together, strokes too, to the middle of an artboard."""
    left, top, right, bottom = bounds(parts)
    scale = FILLED * min(size[0] / max(right - left, 1e-12), size[1] / max(bottom - top, 1e-12))
    offset = np.array(size) / 2 - scale * np.array([left + right, top + bottom]) / 2
    return [_scaled(part, scale, offset) for part in parts]


def _scaled(part: Part, scale: float, offset: np.ndarray) -> Part:
    style = part.style
    if style is not None and style.stroke:
        style = replace(style, stroke_width=min(scale * style.stroke_width, MOST_SIDE))
    return replace(part, outline=part.outline.transformed(scale * np.eye(2), offset), style=style)
