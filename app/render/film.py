"""A document between two frames, as exporters see it: the same for the editor and a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Generic, TypeVar, overload

import numpy as np

from core.io.exporters import MovingMesh
from core.model import Document, Layer
from core.model.outline import Array
from core.model.picture import Picture
from core.morph.scene import Carry, MorphOf, carrying, layer_rings, picture_at, span_of

if TYPE_CHECKING:
    from core.morph.morph import Morph

T = TypeVar("T")


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
        first, last = self.frames
        return _Computed(self.picture, range(first, last + 1))

    @property
    def fps(self) -> float:
        """Frames a second."""
        return self.document.fps

    @property
    def meshes(self) -> Sequence[MovingMesh]:
        """The meshes of the visible layers, one a span."""
        return [mesh for layer in self.document.layers if layer.visible for mesh in self._of(layer)]

    @property
    def mesh_count(self) -> int:
        """How many meshes that are; each span has a frame of its own."""
        ends = [
            [layer.span_at(frame)[0] for frame in self.frames]
            for layer in self.document.layers
            if layer.visible
        ]
        return sum(last - first + 1 for first, last in ends)

    def picture(self, frame: int) -> Picture:
        """Return one frame."""
        picture = picture_at(self.document, frame, self.morph_of)
        return picture if self.background is None else replace(picture, background=self.background)

    def _of(self, layer: Layer) -> Iterator[MovingMesh]:
        first, last = self.frames
        by_span: dict[int, list[int]] = {}
        for frame in range(first, last + 1):
            by_span.setdefault(layer.span_at(frame)[0], []).append(frame)
        carry = carrying(self.document, self.morph_of)
        for span, frames in by_span.items():
            morph = self.morph_of(span_of(layer, span)) if layer.spans else None
            times = [(frame - 1) / self.document.fps for frame in frames]
            if morph is None:  # one keyframe: there is no mesh
                rings = layer_rings(self.document, layer, frames[0], self.morph_of)
                triangles, boundary = np.empty((0, 3), dtype=int), _consecutive(rings)
                place = partial(self._outline, layer)
            else:
                triangles, boundary = morph.triangles, morph.rings
                place = partial(_vertices, self.document, layer, morph, carry)
            yield MovingMesh(
                layer.name, _Computed(place, frames), triangles, boundary, frames, times
            )

    def _outline(self, layer: Layer, frame: int) -> Array:
        """Return the vertices of a layer without a mesh, ring after ring."""
        drawn = self.document.drawn_at(frame)
        return np.concatenate(layer_rings(self.document, layer, drawn, self.morph_of))


def _vertices(document: Document, layer: Layer, morph: Morph, carry: Carry, frame: int) -> Array:
    """Return the vertices of a layer's mesh at a frame."""
    drawn = document.drawn_at(frame)
    return carry(layer, drawn)(morph.at(layer.progress_at(drawn)[1]))


class _Computed(Sequence[T], Generic[T]):
    """One item a frame, computed when it is asked for, so that a long film needs no memory."""

    def __init__(self, compute: Callable[[int], T], frames: Sequence[int]) -> None:
        self._compute, self._frames = compute, frames

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, index: int) -> T: ...
    @overload
    def __getitem__(self, index: slice) -> list[T]: ...
    def __getitem__(self, index: int | slice) -> T | list[T]:
        if isinstance(index, slice):
            return [self._compute(frame) for frame in self._frames[index]]
        return self._compute(self._frames[index])


def _consecutive(rings: Sequence[Array]) -> tuple[Array, ...]:
    """Return index arrays that count through the vertices ring after ring."""
    ends = np.cumsum([len(ring) for ring in rings])
    return tuple(np.split(np.arange(ends[-1]), ends[:-1]))
