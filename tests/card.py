"""A document for tests: a card that leans over."""

from __future__ import annotations

from core.model import Document, Keyframe, Layer, Outline, RingPoint

SQUARE = ((300.0, 150.0), (600.0, 150.0), (600.0, 400.0), (300.0, 400.0))
LEANING = ((380.0, 150.0), (680.0, 150.0), (600.0, 400.0), (300.0, 400.0))


def a_document(*, marks: bool = True, target: bool = True) -> Document:
    """One layer: a square that leans over from frame 1 to frame 25, marked at two corners."""
    places = (RingPoint(0, 0.0), RingPoint(0, 2.0)) if marks else ()
    keys = [Keyframe(1, Outline.polygon(SQUARE), places)]
    if target:
        keys.append(Keyframe(25, Outline.polygon(LEANING), places))
    return Document((Layer(1, "Card", tuple(keys), ("a", "b") if marks else ()),))
