"""A document between two frames, as exporters see it: the same for the editor and a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import overload

import numpy as np

from core.io.exporters import Track
from core.model import Document, Layer
from core.model.outline import Array
from core.model.picture import Picture
from core.morph.scene import MorphOf, carrying, layer_rings, picture_at, span_of


@dataclass(frozen=True, eq=False)
class DocumentFilm:
    """The frames first to last of a document; ``morph_of`` must know every span they need."""

    document: Document
    frames: tuple[int, int]
    morph_of: MorphOf
    background: str | None = None
    """In place of the document's own; "" is transparent."""

    @property
    def pictures(self) -> Sequence[Picture]:
        """Every frame as it is seen."""
        return _Pictures(self)

    @cached_property
    def tracks(self) -> Sequence[Track]:
        """The meshes of the visible layers, one a span."""
        return [
            track for layer in self.document.layers if layer.visible for track in self._of(layer)
        ]

    def picture(self, frame: int) -> Picture:
        """Return one frame."""
        picture = picture_at(self.document, frame, self.morph_of)
        return picture if self.background is None else replace(picture, background=self.background)

    def _of(self, layer: Layer) -> Iterator[Track]:
        first, last = self.frames
        by_span: dict[int, dict[int, float]] = {}
        for frame in range(first, last + 1):
            span, s = layer.progress_at(frame)
            by_span.setdefault(span, {})[frame] = s
        carry = carrying(self.document, self.morph_of)
        for span, progress in by_span.items():
            frames = list(progress)
            morph = self.morph_of(span_of(layer, span)) if layer.spans else None
            times = [(frame - 1) / self.document.fps for frame in frames]
            if morph is None:  # one keyframe: there is no mesh
                shown = [layer_rings(self.document, layer, f, self.morph_of) for f in frames]
                positions, rings = np.stack([np.concatenate(rings) for rings in shown]), shown[0]
                triangles = np.empty((0, 3), dtype=int)
                boundary = _consecutive(rings)
            else:
                positions = np.stack(
                    [carry(layer, frame)(morph.at(s)) for frame, s in progress.items()]
                )
                triangles, boundary = morph.triangles, morph.rings
            yield Track(layer.name, positions, triangles, boundary, frames, times)


class _Pictures(Sequence[Picture]):
    """Pictures that are computed when they are asked for, so that a long film needs no memory."""

    def __init__(self, film: DocumentFilm) -> None:
        self._film = film
        self._frames = range(film.frames[0], film.frames[1] + 1)

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, index: int) -> Picture: ...
    @overload
    def __getitem__(self, index: slice) -> list[Picture]: ...
    def __getitem__(self, index: int | slice) -> Picture | list[Picture]:
        if isinstance(index, slice):
            return [self._film.picture(frame) for frame in self._frames[index]]
        return self._film.picture(self._frames[index])


def _consecutive(rings: Sequence[Array]) -> tuple[Array, ...]:
    """Return index arrays that count through the vertices ring after ring."""
    ends = np.cumsum([len(ring) for ring in rings])
    return tuple(np.split(np.arange(ends[-1]), ends[:-1]))
