"""The document as a whole, and its layers."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain
from typing import Any

from core.errors import EditError
from core.model.document import Document
from core.model.edits.within import altered, layer_of, on_layer, require_sound
from core.model.layer import Keyframe, Layer
from core.model.outline import Outline
from core.model.structure import layer_problems, setting_problems
from core.model.style import style_apart


def update_document(document: Document, **changes: Any) -> Document:
    """Change fps, size, background or hold."""
    changed: Document = altered(document, **changes)
    if changed is not document:
        require_sound(setting_problems(changed))
    return changed


def add_layer(document: Document, name: str, frame: int, outline: Outline) -> Document:
    """Add a layer on top, with one keyframe, in a colour of its own."""
    new_id = max((layer.id for layer in document.layers), default=0) + 1
    style = style_apart({layer.style.fill for layer in document.layers})
    layer = Layer(new_id, name, (Keyframe(frame, outline),), style=style)
    require_sound(layer_problems("layer", layer))
    return replace(document, layers=(*document.layers, layer))


def duplicate_layer(document: Document, layer_id: int, name: str) -> Document:
    """Add a copy of a layer right above it."""
    layer = layer_of(document, layer_id)
    copy = replace(layer, id=max(other.id for other in document.layers) + 1, name=name)
    require_sound(layer_problems("layer", copy))
    pairs = ((other, copy) if other is layer else (other,) for other in document.layers)
    return replace(document, layers=tuple(chain.from_iterable(pairs)))


def remove_layer(document: Document, layer_id: int) -> Document:
    """Remove a layer; what hung on it hangs on nothing."""
    layer_of(document, layer_id)
    kept = (layer for layer in document.layers if layer.id != layer_id)
    free = (replace(layer, carrier=None) if layer.carrier == layer_id else layer for layer in kept)
    return replace(document, layers=tuple(free))


def reorder_layer(document: Document, layer_id: int, index: int) -> Document:
    """Move a layer to a position in the stack, bottom = 0."""
    layer = layer_of(document, layer_id)
    layers = [other for other in document.layers if other is not layer]
    layers.insert(max(index, 0), layer)
    return altered(document, layers=tuple(layers))


def update_layer(document: Document, layer_id: int, **changes: Any) -> Document:
    """Change a layer's name, style, recipe, visible or locked."""
    return on_layer(document, layer_id, lambda layer: altered(layer, **changes))


def hang_layer(document: Document, layer_id: int, carrier: int | None) -> Document:
    """Hang a layer on another, which then carries it along; or on nothing."""
    if carrier is not None:
        above = layer_of(document, carrier)
        if layer_id in (carrier, *(layer.id for layer in document.carriers(above))):
            raise EditError(
                f"Layer “{layer_of(document, layer_id).name}” cannot hang on “{above.name}”, "
                "which is itself or hangs on it."
            )
    return on_layer(document, layer_id, lambda layer: altered(layer, carrier=carrier))
