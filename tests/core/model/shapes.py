"""Strategies for documents nobody thought of: rings with and without curves, marks, keyframes.

Structure (how many, which segments are curved, where marks lie) is searched and shrunk by
hypothesis; coordinates come from a seed, which keeps the search quick.
"""

from __future__ import annotations

from itertools import islice

import numpy as np
from hypothesis import strategies as st

from core.model import Document, Easing, Keyframe, Layer, Outline, Ring, RingPoint
from core.model.layer import mark_labels

coordinates = st.floats(-1000, 1000, allow_nan=False, width=32)
fractions = st.floats(0, 1, exclude_max=True)
seeds = st.integers(0, 2**32 - 1)


@st.composite
def rings(draw: st.DrawFn) -> Ring:
    """Rings of which any segment may be straight, curved at one end, or curved at both."""
    n = draw(st.integers(3, 9))
    leaving, arriving = draw(st.integers(0, 2**n - 1)), draw(st.integers(0, 2**n - 1))
    rng = np.random.default_rng(draw(seeds))

    def handles(there: int) -> np.ndarray:
        offsets = rng.uniform(-300, 300, (n, 2))
        return np.where([[there >> i & 1] for i in range(n)], offsets, 0.0)

    return Ring(rng.uniform(-1000, 1000, (n, 2)), handles(arriving), handles(leaving))


outlines = st.lists(rings(), min_size=1, max_size=2).map(lambda some: Outline(tuple(some)))


@st.composite
def places(draw: st.DrawFn, outline: Outline) -> RingPoint:
    """Places anywhere on an outline."""
    ring = draw(st.integers(0, len(outline.rings) - 1))
    n = len(outline.rings[ring])
    at = draw(st.integers(0, n - 1)) + draw(fractions)
    return RingPoint(ring, at if at < n else 0.0)


@st.composite
def easings(draw: st.DrawFn) -> Easing:
    """Timing curves that never turn back."""
    unit = st.floats(0, 1)
    return Easing(draw(unit), draw(unit), draw(unit), draw(unit), hold=draw(st.booleans()))


@st.composite
def layers(draw: st.DrawFn, layer_id: int = 1, max_keys: int = 3) -> Layer:
    """Layers whose keyframes differ in their nodes but share their marks."""
    frames = draw(st.sets(st.integers(-20, 200), min_size=1, max_size=max_keys))
    labels = tuple(islice(mark_labels(), draw(st.integers(0, 3))))
    keys = []
    for frame in sorted(frames):
        outline = draw(outlines)
        keys.append(Keyframe(frame, outline, tuple(draw(places(outline)) for _ in labels)))
    return Layer(layer_id, f"Layer {layer_id}", tuple(keys), labels)


@st.composite
def documents(draw: st.DrawFn) -> Document:
    """Documents of a few layers."""
    return Document(tuple(draw(layers(i + 1)) for i in range(draw(st.integers(1, 3)))))
