"""How all keyframes of a layer belong together: mates of a mark, and marks worth having."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from core.model import Keyframe, RingPoint
from core.morph.suggest import OutlineMatch, match_outlines
from core.progress import Progress, silent

Proposed = Sequence[tuple[RingPoint, RingPoint, float]]
"""Marks between two outlines, with their confidence in [0, 1]."""
SURE = 0.25
"""Confidence of places that stand out on both outlines; along smooth arcs there is less."""


@dataclass(frozen=True)
class Suggestion:
    """A mark that is worth having, ready to be added to the layer."""

    places: tuple[RingPoint, ...]
    """One on every keyframe."""
    confidence: float

    @property
    def sure(self) -> bool:
        """Whether it is at a place that stands out, as corners and tips do."""
        return self.confidence >= SURE


@dataclass(frozen=True, eq=False)
class LayerMatch:
    """Every keyframe matched with the next, through the marks that they have."""

    keyframes: tuple[Keyframe, ...]
    spans: tuple[OutlineMatch, ...]

    def mates(self, known: Mapping[int, RingPoint]) -> tuple[RingPoint, ...]:
        """Return a mark's place on every keyframe, from where it is on adjacent ones."""
        places = dict(known)
        for k in range(max(known), len(self.spans)):
            places[k + 1] = self.spans[k].mate(places[k])
        for k in range(min(known), 0, -1):
            places[k - 1] = self.spans[k - 1].reversed().mate(places[k])
        return tuple(places[k] for k in range(len(self.keyframes)))

    def suggestions(self, span: int, proposed: Proposed = ()) -> tuple[Suggestion, ...]:
        """Return the marks worth having in a span: those ``proposed``, and others on other rings.

        They come in order along the rings, those that stand out before the others.
        A mark that would fall upon another on some keyframe is not among them.
        """
        settled = {here.ring for here, _, _ in proposed}
        others = (p for p in self.spans[span].proposals() if p[0].ring not in settled)
        taken = {(k, place) for k, key in enumerate(self.keyframes) for place in key.marks}
        found = []
        for here, there, confidence in (*proposed, *others):
            places = self.mates({span: here, span + 1: there})
            if taken.isdisjoint(enumerate(places)):
                taken.update(enumerate(places))
                found.append(Suggestion(places, confidence))
        return tuple(sorted(found, key=lambda suggestion: not suggestion.sure))


def match_layer(
    keyframes: tuple[Keyframe, ...],
    span: int = 0,
    proposed: Proposed = (),
    progress: Progress = silent,
) -> LayerMatch:
    """Match each keyframe with the next one, through the marks that they have.

    ``span`` is led through ``proposed`` too: the marks that it was solved with where it had none.
    Raises whatever ``progress`` raises.
    """
    matches = []
    for k, (source, target) in enumerate(pairwise(keyframes)):
        progress(k / len(keyframes), "matching")
        marks = list(zip(source.marks, target.marks, strict=True))
        marks += [(here, there) for here, there, _ in proposed] if k == span else []
        matches.append(match_outlines(source.outline, target.outline, marks))
    return LayerMatch(keyframes, tuple(matches))
