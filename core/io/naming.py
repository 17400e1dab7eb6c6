"""What a file can be called."""

from __future__ import annotations

import os
from pathlib import Path

from core.errors import FileError


def require_name(path: Path | str) -> None:
    """Refuse what no system takes as a name: half a character, or the one that ends names."""
    try:
        possible = b"\0" not in os.fsencode(path)
    except UnicodeEncodeError:
        possible = False
    if not possible:
        raise FileError(f"No file can have the name {str(path)!r}.")


def file_in(folder: Path, name: str) -> Path:
    """Return the path of a file in a folder; FileError for a name that leads out of it."""
    if Path(name).name != name:
        raise FileError(f"{name!r} is not the name of a file.", hint="Leave the folder out of it.")
    return folder / name
