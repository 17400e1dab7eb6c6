"""What every document must satisfy, whatever edit or file it comes from."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import inf

import numpy as np

from core.model.document import Document
from core.model.easing import WILD, Easing
from core.model.layer import Keyframe, Layer
from core.model.outline import MIN_NODES, Outline, RingPoint
from core.model.recipe import LEAST_DENSITY, MOST_DENSITY, Recipe
from core.model.style import Style
from core.model.turning import MOST_TURNS, Turning

MAX_FRAME = 1_000_000
FARTHEST = 1e15
"""Of a node or handle from zero: squares and fourth powers must stay finite."""
LEAST_RATE, MOST_RATE = 0.001, 1000
"""Frames a second: no frame lasts so long, or so short, that no clock can tell."""
LEAST_SIDE, MOST_SIDE = 0.001, 1_000_000
"""Of the artboard: what can be told from a point, and counted in pixels."""
MOST_HOLD = 12
"""Frames that a drawing is held."""
_FAR = f"not a finite number, or further than {FARTHEST:g} from zero"
COLOUR = re.compile(r"(#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?)?")

Problem = tuple[str, str]
"""Where, as in ``layers[0].keyframes[1].marks[2]``, and what is wrong there."""


def problems(document: Document) -> Iterator[Problem]:
    """Yield everything that is wrong with a document's structure; nothing when it is sound."""
    yield from setting_problems(document)
    seen: set[int] = set()
    for i, layer in enumerate(document.layers):
        path = f"layers[{i}]"
        if layer.id in seen:
            yield f"{path}.id", f"{layer.id} is the id of another layer too"
        seen.add(layer.id)
        yield from layer_problems(path, layer)
    yield from carrier_problems(document)


def carrier_problems(document: Document) -> Iterator[Problem]:
    """Yield what is wrong with what layers hang on."""
    carriers = {layer.id: layer.carrier for layer in document.layers}
    for i, layer in enumerate(document.layers):
        above, passed = layer.carrier, {layer.id}
        while above in carriers and above not in passed:
            passed.add(above)
            above = carriers[above]
        if above is not None:
            path = f"layers[{i}].carrier"
            yield path, ("it hangs on itself" if above in passed else f"there is no layer {above}")


def setting_problems(document: Document) -> Iterator[Problem]:
    """Yield what is wrong with a document besides its layers."""
    yield from _between("fps", document.fps, LEAST_RATE, MOST_RATE)
    for i, length in enumerate(document.size):
        yield from _between(f"size[{i}]", length, LEAST_SIDE, MOST_SIDE)
    yield from _colour("background", document.background)
    yield from _between("hold", document.hold, 1, MOST_HOLD)


def layer_problems(path: str, layer: Layer) -> Iterator[Problem]:
    """Yield what is wrong with a layer, which is at ``path`` in the document."""
    yield from _text(f"{path}.name", layer.name)
    yield from _style(f"{path}.style", layer.style)
    yield from _recipe(f"{path}.recipe", layer.recipe)
    for i, label in enumerate(layer.labels):
        yield from _text(f"{path}.labels[{i}]", label)
        if label in layer.labels[:i]:
            yield f"{path}.labels[{i}]", f"the letter {label!r} is used twice"
    if not layer.keyframes:
        yield f"{path}.keyframes", "a layer needs at least one keyframe"
    before = -MAX_FRAME - 1
    for i, key in enumerate(layer.keyframes):
        place = f"{path}.keyframes[{i}]"
        if key.frame <= before:
            yield f"{place}.frame", f"frame {key.frame} does not come after frame {before}"
        before = key.frame
        yield from _keyframe(place, key, layer.labels)


def _keyframe(path: str, key: Keyframe, labels: tuple[str, ...]) -> Iterator[Problem]:
    if abs(key.frame) > MAX_FRAME:
        yield f"{path}.frame", f"frame {key.frame} is further than {MAX_FRAME} from zero"
    yield from _easing(f"{path}.easing", key.easing)
    yield from _turning(f"{path}.turning", key.turning)
    yield from _outline(f"{path}.outline", key.outline)
    if len(key.marks) != len(labels):
        yield f"{path}.marks", f"{len(key.marks)} places for {len(labels)} marks"
    for i, mark in enumerate(key.marks):
        yield from place_problems(f"{path}.marks[{i}]", mark, key.outline)


def _outline(path: str, outline: Outline) -> Iterator[Problem]:
    if not outline.rings:
        yield f"{path}.rings", "an outline needs at least one ring"
    for i, ring in enumerate(outline.rings):
        if len(ring) < MIN_NODES:
            yield f"{path}.rings[{i}].points", f"a ring needs at least {MIN_NODES} nodes"
        for name in ("points", "handles_in", "handles_out"):
            near = (np.abs(getattr(ring, name)) <= FARTHEST).all(axis=1)  # nor is NaN
            for row in np.flatnonzero(~near)[:1]:
                yield f"{path}.rings[{i}].{name}[{row}]", _FAR


def place_problems(path: str, place: RingPoint, outline: Outline) -> Iterator[Problem]:
    """Yield why there is no such place on an outline."""
    if not 0 <= place.ring < len(outline.rings):
        yield f"{path}.ring", f"there is no ring {place.ring}; the outline has {len(outline.rings)}"
        return
    nodes = len(outline.rings[place.ring])
    if not 0 <= place.at <= nodes:  # n: rounded up to node 0
        yield f"{path}.at", f"{place.at} is not on the ring, which runs from 0 to {nodes}"


def _easing(path: str, easing: Easing) -> Iterator[Problem]:
    for name in ("x1", "x2"):
        yield from _between(f"{path}.{name}", getattr(easing, name), 0, 1)
    for name in ("y1", "y2"):
        yield from _between(f"{path}.{name}", getattr(easing, name), -WILD, WILD)


def _turning(path: str, turning: Turning) -> Iterator[Problem]:
    yield from _between(f"{path}.turns", turning.turns, 0, MOST_TURNS)


def _style(path: str, style: Style) -> Iterator[Problem]:
    yield from _colour(f"{path}.fill", style.fill)
    yield from _colour(f"{path}.stroke", style.stroke)
    yield from _between(f"{path}.stroke_width", style.stroke_width, 0, MOST_SIDE)


def _recipe(path: str, recipe: Recipe) -> Iterator[Problem]:
    yield from _between(f"{path}.density", recipe.density, LEAST_DENSITY, MOST_DENSITY)
    if not 0 < recipe.mu < inf:
        yield f"{path}.mu", f"{recipe.mu} is not a positive number"
    if not 0 <= recipe.lam < inf:
        yield f"{path}.lam", f"{recipe.lam} is not zero or positive"


def _between(path: str, value: float, least: float, most: float) -> Iterator[Problem]:
    if not least <= value <= most:  # nor is NaN
        yield path, f"{value} is not between {least} and {most}"


def _colour(path: str, colour: str) -> Iterator[Problem]:
    if not COLOUR.fullmatch(colour):
        yield path, f'{colour!r} is not a colour, which is "#rrggbb", "#rrggbbaa" or empty'


def _text(path: str, text: str) -> Iterator[Problem]:
    try:
        text.encode()
    except UnicodeEncodeError:
        yield path, "the text holds half of a character"
