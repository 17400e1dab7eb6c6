"""Marks: points that belong together, on every keyframe of a layer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from core.errors import EditError
from core.model.document import Document
from core.model.edits.within import altered, keyframe_of, layer_of, on_key, on_layer, require_marks
from core.model.layer import Layer
from core.model.outline import RingPoint


def add_mark(document: Document, layer_id: int, places: Sequence[RingPoint]) -> Document:
    """Add a mark, with its place on every keyframe of the layer; it takes the next free letter."""

    def edit(layer: Layer) -> Layer:
        if len(places) != len(layer.keyframes):
            raise EditError("A mark needs a place on every keyframe.")
        keys = tuple(
            replace(key, marks=(*key.marks, place))
            for key, place in zip(layer.keyframes, places, strict=True)
        )
        return replace(layer, labels=(*layer.labels, layer.next_label), keyframes=keys)

    return on_layer(document, layer_id, edit)


def move_mark(document: Document, layer_id: int, key: int, mark: int, place: RingPoint) -> Document:
    """Move a mark on one keyframe."""
    layer = layer_of(document, layer_id)
    require_marks(layer, [mark])
    marks = list(keyframe_of(layer, key).marks)
    marks[mark] = place
    return on_key(document, layer_id, key, marks=tuple(marks))


def remove_marks(document: Document, layer_id: int, marks: Sequence[int]) -> Document:
    """Remove marks by index, from every keyframe; the others keep their letters."""
    gone = set(marks)

    def kept(items: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(item for i, item in enumerate(items) if i not in gone)

    def edit(layer: Layer) -> Layer:
        require_marks(layer, marks)
        keys = tuple(replace(key, marks=kept(key.marks)) for key in layer.keyframes)
        return altered(layer, labels=kept(layer.labels), keyframes=keys)

    return on_layer(document, layer_id, edit)
