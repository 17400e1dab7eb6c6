"""An export as one piece of work: what is not solved yet is solved, then the frames are written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from app.jobs.solve_all import solve_all
from app.render.film import DocumentFilm
from app.render.formats import ExportFormat
from core.io.exporters import Size
from core.model import Document
from core.morph.scene import Span
from core.progress import Progress

if TYPE_CHECKING:
    from core.morph.morph import Morph

SOLVING = 0.5
"""The share of solving in the progress, if there is something to solve."""


@dataclass(frozen=True)
class Export:
    """What to write, and where."""

    document: Document
    frames: tuple[int, int]
    format: ExportFormat
    folder: Path
    stem: str
    size: Size | None = None
    background: str | None = None
    """In place of the document's own; "" is transparent."""

    @property
    def count(self) -> int:
        """How many files that makes."""
        return self.format.count(self._film({}))

    def path(self, index: int) -> Path:
        """Return where one of them is written."""
        return self.folder / self.format.file_name(self._film({}), self.stem, index)

    def run(self, known: Mapping[Span, Morph], progress: Progress) -> list[Path]:
        """Write the files, all or none, and return their paths; ``known`` are exact solutions."""
        share = 0.0

        def solving(fraction: float, stage: str) -> None:
            nonlocal share
            share = SOLVING
            progress(SOLVING * fraction, stage)

        def writing(fraction: float, stage: str) -> None:
            progress(share + (1 - share) * fraction, stage)

        solved = solve_all(self.document, self.frames, known, solving)
        return self.format.export(self._film(solved), self.folder, self.stem, self.size, writing)

    def _film(self, solved: Mapping[Span, Morph]) -> DocumentFilm:
        return DocumentFilm(self.document, self.frames, solved.get, self.background)
