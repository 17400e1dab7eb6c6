"""Where imported shapes go: onto the artboard, and into layers or keyframes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from enum import Enum

import numpy as np

from app.canvas.tools.edits import draw_key, redraw_key
from core.io.importers import Part
from core.model import Document
from core.model.edits import add_layer, update_layer

FILLED = 0.7
"""The part of the artboard that a fitted import fills at most."""
TINY = 0.05
"""Smaller than this part of the artboard's height and width, an import could hardly be seen."""
GAP = 24
"""Frames from an imported source to its target."""


class Place(Enum):
    """What the imported parts become."""

    LAYERS = "layers"
    PAIR = "pair"
    """Two parts: the first and the last keyframe of one new layer."""
    SOURCE = "source"
    TARGET = "target"


def misplaced(parts: Sequence[Part], size: tuple[float, float]) -> bool:
    """Return whether parts lie off the artboard, or are too small or too large to work with."""
    left, top, right, bottom = bounds(parts)
    width, height = size
    outside = left < -width / 2 or top < -height / 2 or right > 1.5 * width or bottom > 1.5 * height
    return outside or max((right - left) / width, (bottom - top) / height) < TINY


def fitted(parts: Sequence[Part], size: tuple[float, float]) -> list[Part]:
    """Scale and move all parts together to the middle of an artboard."""
    left, top, right, bottom = bounds(parts)
    scale = FILLED * min(size[0] / max(right - left, 1e-12), size[1] / max(bottom - top, 1e-12))
    middle = np.array([left + right, top + bottom]) / 2
    offset = np.array(size) / 2 - scale * middle
    return [
        replace(part, outline=part.outline.transformed(scale * np.eye(2), offset)) for part in parts
    ]


def bounds(parts: Sequence[Part]) -> tuple[float, float, float, float]:
    """(left, top, right, bottom) of all parts together."""
    each = np.array([part.outline.bounds() for part in parts])
    left, top = each[:, :2].min(axis=0)
    right, bottom = each[:, 2:].max(axis=0)
    return float(left), float(top), float(right), float(bottom)


def add_layers(document: Document, parts: Sequence[Part], frame: int) -> Document:
    """Add a layer for each part, the first lowest."""
    for part in parts:
        document = add_layer(document, part.name, frame, part.outline)
        if part.style is not None:
            document = update_layer(document, document.layers[-1].id, style=part.style)
    return document


def add_pair(document: Document, parts: Sequence[Part], frame: int) -> Document:
    """Add one layer that turns the first part into the second."""
    first, second = parts
    document = add_layers(document, [first], frame)
    return draw_key(document, document.layers[-1].id, frame + GAP, second.outline)


def set_key(document: Document, layer_id: int, place: Place, part: Part, frame: float) -> Document:
    """Make a part the source or the target keyframe of the layer's span at a frame.

    A keyframe that exists gets the new outline; a layer with one keyframe gets the other one.
    Marks stay, at the nearest places or at proposed ones.
    """
    layer = document.layer(layer_id)
    key = layer.span_at(frame)[0] + (place is Place.TARGET)
    if key < len(layer.keyframes):
        return redraw_key(document, layer_id, key, part.outline)
    return draw_key(document, layer_id, layer.keyframes[-1].frame + GAP, part.outline)
