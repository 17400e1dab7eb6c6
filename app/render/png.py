"""PNG pictures. Qt is imported with the first frame, so that other formats do without it."""

from __future__ import annotations

from pathlib import Path

from core.errors import FileError, Where
from core.io.exporters import Size
from core.io.exporters.sequence import SequenceFormat
from core.io.replacing import replacing
from core.model.picture import Picture


def write_picture(picture: Picture, path: Path, size: Size | None = None) -> None:
    """Write a picture, fitted into a size in pixels; without one it has the document's."""
    from app.render.painter import render_image

    image = render_image(picture, size)
    with replacing(path, flush=False) as draft:
        if not image.save(str(draft), "PNG"):
            raise FileError(
                "The image cannot be written.",
                where=Where(path=str(path)),
                hint="Check the free space.",
            )


PNG = SequenceFormat("png", "PNG sequence", ".png", write_picture)
