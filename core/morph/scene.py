"""From a document and its solved spans to the picture at a frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol, TypeVar

from core.geometry.flatten import flatten
from core.geometry.places import nearest_place
from core.model import Document, Easing, Keyframe, Layer, Outline, Recipe, RingPoint, Turning
from core.model.outline import Array
from core.model.picture import Picture, Shape
from core.model.turning import AS_DRAWN
from core.morph.hanging.rigid import STILL, RigidMotion
from core.progress import Progress, silent

if TYPE_CHECKING:
    from core.geometry.triangulation import Indices
    from core.morph.morph import Morph


@dataclass(frozen=True)
class Passage:
    """A key that the motion passes through: what lies beyond it."""

    beyond: Span
    """The span on the key's other side, by itself."""
    duration: float
    """How long that span lasts, in durations of this one."""


@dataclass(frozen=True)
class Span:
    """All that the solution between two neighbouring keyframes depends on; compared by value."""

    source: Outline
    target: Outline
    marks: tuple[tuple[RingPoint, RingPoint], ...]
    labels: tuple[str, ...]
    """The letters of the marks, for messages."""
    recipe: Recipe
    turning: Turning = AS_DRAWN
    before: Passage | None = None
    after: Passage | None = None
    """What the motion passes to and from at its ends; None where it starts or ends there."""

    @property
    def map(self) -> Span:
        """What the map depends on, however the shape moves."""
        return replace(self, turning=AS_DRAWN, before=None, after=None)


@dataclass(frozen=True)
class TimedSpan:
    """A span and when it is seen; compared by value."""

    span: Span
    first: int
    last: int
    easing: Easing

    def frames(self) -> list[tuple[int, float]]:
        """Return every frame from key to key, and s at it."""
        return [(frame, self.progress(frame)) for frame in range(self.first, self.last + 1)]

    def progress(self, frame: int) -> float:
        """Return s at a frame."""
        return self.easing((frame - self.first) / (self.last - self.first))


class Rendition(Protocol):
    """What is seen of a solution."""

    @property
    def morph(self) -> Morph:
        """The solution itself."""

    @property
    def rings(self) -> tuple[Indices, ...]:
        """The boundary as vertex indices, exterior first."""

    def at(self, s: float) -> Array:
        """Return positions (n, 2) at progress s."""
        ...


R = TypeVar("R", bound=Rendition)
RenditionOf = Callable[[Span], R | None]
"""Looks up what is seen of a span's solution; None while there is none."""
MorphOf = Callable[[Span], "Morph | None"]
"""Looks a span's solution up; None while there is none."""
Carry = Callable[[Layer, float], RigidMotion]
"""Called with a layer and a frame number: returns the rigid motion that its carrier gives it."""


def span_of(layer: Layer, index: int) -> Span:
    """Return what span ``index`` of a layer depends on."""
    return replace(
        _by_itself(layer, index),
        before=_passage(layer, index, index - 1) if layer.passes(index) else None,
        after=_passage(layer, index, index + 1) if layer.passes(index + 1) else None,
    )


def _passage(layer: Layer, index: int, other: int) -> Passage:
    lengths = [layer.keyframes[i + 1].frame - layer.keyframes[i].frame for i in (index, other)]
    return Passage(_by_itself(layer, other), lengths[1] / lengths[0])


def _by_itself(layer: Layer, index: int) -> Span:
    source, target = layer.keyframes[index : index + 2]
    pairs = tuple(zip(source.marks, target.marks, strict=True))
    return Span(source.outline, target.outline, pairs, layer.labels, layer.recipe, source.turning)


def timed_span_of(layer: Layer, index: int) -> TimedSpan:
    """Return span ``index`` of a layer and its timing."""
    source, target = layer.keyframes[index : index + 2]
    easing = layer.easing_of(index)
    return TimedSpan(span_of(layer, index), source.frame, target.frame, easing)


def solve_span(span: Span, progress: Progress = silent) -> Morph:
    """Solve one span; the errors and progress are those of ``solve_outlines``.

    Maps are remembered for a while: to move a shape another way takes next to no time.
    """
    from core.morph.solved import solve  # scipy loads with the first solve, not before

    return solve(span, progress)


def layer_rings(
    document: Document, layer: Layer, frame: float, rendition_of: RenditionOf[R]
) -> tuple[Array, ...]:
    """Return what a layer shows at a frame, as closed polylines (k, 2), exterior first.

    Between keys it is the in-between at the eased time; a key, and a span that has no solution
    yet, shows the keyframe's own outline. What it hangs on carries it along.
    """
    return _rings(layer, frame, rendition_of, carrying(document, rendition_of))


def picture_at(document: Document, frame: float, rendition_of: RenditionOf[R]) -> Picture:
    """Return the visible layers at a frame: the drawing that is held there."""
    carry, drawn = carrying(document, rendition_of), document.drawn_at(frame)
    shapes = tuple(
        Shape(layer.id, layer.name, layer.style, _rings(layer, drawn, rendition_of, carry))
        for layer in document.layers
        if layer.visible
    )
    return Picture(frame, document.size, document.background, shapes)


def carrying(document: Document, rendition_of: RenditionOf[R]) -> Carry:
    """Return a function that gives the motion of any layer with its carrier."""
    if all(layer.carrier is None for layer in document.layers):
        return lambda layer, frame: STILL
    from core.morph.hanging.carriers import Carriers  # shapely loads where layers hang, not before

    return Carriers(document, rendition_of)


def turn_of(document: Document, layer: Layer, index: int, morph_of: MorphOf) -> float | None:
    """Return how far span ``index`` turns, as seen from what the layer hangs on, if anything.

    In radians, clockwise positive; None while that is not known.
    """
    morph = morph_of(span_of(layer, index))
    if morph is None or layer.carrier is None:
        return None if morph is None else morph.angle
    from core.morph.hanging.carriers import Carriers

    carriers = Carriers(document, morph_of)
    return carriers.run(layer).turn(index)


def keyframe_at(
    document: Document, layer: Layer, frame: int, morph_of: MorphOf
) -> tuple[Keyframe, Turning]:
    """Return what the layer shows at a frame as a keyframe of its own, to be inserted there.

    The in-between becomes an outline that can be edited, with every mark at its place on it.
    Outside the layer's keys, and in a span without a solution, the nearest key is repeated where it
    is carried. Beside it comes how the shape turns on the way there from now on.
    """
    index, s, morph = _shown(layer, frame, morph_of)
    turning, moved = layer.keyframes[index].turning, carrying(document, morph_of)(layer, frame)
    if morph is None:
        key = _nearest_key(layer, index, s)
        outline = key.outline.transformed(moved.matrix, moved.offset)
        return replace(key, frame=frame, outline=outline), turning
    from core.morph.redrawn import redrawn

    (source, target), positions = layer.keyframes[index : index + 2], moved(morph.at(s))
    rest = Outline.polygon(*(morph.rest[ring] for ring in morph.rings))
    travelled = Outline.polygon(*(positions[ring] for ring in morph.rings))
    outline = redrawn(morph, positions, source.outline, target.outline)
    marks = tuple(
        nearest_place(outline, travelled.position(place))[0]
        for place, _ in (nearest_place(rest, source.outline.position(m)) for m in source.marks)
    )  # same vertices, so a place at rest is the place in the in-between
    angle = turn_of(document, layer, index, morph_of)
    before, after = turning.split(morph.angle if angle is None else angle, s)
    return Keyframe(frame, outline, marks, turning=after), before


def _rings(
    layer: Layer, frame: float, rendition_of: RenditionOf[R], carry: Carry
) -> tuple[Array, ...]:
    index, s, rendition = _shown(layer, frame, rendition_of)
    if rendition is None:
        rings = tuple(line.points for line in flatten(_nearest_key(layer, index, s).outline))
    else:
        positions = rendition.at(s)
        rings = tuple(positions[ring] for ring in rendition.rings)
    return tuple(map(carry(layer, frame), rings))


def _shown(layer: Layer, frame: float, rendition_of: RenditionOf[R]) -> tuple[int, float, R | None]:
    """Return the span at a frame, s in it, and its solution; None where a key itself shows."""
    index, s = layer.progress_at(frame)
    between = s not in (0.0, 1.0)  # an easing may also overshoot
    return index, s, rendition_of(span_of(layer, index)) if between else None


def _nearest_key(layer: Layer, index: int, s: float) -> Keyframe:
    """Return the keyframe that stands for s in a span without a solution."""
    return layer.keyframes[index + (s >= 0.5 and layer.spans > 0)]
