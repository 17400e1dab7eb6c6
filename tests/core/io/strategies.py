"""Documents nobody would draw, for the laws that must hold for every document."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.model import (
    Document,
    Easing,
    Keyframe,
    Layer,
    Outline,
    Recipe,
    Ring,
    RingPoint,
    Style,
    Turning,
)
from core.model.easing import WILD
from core.model.recipe import Material, Method
from core.model.structure import FARTHEST, LEAST_RATE, LEAST_SIDE, MOST_RATE, MOST_SIDE

COORDINATES = st.floats(-FARTHEST, FARTHEST)
OVERSHOOTS = st.floats(-WILD, WILD)
POSITIVE = st.floats(min_value=1e-300, max_value=1e300)
FRACTION = st.floats(0, 1)
SIDES = st.floats(LEAST_SIDE, MOST_SIDE)
COLOURS = st.from_regex(r"(#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?)?", fullmatch=True)


@st.composite
def rings(draw: st.DrawFn) -> Ring:
    shape = (draw(st.integers(3, 6)), 2)
    points = draw(arrays(np.float64, shape, elements=COORDINATES))
    handles = st.one_of(st.just(np.zeros(shape)), arrays(np.float64, shape, elements=COORDINATES))
    return Ring(points, draw(handles), draw(handles))


OUTLINES = st.lists(rings(), min_size=1, max_size=2).map(lambda found: Outline(tuple(found)))
EASINGS = st.builds(Easing, FRACTION, OVERSHOOTS, FRACTION, OVERSHOOTS, st.booleans())
TURNINGS = st.builds(
    Turning,
    st.sampled_from(["automatic", "clockwise", "counter-clockwise"]),
    st.integers(0, 100),
    st.sampled_from(["arc", "straight"]),
    st.sampled_from(["centre", "joint"]),
)
STYLES = st.builds(Style, COLOURS, COLOURS, st.floats(0, MOST_SIDE))
RECIPES = st.builds(
    Recipe,
    st.sampled_from(get_args(Method)),
    st.integers(3, 10_000),
    st.sampled_from(get_args(Material)),
    POSITIVE,
    st.floats(0, 1e300),
)


@st.composite
def keyframes(draw: st.DrawFn, frame: int, marks: int) -> Keyframe:
    outline = draw(OUTLINES)
    places = []
    for _ in range(marks):
        ring = draw(st.integers(0, len(outline.rings) - 1))
        at = draw(st.floats(0, len(outline.rings[ring]), exclude_max=True))
        places.append(RingPoint(ring, at))
    return Keyframe(
        frame, outline, tuple(places), draw(EASINGS), draw(TURNINGS), draw(st.booleans())
    )


@st.composite
def layers(draw: st.DrawFn, layer_id: int) -> Layer:
    labels = draw(st.lists(st.text(min_size=1, max_size=3), max_size=3, unique=True))
    frames = draw(st.lists(st.integers(-1000, 1000), min_size=1, max_size=3, unique=True))
    keys = tuple(draw(keyframes(frame, len(labels))) for frame in sorted(frames))
    name, flags = draw(st.text(max_size=8)), st.booleans()
    return Layer(
        layer_id, name, keys, tuple(labels), draw(STYLES), draw(RECIPES), draw(flags), draw(flags)
    )


@st.composite
def documents(draw: st.DrawFn) -> Document:
    ids = draw(st.lists(st.integers(-(2**40), 2**40), max_size=3, unique=True))
    found = [draw(layers(i)) for i in ids]
    for i, layer in enumerate(found):
        carriers = st.sampled_from([None, *(other.id for other in found[:i])])
        found[i] = replace(layer, carrier=draw(carriers))
    return Document(
        tuple(found),
        draw(st.floats(LEAST_RATE, MOST_RATE)),
        (draw(SIDES), draw(SIDES)),
        draw(COLOURS),
    )
