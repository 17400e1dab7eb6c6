"""Shapes from files: one module a format, behind this registry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from core.errors import FileError, Where
from core.io.importers import points_csv, points_json, svg
from core.io.importers.part import Part, Warn, ignore
from core.io.importers.placing import bounds, fitted
from core.io.reading import read_whole

MAX_BYTES = 64 * 2**20
"""Largest file that is read."""


@dataclass(frozen=True)
class ImportFormat:
    """A format that shapes are read from."""

    name: str
    suffixes: tuple[str, ...]
    read: Callable[[bytes, str, Warn], list[Part]]
    """From the content and a name for what has none of its own to the parts."""

    @property
    def filter(self) -> str:
        """The entry of a file dialog."""
        return f"{self.name} ({' '.join(f'*{suffix}' for suffix in self.suffixes)})"


SVG = ImportFormat("SVG drawing", (".svg",), svg.read)
FORMATS = (
    SVG,
    ImportFormat("Point list", (".csv", ".tsv", ".txt"), points_csv.read),
    ImportFormat("JSON point list", (".json",), points_json.read),
)


def read(path: Path | str, warn: Warn = ignore) -> list[Part]:
    """Return the shapes in a file, at least one; ``warn`` hears what had to be left out.

    FileError when it cannot be read or holds no shape.
    """
    path = Path(path)
    where = Where(path=str(path))
    found = next((f for f in FORMATS if path.suffix.lower() in f.suffixes), None)
    if found is None:
        known = ", ".join(suffix for f in FORMATS for suffix in f.suffixes)
        raise FileError(f"The format is not known; it can be {known}.", where=where)
    data = read_whole(path, MAX_BYTES)
    try:
        return parse(data, path.stem, found, warn)
    except FileError as error:
        raise FileError(error.what, where=where, hint=error.hint) from error


def parse(data: bytes, name: str, form: ImportFormat, warn: Warn = ignore) -> list[Part]:
    """Return the shapes in the content of a file, at least one; FileError where there is none."""
    said: list[str] = []

    def tell(text: str) -> None:
        said.append(text)
        warn(text)

    parts = form.read(data, name, tell)
    if not parts:
        why = " ".join(dict.fromkeys(said))
        raise FileError("The file holds no shape with an area.", hint=why)
    return parts


__all__ = ["FORMATS", "SVG", "ImportFormat", "Part", "Warn", "bounds", "fitted", "parse", "read"]
