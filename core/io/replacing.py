"""Files that are either whole or not there: written beside their place, then moved onto it."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from core.errors import FileError, Where
from core.io.naming import require_name


@contextmanager
def replacing(path: Path | str, *, flush: bool = True) -> Iterator[Path]:
    """Yield an empty temporary file in the same folder; it replaces ``path`` if all goes well.

    The old file stays untouched until then, and keeps its permissions afterwards. A link is
    followed; folders and devices are not replaced. ``flush`` waits until the disk has it, which is
    slow, and only worth it for what cannot be made again. FileError when the system refuses.
    """
    require_name(path)
    place = Path(os.path.realpath(path))
    draft = place.with_name(f".betwixt-{secrets.token_hex(6)}.tmp")
    try:
        if place.exists() and not place.is_file():
            raise FileError("There is a folder or a device of that name.", where=_at(path))
        draft.touch(exist_ok=False)
        yield draft
        if place.exists():
            shutil.copymode(place, draft)
        if flush:
            _flush(draft)
        os.replace(draft, place)
        if flush:
            _flush(place.parent)
    except OSError as error:
        raise unwritable(path, error) from error
    finally:
        with suppress(OSError):
            draft.unlink(missing_ok=True)


@contextmanager
def staging(folder: Path | str) -> Iterator[Path]:
    """Yield a hidden folder inside ``folder``; its files move there if all goes well.

    Otherwise nothing is left of them: files of the same names stay as they were, and a folder that
    was made for them is gone again. FileError when the system refuses.
    """
    require_name(folder)
    place = Path(folder)
    missing = [path for path in (place, *place.parents) if not path.exists()]
    hidden = place / f".betwixt-{secrets.token_hex(6)}"
    draft, old = hidden / "new", hidden / "old"
    try:
        draft.mkdir(parents=True)
        old.mkdir()
        yield draft
        _move_all(draft, place, old)
        missing = []
    except OSError as error:
        raise unwritable(place, error) from error
    except FileError as error:
        if not Path(error.where.path).is_relative_to(draft):
            raise
        shown = place / Path(error.where.path).name
        raise FileError(error.what, where=_at(shown), hint=error.hint) from error
    finally:
        shutil.rmtree(hidden, ignore_errors=True)
        for path in missing:
            with suppress(OSError):
                path.rmdir()


def _move_all(draft: Path, place: Path, old: Path) -> None:
    """Move files to their place, and those they replace to ``old``; if one refuses, none moves."""
    files = sorted(draft.iterdir())
    for file in files:
        if (place / file.name).is_dir():
            raise FileError("There is a folder of the same name.", where=_at(place / file.name))
    moved: list[Path] = []
    try:
        for file in files:
            target = place / file.name
            if target.exists():
                os.replace(target, old / file.name)
            os.replace(file, target)
            moved.append(target)
    except OSError:
        for target in moved:
            target.unlink()
        for file in old.iterdir():
            os.replace(file, place / file.name)
        raise


def unwritable(path: Path | str, error: OSError) -> FileError:
    """Say why the system refused to write a file or folder."""
    return FileError(
        f"Cannot be written: {error.strerror or error}.",
        where=_at(path),
        hint="Choose another folder, or check its permissions and free space.",
    )


def _at(path: Path | str) -> Where:
    return Where(path=str(path))


def _flush(path: Path) -> None:
    """Push a file, or the names in a folder, to the disk, where the system can."""
    if path.is_dir() and os.name != "posix":
        return  # only POSIX opens folders
    handle = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
