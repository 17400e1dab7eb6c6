"""One animated picture of all frames, to look at and to send."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from core.errors import FileError
from core.io.exporters import Film, Size
from core.io.exporters.apng import ApngWriter, Pixels
from core.io.naming import file_in
from core.io.replacing import staging
from core.model.picture import Picture
from core.progress import Progress


class AnimationFormat:
    """An animated PNG: all colours, transparent where nothing is, repeated without end."""

    key = "apng"
    """Its name on the command line."""
    name = "Animated PNG, one file"
    suffix = ".png"
    paints = True
    """Size and background mean something to it."""

    def count(self, film: Film) -> int:
        """Return one: it is a single file, whatever the frames."""
        return 1

    def file_name(self, film: Film, stem: str, index: int) -> str:
        """Return what it is called."""
        return f"{stem}{self.suffix}"

    def export(
        self, film: Film, folder: Path, stem: str, size: Size | None, progress: Progress
    ) -> list[Path]:
        """Write every picture of a film into one file, or none; return its path."""
        pictures = film.pictures
        if not pictures:
            raise FileError("There is no frame to export.")
        name = self.file_name(film, stem, 0)
        with staging(folder) as draft:
            with file_in(draft, name).open("wb") as file:
                writer = ApngWriter(file, len(pictures), film.fps)
                for i, picture in enumerate(pictures):
                    progress(i / len(pictures), f"Frame {i + 1} of {len(pictures)}")
                    writer.add(pixels(picture, size))
                writer.end()
            progress(1.0, "Done")
        return [folder / name]


def pixels(picture: Picture, size: Size | None = None) -> Pixels:
    """Return a picture as (height, width, 4) of red, green, blue and alpha, not multiplied."""
    from PySide6.QtGui import QImage

    from app.render.painter import render_image

    image = render_image(picture, size).convertToFormat(QImage.Format.Format_RGBA8888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 4 * image.width()].reshape(image.height(), image.width(), 4).copy()


ANIMATION = AnimationFormat()
