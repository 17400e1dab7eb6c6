"""Picture sequences: one file a frame, all of them or none."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from core.errors import FileError
from core.io.exporters.film import LONGEST_SIDE, Film, Size
from core.io.naming import file_in
from core.io.replacing import staging
from core.model.picture import Picture
from core.progress import Progress, silent

Write = Callable[[Picture, Path, Size | None], None]
"""Writes one picture, fitted into a size, or at the document's own."""


def export_sequence(
    pictures: Sequence[Picture],
    folder: Path,
    stem: str,
    suffix: str,
    write: Callable[[Picture, Path], None],
    progress: Progress = silent,
) -> list[Path]:
    """Write ``stem-0001.suffix`` and so on, numbered by frame; return the paths.

    They appear in the folder together, when the last is written; after an error, or when
    ``progress`` raises, there is none, and files of the same names are as they were.
    """
    if not pictures:
        raise FileError("There is no frame to export.")
    names = []
    with staging(folder) as draft:
        for i, picture in enumerate(pictures):
            progress(i / len(pictures), f"Frame {i + 1} of {len(pictures)}")
            name = _numbered(stem, picture.frame, suffix)
            write(picture, file_in(draft, name))
            names.append(name)
        progress(1.0, "Done")
    return [folder / name for name in names]


def _numbered(stem: str, frame: float, suffix: str) -> str:
    return f"{stem}-{frame:04.0f}{suffix}"


@dataclass(frozen=True)
class SequenceFormat:
    """A format that holds one picture a file."""

    key: str
    """Its name on the command line."""
    name: str
    suffix: str
    write: Write
    paints = True
    """Size and background mean something to it."""

    def count(self, film: Film) -> int:
        """Return how many files a film makes."""
        first, last = film.frames
        return last - first + 1

    def file_name(self, film: Film, stem: str, index: int) -> str:
        """Return what one of these files is called."""
        return _numbered(stem, film.frames[0] + index, self.suffix)

    def export(
        self, film: Film, folder: Path, stem: str, size: Size | None, progress: Progress
    ) -> list[Path]:
        """Write every picture of a film; see ``export_sequence``."""
        if size and not all(1 <= side <= LONGEST_SIDE for side in size):
            raise FileError(
                f"A picture cannot have {size[0]} x {size[1]} pixels.",
                hint=f"Choose 1 to {LONGEST_SIDE} for each side.",
            )

        def write(picture: Picture, path: Path) -> None:
            self.write(picture, path, size)

        return export_sequence(film.pictures, folder, stem, self.suffix, write, progress)
