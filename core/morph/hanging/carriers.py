"""Where the layers of a document are carried."""

from __future__ import annotations

from itertools import pairwise
from math import inf
from typing import Generic
from weakref import ref

from core.model import Document, Layer
from core.model.outline import Array
from core.morph.hanging.rigid import STILL, RigidMotion
from core.morph.hanging.run import Phase, Run
from core.morph.morph import Morph
from core.morph.scene import R, RenditionOf, Span, span_of


class Carriers(Generic[R]):
    """The motions that layers get from their carriers, for one document.

    What is found for a layer is kept for those that hang on it, and with it the solutions shown.
    """

    def __init__(self, document: Document, rendition_of: RenditionOf[R]) -> None:
        self._document, self._rendition_of = document, rendition_of
        self._runs: dict[int, Run] = {}
        self._renditions: dict[Morph, R] = {}
        self._last: dict[Morph, tuple[float, Array]] = {}

    def __call__(self, layer: Layer, frame: float) -> RigidMotion:
        """Return what moves a layer's own frame to where it is carried."""
        if layer.carrier is None:
            return STILL
        run = self.run(layer)
        return run.motion(run.index(frame), frame, self._seen)

    def run(self, layer: Layer) -> Run:
        """Return a layer through all time, as far as it is solved."""
        if layer.id not in self._runs:
            self._runs[layer.id] = self._run(layer)
        return self._runs[layer.id]

    def _run(self, layer: Layer) -> Run:
        keys = layer.keyframes
        carrier = None
        if layer.carrier is not None:
            carrier = self.run(self._document.layer(layer.carrier))
        passes = [
            layer.passes(index) and (carrier is None or carrier.smooth(key.frame))
            for index, key in enumerate(keys)
        ]
        phases = [Phase(-inf, keys[0].frame, keys[0].outline, keys[0].frame)]
        for span, (key, later) in enumerate(pairwise(keys)):
            easing, ends = layer.easing_of(span), (passes[span], passes[span + 1])
            morph = None if easing.hold else self._morph_of(span_of(layer, span))
            solution = None if morph is None else ref(morph)
            phases.append(
                Phase(key.frame, later.frame, key.outline, key.frame, easing, solution, ends)
            )
        phases.append(Phase(keys[-1].frame, inf, keys[-1].outline, keys[-1].frame))
        return Run(tuple(phases), carrier)

    def _morph_of(self, span: Span) -> Morph | None:
        rendition = self._rendition_of(span)
        if rendition is None:
            return None
        self._renditions[rendition.morph] = rendition
        return rendition.morph

    def _seen(self, morph: Morph, s: float) -> Array:
        if morph not in self._last or self._last[morph][0] != s:
            self._last[morph] = s, self._renditions[morph].at(s)
        return self._last[morph][1]
