"""What hangs on other layers is joined to them in the background, before it is seen."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Self

from core.model import Document
from core.morph.scene import MorphOf, Span, carrying
from core.progress import Progress

if TYPE_CHECKING:
    from core.morph.morph import Morph


@dataclass(frozen=True, eq=False)
class Joining:
    """A document, and what is solved of it."""

    document: Document
    solutions: Mapping[Span, Morph]
    frame: float
    """What is seen near it comes first."""

    @classmethod
    def of(
        cls, document: Document, spans: Iterable[Span], morph_of: MorphOf, frame: float
    ) -> Self | None:
        """Return what is to be joined in a document with these spans; None where nothing hangs."""
        if all(layer.carrier is None for layer in document.layers):
            return None
        found = ((span, morph_of(span)) for span in spans)
        solutions = {span: morph for span, morph in found if morph is not None}
        return cls(document, solutions, frame)

    def same_as(self, other: Joining | None) -> bool:
        """Whether all joints are the same."""
        return (
            other is not None
            and self.document is other.document
            and self.solutions == other.solutions
        )


def join(task: Joining, progress: Progress) -> None:
    """Look at everything that hangs once between any two keys: the joints are remembered."""
    layers = task.document.layers
    hanging = [layer for layer in layers if layer.carrier is not None and layer.visible]
    keys = sorted({key.frame for layer in layers for key in layer.keyframes})
    moments = [(here + there) / 2 for here, there in pairwise(keys)]
    carry = carrying(task.document, task.solutions.get)
    for done, frame in enumerate(sorted(moments, key=lambda moment: abs(moment - task.frame))):
        progress(done / len(moments), "joints")
        for layer in hanging:
            carry(layer, frame)
