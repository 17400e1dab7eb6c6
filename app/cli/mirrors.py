"""The hint that a target should be mirrored."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from app.cli.terminal import complain

if TYPE_CHECKING:
    from core.model import Document
    from core.morph.morph import Morph
    from core.morph.scene import Span

MIRROR_NOTE = "the target matches far better mirrored; the editor offers to mirror it"


def note_mirrors(document: Document, solved: Mapping[Span, Morph]) -> None:
    """Name each solved span whose target would match far better if it were mirrored."""
    from core.morph.scene import span_of

    for layer in document.layers:
        for index in range(layer.spans):
            morph = solved.get(span_of(layer, index))
            if morph is not None and morph.report.mirror:
                first, last = (key.frame for key in layer.keyframes[index : index + 2])
                complain(f"Note: {layer.name}, frames {first} to {last}: {MIRROR_NOTE}.")
