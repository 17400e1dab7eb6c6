"""Edits that take more than the model: geometry, or marks that are proposed on a new outline.

Each is a pure function Document → Document, composed of those of ``core.model.edits``.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from core.errors import EditError
from core.geometry.flatten import flatten
from core.geometry.places import measured, nearest_place
from core.geometry.polyline import points_at
from core.model import Document, Keyframe, Outline, Ring, RingPoint, edits
from core.model.outline import Array
from core.morph.suggest import mate

TARGET_AFTER = 24
"""Frames from the last key to a target that is drawn for it."""
Nodes = frozenset[tuple[int, int]]
"""(ring, node) pairs."""


def by_ring(nodes: Iterable[tuple[int, int]]) -> dict[int, list[int]]:
    """Group (ring, node) pairs by ring."""
    rings: dict[int, list[int]] = {}
    for ring, node in sorted(nodes):
        rings.setdefault(ring, []).append(node)
    return rings


def move_nodes(document: Document, layer_id: int, key: int, nodes: Nodes, by: Array) -> Document:
    """Move nodes of any rings by an offset (2,)."""
    for ring, members in by_ring(nodes).items():
        document = edits.move_nodes(document, layer_id, key, ring, members, by)
    return document


def delete_nodes(document: Document, layer_id: int, key: int, nodes: Nodes) -> Document:
    """Delete nodes of any rings, all or none; a hole that would keep none is filled."""
    outline = document.layer(layer_id).keyframes[key].outline
    for ring, members in reversed(by_ring(nodes).items()):  # so that the indices before it hold
        if ring > 0 and len(members) == len(outline.rings[ring]):
            document = _fill_hole(document, layer_id, key, ring)
        else:
            document = edits.delete_nodes(document, layer_id, key, ring, members)
    return document


def cut_hole(document: Document, layer_id: int, key: int, ring: Ring) -> Document:
    """Add a ring to a keyframe as a hole; EditError when it is not inside the outline."""
    from shapely.geometry import Polygon  # loads with the first hole, not with the window

    keyframe = document.layer(layer_id).keyframes[key]
    outline = Outline((*keyframe.outline.rings, ring))
    shape, *holes = (Polygon(line.points) for line in flatten(outline))
    inside = shape.is_valid and shape.contains(holes[-1])
    if not inside or any(holes[-1].intersects(other) for other in holes[:-1]):
        raise EditError(
            "The hole does not lie inside the shape.",
            hint="Draw it again, within the outline and clear of other holes.",
        )
    return edits.replace_outline(document, layer_id, key, outline, keyframe.marks)


def _fill_hole(document: Document, layer_id: int, key: int, ring: int) -> Document:
    """Remove a hole; marks on it go to the nearest place that is left."""
    old = document.layer(layer_id).keyframes[key]
    outline = Outline((*old.outline.rings[:ring], *old.outline.rings[ring + 1 :]))

    def shifted(mark: RingPoint) -> RingPoint:
        if mark.ring == ring:
            return nearest_place(outline, old.outline.position(mark))[0]
        return replace(mark, ring=mark.ring - (mark.ring > ring))

    return edits.replace_outline(document, layer_id, key, outline, [*map(shifted, old.marks)])


def slide_mark(document: Document, layer_id: int, key: int, mark: int, length: float) -> Document:
    """Move a mark along its outline by a length, forward or (negative) back."""
    keyframe = document.layer(layer_id).keyframes[key]
    place = keyframe.marks[mark]
    measure = measured(keyframe.outline)[place.ring]
    at = measure.place_of(measure.length_of(place.at) + length)
    return edits.move_mark(document, layer_id, key, mark, RingPoint(place.ring, at))


def length_along(outline: Outline, place: RingPoint, step: Array) -> float:
    """Return how far along the outline an arrow's step (2,) goes: forward is positive."""
    measure = measured(outline)[place.ring]
    length, size = measure.length_of(place.at), float(np.hypot(*step))
    around = np.array([length - size, length + size])
    behind, ahead = points_at(measure.polyline.points, measure.lengths, around)
    return size if (ahead - behind) @ step >= 0 else -size


def redraw_key(document: Document, layer_id: int, key: int, outline: Outline) -> Document:
    """Give a keyframe a newly drawn outline; its marks go to the nearest places on it."""
    old = document.layer(layer_id).keyframes[key]
    near = [nearest_place(outline, old.outline.position(mark))[0] for mark in old.marks]
    if not _in_order(old.marks, near):  # drawn elsewhere: the nearest places would shuffle them
        near = _matched(old, outline)
    return edits.replace_outline(document, layer_id, key, outline, near)


def draw_key(document: Document, layer_id: int, frame: int, outline: Outline) -> Document:
    """Add a keyframe with a newly drawn outline; its marks are proposed from a neighbour."""
    keys = document.layer(layer_id).keyframes
    neighbour = next((key for key in reversed(keys) if key.frame < frame), keys[0])
    marks = tuple(_matched(neighbour, outline))
    return edits.insert_keyframe(document, layer_id, Keyframe(frame, outline, marks))


def paste_key(
    document: Document, layer_id: int, frame: int, copied: Keyframe, labels: Sequence[str]
) -> Document:
    """Put a copy of a keyframe at a frame, in place of the outline there if there is one.

    Marks of the same letters are copied, too; else they are proposed.
    """
    layer = document.layer(layer_id)
    here = layer.key_at(frame)
    if layer.labels != labels:
        if here is None:
            return draw_key(document, layer_id, frame, copied.outline)
        return redraw_key(document, layer_id, here, copied.outline)
    if here is None:
        key = Keyframe(frame, copied.outline, copied.marks)
        return edits.insert_keyframe(document, layer_id, key)
    return edits.replace_outline(document, layer_id, here, copied.outline, copied.marks)


def _matched(key: Keyframe, outline: Outline) -> list[RingPoint]:
    """Return the mates of a keyframe's marks on another outline, each after those before it."""
    pairs: list[tuple[RingPoint, RingPoint]] = []
    for mark in key.marks:
        pairs.append((mark, mate(key.outline, outline, mark, pairs)))
    return [place for _, place in pairs]


def _in_order(before: Sequence[RingPoint], after: Sequence[RingPoint]) -> bool:
    """Whether places follow each other as those before did, one way round or the other."""
    for ring in {place.ring for place in before}:
        members = [i for i, place in enumerate(before) if place.ring == ring]
        members.sort(key=lambda i: before[i].at)
        at = np.array([after[i].at for i in members])
        steps = np.roll(at, -1) - at
        same_ring = len({after[i].ring for i in members}) == 1
        around = len(at) < 2 or (steps.all() and 1 in (np.sum(steps < 0), np.sum(steps > 0)))
        if not (same_ring and around):
            return False
    return True
