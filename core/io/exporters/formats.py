"""What an export format is, and what it is given."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

from core.io.exporters.vertices import Track
from core.model.picture import Picture
from core.progress import Progress

Size = tuple[int, int]
"""Width and height in pixels."""


class Film(Protocol):
    """Frames to export; computed when they are asked for."""

    @property
    def stem(self) -> str:
        """What the files' names begin with."""

    @property
    def pictures(self) -> Sequence[Picture]:
        """Every frame as it is seen."""

    @property
    def tracks(self) -> Sequence[Track]:
        """The moving meshes."""


class ExportFormat(Protocol):
    """A format that frames are written in."""

    key: str
    """What it is called on the command line."""
    name: str
    paints: bool
    """Whether size and background mean anything to it."""

    def export(
        self, film: Film, folder: Path, size: Size | None, progress: Progress
    ) -> list[Path]: ...
