"""Where imported shapes go: onto the artboard, and into layers or keyframes."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

from core.geometry.flatten import flatten
from core.geometry.polyline import signed_area
from core.io.importers import Part, bounds
from core.model import Document
from core.model.edits import add_layer, update_layer
from core.morph.edits import TARGET_AFTER, draw_key, redraw_key

TINY = 0.2
"""Smaller than this part of the artboard's height and width, an import looks lost: icons are."""
STRAIGHT = 0.01
"""A backdrop leaves no more than this part of the picture free."""


class Place(Enum):
    """What the imported parts become."""

    LAYERS = "layers"
    POSES = "poses"
    """The keyframes of one new layer, one after the other."""
    SOURCE = "source"
    TARGET = "target"


def misplaced(parts: Sequence[Part], size: tuple[float, float]) -> bool:
    """Return whether parts lie off the artboard, or are too small or too large to work with."""
    left, top, right, bottom = bounds(parts)
    width, height = size
    outside = left < -width / 2 or top < -height / 2 or right > 1.5 * width or bottom > 1.5 * height
    return outside or max((right - left) / width, (bottom - top) / height) < TINY


def likely(files: Sequence[Sequence[Part]]) -> list[int]:
    """Return which parts, counted through all files, are wanted most likely.

    Of several files, the main part of each, which are poses; of one, a pair or the main part.
    """
    wanted: list[int] = []
    before = 0
    for parts in files:
        found = subjects(parts)
        if len(files) > 1 or len(found) > 2:
            found = [largest(parts, found)]
        wanted += [before + i for i in found]
        before += len(parts)
    return wanted


def subjects(parts: Sequence[Part]) -> list[int]:
    """Return which parts are likely to be wanted: all but backdrops, which fill the picture."""
    left, top, right, bottom = bounds(parts)
    room = (right - left) * (bottom - top)
    wanted = [
        i
        for i, part in enumerate(parts)
        if len(part.outline.rings) > 1 or _area(part) < (1 - STRAIGHT) * room
    ]
    return wanted or list(range(len(parts)))


def largest(parts: Sequence[Part], among: Sequence[int]) -> int:
    """Return which of the parts with these indices covers most, the first of equals."""
    return max(among, key=lambda i: _area(parts[i]))


def _area(part: Part) -> float:
    """Return the area within a part's exterior."""
    return abs(signed_area(flatten(part.outline)[0].points))


def add_layers(document: Document, parts: Sequence[Part], frame: int) -> Document:
    """Add a layer for each part, the first lowest."""
    for part in parts:
        document = add_layer(document, part.name, frame, part.outline)
        if part.style is not None:
            style = part.style_on(document.background)
            document = update_layer(document, document.layers[-1].id, style=style)
    return document


def add_poses(document: Document, parts: Sequence[Part], frame: int) -> Document:
    """Add one layer that goes from part to part."""
    first, *others = parts
    document = add_layers(document, [first], frame)
    for number, part in enumerate(others, start=1):
        then = frame + number * TARGET_AFTER
        document = draw_key(document, document.layers[-1].id, then, part.outline)
    return document


def set_key(document: Document, layer_id: int, place: Place, part: Part, frame: float) -> Document:
    """Make a part the source or the target keyframe of the layer's span at a frame.

    A keyframe that exists gets the new outline; a layer with one keyframe gets the other one.
    Marks stay, at the nearest places or at proposed ones.
    """
    layer = document.layer(layer_id)
    key = layer.span_at(frame)[0] + (place is Place.TARGET)
    if key < len(layer.keyframes):
        return redraw_key(document, layer_id, key, part.outline)
    return draw_key(document, layer_id, layer.keyframes[-1].frame + TARGET_AFTER, part.outline)
