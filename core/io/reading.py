"""Files read whole, or refused with the reason."""

from __future__ import annotations

from pathlib import Path
from stat import S_ISREG

from core.errors import FileError, Where
from core.io.naming import require_name


def read_whole(path: Path | str, most: int) -> bytes:
    """Return the content of a file; FileError if it has more than ``most`` bytes or has no end."""
    require_name(path)
    where = Where(path=str(path))
    try:
        status = Path(path).stat()
        if not S_ISREG(status.st_mode):
            raise FileError("Cannot be read: it is a folder or a device.", where=where)
        if status.st_size > most:
            raise FileError(f"The file is larger than {most >> 20} MB.", where=where)
        return Path(path).read_bytes()
    except OSError as error:
        raise FileError(f"Cannot be read: {error.strerror or error}.", where=where) from error
