"""Every span that an export needs, solved in one go."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from core.errors import MorphError
from core.model import Document, Layer
from core.morph.scene import Span, solve_span, span_of
from core.progress import Progress, part, silent

if TYPE_CHECKING:
    from core.morph.morph import Morph


def solve_all(
    document: Document,
    frames: tuple[int, int] | None = None,
    known: Mapping[Span, Morph] | None = None,
    progress: Progress = silent,
) -> dict[Span, Morph]:
    """Solve the spans of the visible layers that show between two frames, or all of them.

    Of a layer that others hang on, every span may count.
    ``known`` are exact solutions that need no repeating. An error names the layer and the frames.
    """
    solved, frames = dict(known or {}), frames or document.frames
    carriers = {layer.carrier for layer in document.layers}
    needed = {
        span_of(layer, index): (layer, index)
        for layer in document.moving
        for index in _spans(layer, document.frames if layer.id in carriers else frames)
    }
    missing = {span: place for span, place in needed.items() if span not in solved}
    for done, (span, (layer, index)) in enumerate(missing.items()):
        report = part(progress, done, len(missing))
        report(0.0, "outlines")  # a map that is remembered tells nothing of its own
        try:
            solved[span] = solve_span(span, report)
        except MorphError as error:
            first, last = (key.frame for key in layer.keyframes[index : index + 2])
            what = f"Layer “{layer.name}”, frames {first} to {last}: {error.what}"
            raise type(error)(what, where=error.where, hint=error.hint) from error
    return {span: solved[span] for span in needed}


def _spans(layer: Layer, frames: tuple[int, int]) -> range:
    first, last = (layer.span_at(frame)[0] for frame in frames)
    return range(first, min(last + 1, layer.spans))
