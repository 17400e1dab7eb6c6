"""The nodes of a keyframe's outline; its marks stay where they are on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from core.errors import EditError, Where
from core.model.document import Document
from core.model.edits.within import (
    keyframe_of,
    layer_of,
    nodes_of,
    on_key,
    on_ring,
    require_sound,
    ring_of,
    wrapped,
)
from core.model.outline import MIN_NODES, Ring, RingPoint
from core.model.structure import place_problems


def move_nodes(
    document: Document, layer_id: int, key: int, ring: int, nodes: Sequence[int], by: ArrayLike
) -> Document:
    """Move nodes, with their handles, by an offset (2,)."""

    def edit(old: Ring) -> Ring:
        points = np.array(old.points)
        points[nodes_of(old, nodes)] += np.asarray(by, dtype=float)
        return replace(old, points=points)

    return on_ring(document, layer_id, key, ring, edit)


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
        nodes_of(old, [node])
        before, after = np.array(old.handles_in), np.array(old.handles_out)
        before[node], after[node] = handle_in, handle_out
        return replace(old, handles_in=before, handles_out=after)

    return on_ring(document, layer_id, key, ring, edit)


def insert_node(document: Document, layer_id: int, key: int, place: RingPoint) -> Document:
    """Insert a node on the curve, without changing its shape; marks stay where they are."""
    keyframe = keyframe_of(layer_of(document, layer_id), key)
    require_sound(place_problems("place", place, keyframe.outline))
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
        return replace(mark, at=wrapped(at, len(ring)))

    ring = keyframe.outline.rings[place.ring].with_node(place.at)
    return on_key(
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
    keyframe = keyframe_of(layer_of(document, layer_id), key)
    old = ring_of(keyframe, ring)
    gone = np.unique(nodes_of(old, nodes))
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
        return replace(mark, at=wrapped(float(before + u), len(kept)))

    return on_key(
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
    layer = layer_of(document, layer_id)
    frame = keyframe_of(layer, key).frame
    hanging = (
        other for other in document.layers if layer in document.carriers(other) and not other.locked
    )
    for some in (layer, *hanging):
        here = some.key_at(frame)
        if here is not None:
            outline = some.keyframes[here].outline.transformed(matrix, offset)
            document = on_key(document, some.id, here, outline=outline)
    return document
