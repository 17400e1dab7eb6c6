"""What an export format is given."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from core.model.outline import Array
from core.model.picture import Picture

Size = tuple[int, int]
"""Width and height in pixels."""
LONGEST_SIDE = 16_384
"""Of an exported picture, in pixels."""


@dataclass(frozen=True, eq=False)
class MovingMesh:
    """One moving mesh: a layer from one keyframe to the next."""

    layer: str
    """The layer's name."""
    positions: Sequence[Array]
    """(frames,) of (n, 2) vertices; each may be computed when it is asked for."""
    triangles: Sequence[Sequence[int]]
    """(m, 3) vertex indices."""
    rings: Sequence[Sequence[int]]
    """The boundary as vertex indices, exterior first."""
    frames: Sequence[int]
    """(frames,) frame numbers."""
    times: Sequence[float]
    """(frames,) seconds since frame 1."""


class Film(Protocol):
    """Frames to export; they are computed when they are asked for."""

    @property
    def frames(self) -> tuple[int, int]:
        """The first and the last frame."""

    @property
    def pictures(self) -> Sequence[Picture]:
        """Every frame as it is seen."""

    @property
    def fps(self) -> float:
        """Frames a second."""

    @property
    def meshes(self) -> Sequence[MovingMesh]:
        """The meshes that make the frames."""

    @property
    def mesh_count(self) -> int:
        """How many there are, which is known before any is solved."""
