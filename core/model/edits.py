"""Every change an artist can make, each as one pure function Document → Document.

A function returns the very same document when nothing changes, and raises ``EditError`` when the
edit is impossible: what it names is not there, or what it makes is no sound document. Parts that
did not change are shared, so results computed for them stay valid.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from core.errors import EditError, Where
from core.model.document import Document
from core.model.easing import Easing
from core.model.layer import Keyframe, Layer
from core.model.outline import MIN_NODES, Outline, Ring, RingPoint
from core.model.structure import Problem, layer_problems, place_problems, setting_problems
from core.model.turning import Turning

# -- document and layers -----------------------------------------------------------------------


def update_document(document: Document, **changes: Any) -> Document:
    """Change fps, size or background."""
    changed: Document = _changed(document, **changes)
    if changed is not document:
        _require_sound(setting_problems(changed))
    return changed


def add_layer(document: Document, name: str, frame: int, outline: Outline) -> Document:
    """Add a layer on top, with one keyframe."""
    new_id = max((layer.id for layer in document.layers), default=0) + 1
    layer = Layer(new_id, name, (Keyframe(frame, outline),))
    _require_sound(layer_problems("layer", layer))
    return replace(document, layers=(*document.layers, layer))


def duplicate_layer(document: Document, layer_id: int, name: str) -> Document:
    """Add a copy of a layer right above it."""
    layer = _layer(document, layer_id)
    copy = replace(layer, id=max(other.id for other in document.layers) + 1, name=name)
    _require_sound(layer_problems("layer", copy))
    pairs = ((other, copy) if other is layer else (other,) for other in document.layers)
    return replace(document, layers=tuple(chain.from_iterable(pairs)))


def remove_layer(document: Document, layer_id: int) -> Document:
    """Remove a layer; what hung on it hangs on nothing."""
    _layer(document, layer_id)
    kept = (layer for layer in document.layers if layer.id != layer_id)
    free = (replace(layer, carrier=None) if layer.carrier == layer_id else layer for layer in kept)
    return replace(document, layers=tuple(free))


def reorder_layer(document: Document, layer_id: int, index: int) -> Document:
    """Move a layer to a position in the stack, bottom = 0."""
    layer = _layer(document, layer_id)
    layers = [other for other in document.layers if other is not layer]
    layers.insert(max(index, 0), layer)
    return _changed(document, layers=tuple(layers))


def update_layer(document: Document, layer_id: int, **changes: Any) -> Document:
    """Change a layer's name, style, recipe, visible or locked."""
    return _on_layer(document, layer_id, lambda layer: _changed(layer, **changes))


def hang_layer(document: Document, layer_id: int, carrier: int | None) -> Document:
    """Hang a layer on another, which then carries it along; or on nothing."""
    if carrier is not None:
        above = _layer(document, carrier)
        if layer_id in (carrier, *(layer.id for layer in document.carriers(above))):
            raise EditError(
                f"Layer “{_layer(document, layer_id).name}” cannot hang on “{above.name}”, "
                "which is itself or hangs on it."
            )
    return _on_layer(document, layer_id, lambda layer: _changed(layer, carrier=carrier))


# -- keyframes ---------------------------------------------------------------------------------


def insert_keyframe(
    document: Document, layer_id: int, keyframe: Keyframe, turning: Turning | None = None
) -> Document:
    """Add a keyframe; it must place every mark of the layer. Its frame must be free.

    Inside a span it takes over the later part of that span's timing, so that progress stays what it
    was at every frame, and the motion passes through it where it does at an end of that span.
    ``turning`` is how the earlier part of the span turns from now on.
    """

    def edit(layer: Layer) -> Layer:
        if layer.key_at(keyframe.frame) is not None:
            raise EditError(
                f"Frame {keyframe.frame} already has a keyframe.",
                hint="Move the playhead to a free frame, or delete that keyframe first.",
            )
        if len(keyframe.marks) != len(layer.labels):
            raise EditError("A keyframe must place every mark of its layer.")
        new = keyframe
        span, t = layer.span_at(new.frame)
        if 0 < t < 1:
            before, after = layer.easing_of(span).split(t)
            passes = layer.passes(span) or layer.passes(span + 1)
            earlier = turning or layer.keyframes[span].turning
            layer = _with_key(layer, span, easing=before, turning=earlier)
            new = replace(new, easing=after, passes=passes)
        keyframes = sorted((*layer.keyframes, new), key=lambda key: key.frame)
        return replace(layer, keyframes=tuple(keyframes))

    return _on_layer(document, layer_id, edit)


def remove_keyframe(document: Document, layer_id: int, key: int) -> Document:
    """Remove a keyframe; a layer keeps at least one."""

    def edit(layer: Layer) -> Layer:
        _keyframe(layer, key)
        if len(layer.keyframes) == 1:
            raise EditError(
                "A layer needs at least one keyframe.", hint="Delete the layer instead."
            )
        return replace(layer, keyframes=layer.keyframes[:key] + layer.keyframes[key + 1 :])

    return _on_layer(document, layer_id, edit)


def move_keyframe(document: Document, layer_id: int, key: int, frame: int) -> Document:
    """Move a keyframe in time, without passing or covering a neighbour."""

    def edit(layer: Layer) -> Layer:
        _keyframe(layer, key)
        least, most = layer.room(key)
        if not least <= frame <= most:
            raise EditError(f"Frame {frame} is not between the neighbouring keyframes.")
        return _with_key(layer, key, frame=frame)

    return _on_layer(document, layer_id, edit)


def replace_outline(
    document: Document, layer_id: int, key: int, outline: Outline, marks: Sequence[RingPoint]
) -> Document:
    """Give a keyframe another outline, with a place on it for every mark."""
    if len(marks) != len(_layer(document, layer_id).labels):
        raise EditError("A keyframe must place every mark of its layer.")
    return _on_key(document, layer_id, key, outline=outline, marks=tuple(marks))


def set_easing(document: Document, layer_id: int, key: int, easing: Easing) -> Document:
    """Set the timing of the span that begins at a keyframe."""
    return _on_key(document, layer_id, key, easing=easing)


def set_turning(document: Document, layer_id: int, key: int, turning: Turning) -> Document:
    """Set how the shape turns in the span that begins at a keyframe."""
    return _on_key(document, layer_id, key, turning=turning)


def set_passing(document: Document, layer_id: int, key: int, passes: bool) -> Document:
    """Let the motion pass through a keyframe, or end there and start anew."""
    return _on_key(document, layer_id, key, passes=passes)


# -- nodes -------------------------------------------------------------------------------------


def move_nodes(
    document: Document, layer_id: int, key: int, ring: int, nodes: Sequence[int], by: ArrayLike
) -> Document:
    """Move nodes, with their handles, by an offset (2,)."""

    def edit(old: Ring) -> Ring:
        points = np.array(old.points)
        points[_nodes(old, nodes)] += np.asarray(by, dtype=float)
        return replace(old, points=points)

    return _on_ring(document, layer_id, key, ring, edit)


def set_handles(
    document: Document,
    layer_id: int,
    key: int,
    place: tuple[int, int],
    handle_in: ArrayLike,
    handle_out: ArrayLike,
) -> Document:
    """Set both handles of node ``place = (ring, node)``, as offsets (2,) from it; zero: none."""
    ring, node = place

    def edit(old: Ring) -> Ring:
        _nodes(old, [node])
        before, after = np.array(old.handles_in), np.array(old.handles_out)
        before[node], after[node] = handle_in, handle_out
        return replace(old, handles_in=before, handles_out=after)

    return _on_ring(document, layer_id, key, ring, edit)


def insert_node(document: Document, layer_id: int, key: int, place: RingPoint) -> Document:
    """Insert a node on the curve, without changing its shape; marks stay where they are."""
    keyframe = _keyframe(_layer(document, layer_id), key)
    _require_sound(place_problems("place", place, keyframe.outline))
    segment, u = int(place.at), place.at - int(place.at)
    if u == 0:
        return document

    def shifted(mark: RingPoint) -> RingPoint:
        if mark.ring != place.ring or mark.at < segment:
            return mark
        if mark.at >= segment + 1:
            return replace(mark, at=mark.at + 1)
        v = mark.at - segment
        at = segment + v / u if v < u else segment + 1 + (v - u) / (1 - u)
        return replace(mark, at=_wrapped(at, len(ring)))

    ring = keyframe.outline.rings[place.ring].with_node(place.at)
    return _on_key(
        document,
        layer_id,
        key,
        outline=keyframe.outline.with_ring(place.ring, ring),
        marks=tuple(map(shifted, keyframe.marks)),
    )


def delete_nodes(
    document: Document, layer_id: int, key: int, ring: int, nodes: Sequence[int]
) -> Document:
    """Delete nodes; a ring keeps at least three. Their marks stay between the same neighbours."""
    keyframe = _keyframe(_layer(document, layer_id), key)
    old = _ring(keyframe, ring)
    gone = np.unique(_nodes(old, nodes))
    if len(old) - len(gone) < MIN_NODES:
        raise EditError(
            f"A ring needs at least {MIN_NODES} nodes.",
            where=Where(ring=ring),
            hint="Add nodes elsewhere first, or draw the outline anew.",
        )
    kept = np.setdiff1d(np.arange(len(old)), gone)

    def shifted(mark: RingPoint) -> RingPoint:
        if mark.ring != ring:
            return mark
        before = int(np.searchsorted(kept, mark.at, side="right")) - 1
        start = kept[before] - (len(old) if before < 0 else 0)
        end = kept[before + 1] if before + 1 < len(kept) else kept[0] + len(old)
        u = (mark.at - start) / (end - start)
        return replace(mark, at=_wrapped(float(before + u), len(kept)))

    return _on_key(
        document,
        layer_id,
        key,
        outline=keyframe.outline.with_ring(ring, old.without_nodes(gone.tolist())),
        marks=tuple(map(shifted, keyframe.marks)),
    )


def transform_outline(
    document: Document, layer_id: int, key: int, matrix: ArrayLike, offset: ArrayLike
) -> Document:
    """Apply x → M x + offset to a whole keyframe, and to those at its frame that hang on it."""
    layer = _layer(document, layer_id)
    frame = _keyframe(layer, key).frame
    hanging = (
        other for other in document.layers if layer in document.carriers(other) and not other.locked
    )
    for some in (layer, *hanging):
        here = some.key_at(frame)
        if here is not None:
            outline = some.keyframes[here].outline.transformed(matrix, offset)
            document = _on_key(document, some.id, here, outline=outline)
    return document


# -- marks -------------------------------------------------------------------------------------


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

    return _on_layer(document, layer_id, edit)


def move_mark(document: Document, layer_id: int, key: int, mark: int, place: RingPoint) -> Document:
    """Move a mark on one keyframe."""
    layer = _layer(document, layer_id)
    _require_marks(layer, [mark])
    marks = list(_keyframe(layer, key).marks)
    marks[mark] = place
    return _on_key(document, layer_id, key, marks=tuple(marks))


def remove_marks(document: Document, layer_id: int, marks: Sequence[int]) -> Document:
    """Remove marks by index, from every keyframe; the others keep their letters."""
    gone = set(marks)

    def kept(items: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(item for i, item in enumerate(items) if i not in gone)

    def edit(layer: Layer) -> Layer:
        _require_marks(layer, marks)
        keys = tuple(replace(key, marks=kept(key.marks)) for key in layer.keyframes)
        return _changed(layer, labels=kept(layer.labels), keyframes=keys)

    return _on_layer(document, layer_id, edit)


# -- helpers -----------------------------------------------------------------------------------


def _changed(item: Any, **changes: Any) -> Any:
    """Return the item itself when the changes change nothing."""
    return (
        item if all(getattr(item, k) == v for k, v in changes.items()) else replace(item, **changes)
    )


def _on_layer(document: Document, layer_id: int, edit: Callable[[Layer], Layer]) -> Document:
    layer = _layer(document, layer_id)
    edited = edit(layer)
    if edited == layer:
        return document
    _require_sound(layer_problems("layer", edited))
    layers = tuple(edited if other is layer else other for other in document.layers)
    return replace(document, layers=layers)


def _layer(document: Document, layer_id: int) -> Layer:
    try:
        return document.layer(layer_id)
    except KeyError:
        raise EditError("There is no such layer.") from None


def _keyframe(layer: Layer, key: int) -> Keyframe:
    if not 0 <= key < len(layer.keyframes):
        raise EditError(f"Layer “{layer.name}” has no such keyframe.")
    return layer.keyframes[key]


def _ring(keyframe: Keyframe, ring: int) -> Ring:
    if not 0 <= ring < len(keyframe.outline.rings):
        raise EditError("The outline has no such ring.", where=Where(ring=ring))
    return keyframe.outline.rings[ring]


def _nodes(ring: Ring, nodes: Sequence[int]) -> list[int]:
    for node in nodes:
        if not 0 <= node < len(ring):
            raise EditError("The ring has no such node.", where=Where(node=node))
    return list(nodes)


def _require_marks(layer: Layer, marks: Sequence[int]) -> None:
    for mark in marks:
        if not 0 <= mark < len(layer.labels):
            raise EditError(f"Layer “{layer.name}” has no such mark.", where=Where(marks=(mark,)))


def _require_sound(problems: Iterable[Problem]) -> None:
    """Refuse what a document could not be saved with."""
    for place, what in problems:
        raise EditError(f"That edit is not possible: {place}: {what}.")


def _with_key(layer: Layer, key: int, **changes: Any) -> Layer:
    changed = _changed(_keyframe(layer, key), **changes)
    return _changed(layer, keyframes=(*layer.keyframes[:key], changed, *layer.keyframes[key + 1 :]))


def _on_key(document: Document, layer_id: int, key: int, **changes: Any) -> Document:
    return _on_layer(document, layer_id, lambda layer: _with_key(layer, key, **changes))


def _on_ring(
    document: Document, layer_id: int, key: int, ring: int, edit: Callable[[Ring], Ring]
) -> Document:
    keyframe = _keyframe(_layer(document, layer_id), key)
    edited = edit(_ring(keyframe, ring))
    return _on_key(document, layer_id, key, outline=keyframe.outline.with_ring(ring, edited))


def _wrapped(at: float, n: int) -> float:
    at %= n
    return at if at < n else 0.0  # just below zero, the remainder rounds up to n
