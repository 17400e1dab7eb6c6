"""An edit of a part of a document, as an edit of the document; what did not change is shared."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

from core.errors import EditError, Where
from core.model.document import Document
from core.model.layer import Keyframe, Layer
from core.model.outline import Ring
from core.model.structure import Problem, layer_problems


def altered(item: Any, **changes: Any) -> Any:
    """Return the item itself when the changes change nothing."""
    return (
        item if all(getattr(item, k) == v for k, v in changes.items()) else replace(item, **changes)
    )


def on_layer(document: Document, layer_id: int, edit: Callable[[Layer], Layer]) -> Document:
    """Edit a layer; EditError when that makes no sound one."""
    layer = layer_of(document, layer_id)
    edited = edit(layer)
    if edited == layer:
        return document
    require_sound(layer_problems("layer", edited))
    layers = tuple(edited if other is layer else other for other in document.layers)
    return replace(document, layers=layers)


def layer_of(document: Document, layer_id: int) -> Layer:
    """Return a layer by its id."""
    try:
        return document.layer(layer_id)
    except KeyError:
        raise EditError("There is no such layer.") from None


def keyframe_of(layer: Layer, key: int) -> Keyframe:
    """Return a keyframe by its index."""
    if not 0 <= key < len(layer.keyframes):
        raise EditError(f"Layer “{layer.name}” has no such keyframe.")
    return layer.keyframes[key]


def ring_of(keyframe: Keyframe, ring: int) -> Ring:
    """Return a ring by its index."""
    if not 0 <= ring < len(keyframe.outline.rings):
        raise EditError("The outline has no such ring.", where=Where(ring=ring))
    return keyframe.outline.rings[ring]


def nodes_of(ring: Ring, nodes: Sequence[int]) -> list[int]:
    """Return indices of nodes, once it is sure that the ring has them."""
    for node in nodes:
        if not 0 <= node < len(ring):
            raise EditError("The ring has no such node.", where=Where(node=node))
    return list(nodes)


def require_marks(layer: Layer, marks: Sequence[int]) -> None:
    """Refuse indices of marks that a layer has not."""
    for mark in marks:
        if not 0 <= mark < len(layer.labels):
            raise EditError(f"Layer “{layer.name}” has no such mark.", where=Where(marks=(mark,)))


def require_sound(problems: Iterable[Problem]) -> None:
    """Refuse what a document could not be saved with."""
    for place, what in problems:
        raise EditError(f"That edit is not possible: {place}: {what}.")


def with_key(layer: Layer, key: int, **changes: Any) -> Layer:
    """Change a keyframe of a layer."""
    new = altered(keyframe_of(layer, key), **changes)
    with_it: Layer = altered(
        layer, keyframes=(*layer.keyframes[:key], new, *layer.keyframes[key + 1 :])
    )
    return with_it


def on_key(document: Document, layer_id: int, key: int, **changes: Any) -> Document:
    """Change a keyframe."""
    return on_layer(document, layer_id, lambda layer: with_key(layer, key, **changes))


def on_ring(
    document: Document, layer_id: int, key: int, ring: int, edit: Callable[[Ring], Ring]
) -> Document:
    """Edit a ring of a keyframe."""
    keyframe = keyframe_of(layer_of(document, layer_id), key)
    edited = edit(ring_of(keyframe, ring))
    return on_key(document, layer_id, key, outline=keyframe.outline.with_ring(ring, edited))


def wrapped(at: float, n: int) -> float:
    """Return a place on a ring of n nodes as one in [0, n)."""
    at %= n
    return at if at < n else 0.0  # just below zero, the remainder rounds up to n
