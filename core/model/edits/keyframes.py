"""Keyframes: where they are in time, what they show, and the spans that they begin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from core.errors import EditError
from core.model.document import Document
from core.model.easing import Easing
from core.model.edits.within import keyframe_of, layer_of, on_key, on_layer, with_key
from core.model.layer import Keyframe, Layer
from core.model.outline import Outline, RingPoint
from core.model.turning import Turning


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
            layer = with_key(layer, span, easing=before, turning=earlier)
            new = replace(new, easing=after, passes=passes)
        keyframes = sorted((*layer.keyframes, new), key=lambda key: key.frame)
        return replace(layer, keyframes=tuple(keyframes))

    return on_layer(document, layer_id, edit)


def remove_keyframe(document: Document, layer_id: int, key: int) -> Document:
    """Remove a keyframe; a layer keeps at least one."""

    def edit(layer: Layer) -> Layer:
        keyframe_of(layer, key)
        if len(layer.keyframes) == 1:
            raise EditError(
                "A layer needs at least one keyframe.", hint="Delete the layer instead."
            )
        return replace(layer, keyframes=layer.keyframes[:key] + layer.keyframes[key + 1 :])

    return on_layer(document, layer_id, edit)


def move_keyframe(document: Document, layer_id: int, key: int, frame: int) -> Document:
    """Move a keyframe in time, without passing or covering a neighbour."""

    def edit(layer: Layer) -> Layer:
        keyframe_of(layer, key)
        least, most = layer.room(key)
        if not least <= frame <= most:
            raise EditError(f"Frame {frame} is not between the neighbouring keyframes.")
        return with_key(layer, key, frame=frame)

    return on_layer(document, layer_id, edit)


def replace_outline(
    document: Document, layer_id: int, key: int, outline: Outline, marks: Sequence[RingPoint]
) -> Document:
    """Give a keyframe another outline, with a place on it for every mark."""
    if len(marks) != len(layer_of(document, layer_id).labels):
        raise EditError("A keyframe must place every mark of its layer.")
    return on_key(document, layer_id, key, outline=outline, marks=tuple(marks))


def set_easing(document: Document, layer_id: int, key: int, easing: Easing) -> Document:
    """Set the timing of the span that begins at a keyframe."""
    return on_key(document, layer_id, key, easing=easing)


def set_turning(document: Document, layer_id: int, key: int, turning: Turning) -> Document:
    """Set how the shape turns in the span that begins at a keyframe."""
    return on_key(document, layer_id, key, turning=turning)


def set_passing(document: Document, layer_id: int, key: int, passes: bool) -> Document:
    """Let the motion pass through a keyframe, or end there and start anew."""
    return on_key(document, layer_id, key, passes=passes)
