"""A layer: one shape through time, its keyframes in order, and the marks that they share."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import count, product
from math import inf
from string import ascii_lowercase

from core.model.easing import LINEAR, Easing
from core.model.outline import Outline, RingPoint
from core.model.recipe import Recipe
from core.model.style import Style
from core.model.turning import AS_DRAWN, Turning


@dataclass(frozen=True)
class Keyframe:
    """An outline at a frame, the layer's marks on it, and how the span after it eases and turns."""

    frame: int
    outline: Outline
    marks: tuple[RingPoint, ...] = ()
    """One place for each of the layer's marks, in their order."""
    easing: Easing = LINEAR
    turning: Turning = AS_DRAWN
    passes: bool = False
    """Whether the motion is to pass through it; see ``Layer.passes``."""


@dataclass(frozen=True)
class Layer:
    """Keyframes are ordered by frame, one a frame; a span lies between each two neighbours."""

    id: int
    name: str
    keyframes: tuple[Keyframe, ...]
    labels: tuple[str, ...] = ()
    """The letters of the marks; every keyframe has a place for each."""
    style: Style = field(default_factory=Style)
    recipe: Recipe = field(default_factory=Recipe)
    visible: bool = True
    locked: bool = False
    carrier: int | None = None
    """The id of the layer that this one hangs on: it carries this one along between keys."""

    @property
    def spans(self) -> int:
        """How many spans there are."""
        return max(len(self.keyframes) - 1, 0)

    @property
    def next_label(self) -> str:
        """The letter that the next mark gets."""
        return next(label for label in mark_labels() if label not in self.labels)

    def span_at(self, frame: float) -> tuple[int, float]:
        """Return the span that covers a frame and t in it, both clamped to the layer's keys.

        A key belongs to the span that it begins; the last key ends the last span at t = 1. A layer
        with one key answers (0, 0.0).
        """
        if self.spans == 0:
            return 0, 0.0
        frames = [key.frame for key in self.keyframes]
        index = min(max(bisect_right(frames, frame) - 1, 0), self.spans - 1)
        t = (frame - frames[index]) / (frames[index + 1] - frames[index])
        return index, min(max(t, 0.0), 1.0)

    def passes(self, key: int) -> bool:
        """Return whether the motion passes through a keyframe rather than ends and starts anew.

        Shape and time run on: both spans have one velocity there, and neither's easing slows it.
        """
        return self.passable(key) and self.keyframes[key].passes

    def passable(self, key: int) -> bool:
        """Return whether there is motion on both sides of a keyframe that could pass through it.

        It must be rigid: only its gradients can have the velocity of both sides.
        """
        held = any(other.easing.hold for other in self.keyframes[max(key - 1, 0) : key + 1])
        return 0 < key < self.spans and self.recipe.method == "arap" and not held

    def easing_of(self, span: int) -> Easing:
        """Return the easing of a span, even where the motion passes through its keys."""
        easing = self.keyframes[span].easing
        return easing.even_at(self.passes(span), self.passes(span + 1))

    def progress_at(self, frame: float) -> tuple[int, float]:
        """Return the span that covers a frame, and s in it: how far its shape has come."""
        index, t = self.span_at(frame)
        return index, self.easing_of(index)(t)

    def room(self, key: int) -> tuple[float, float]:
        """Return the least and the greatest frame that a keyframe can have between its neighbours.

        They are infinite where there is no neighbour.
        """
        before, after = self.keyframes[:key], self.keyframes[key + 1 :]
        return (
            before[-1].frame + 1 if before else -inf,
            after[0].frame - 1 if after else inf,
        )

    def key_at(self, frame: float) -> int | None:
        """Return the index of the keyframe at exactly this frame, if there is one."""
        return next((i for i, key in enumerate(self.keyframes) if key.frame == frame), None)


def mark_labels() -> Iterator[str]:
    """Yield a, b, … z, aa, ab, … without end."""
    for length in count(1):
        for letters in product(ascii_lowercase, repeat=length):
            yield "".join(letters)
