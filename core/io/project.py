"""The project file: a zip archive with ``document.json``.

``document.json`` is ``{"format": "betwixt", "version": 2, "document": …}``, the document as its
classes name its fields. The names ``assets/…`` and ``thumbnail.png`` are reserved. A reader
refuses files of a newer version; within a version, fields may be added if they have a default
that means what files without them meant.

Version 2 added how spans turn: before it, every centre ran straight.
"""

from __future__ import annotations

import io
import re
import zipfile
import zlib
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np

from core.errors import FileError, Where
from core.io.reading import read_whole
from core.io.replacing import replacing
from core.model import Document, Keyframe, Turning
from core.model.structure import problems

EXTENSION = ".betwixt"
VERSION = 2

MAX_BYTES = 256 * 2**20
"""Largest file, and largest document in it when unpacked."""
MAX_ENTRIES = 10_000
MAX_RATIO = 200
"""Largest compression ratio of a document beyond ``RATIO_FREE`` bytes."""
RATIO_FREE = 2**20

_ENTRY = "document.json"
_MADE = (1980, 1, 1, 0, 0, 0)
"""The date of every entry, so that equal documents make equal files."""


class _Header(msgspec.Struct):
    format: str
    version: Annotated[int, msgspec.Meta(ge=1)]


class _File(msgspec.Struct):
    format: str
    version: int
    document: Document


def save(document: Document, path: Path | str) -> None:
    """Write a project file; the old one is replaced only when the new one is complete.

    FileError when the system refuses, or when the document could not be read back.
    """
    data = to_bytes(document)
    with replacing(path) as draft:
        draft.write_bytes(data)


def load(path: Path | str) -> Document:
    """Read a project file; FileError names the place in it that is wrong."""
    return from_bytes(read_whole(path, MAX_BYTES), path)


def to_bytes(document: Document) -> bytes:
    """Return the content of a project file."""
    _require_sound(document, "")
    text = msgspec.json.encode(_File("betwixt", VERSION, document), enc_hook=_plain)
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        entry = zipfile.ZipInfo(_ENTRY, _MADE)
        entry.compress_type = zipfile.ZIP_DEFLATED
        archive.writestr(entry, text)
    return buffer.getvalue()


def from_bytes(data: bytes, path: Path | str = "") -> Document:
    """Read the content of a project file; ``path`` is named in errors."""
    text = _unpack(data, path)
    try:
        header = msgspec.json.decode(text, type=_Header)
        if header.format != "betwixt":
            raise _refused("This is not a Betwixt project.", path)
        if header.version > VERSION:
            raise FileError(
                f"The project was saved by a newer Betwixt (file version {header.version}; "
                f"this one reads up to {VERSION}).",
                where=Where(path=str(path)),
                hint="Update Betwixt to open it.",
            )
        document = msgspec.json.decode(text, type=_File, dec_hook=_array).document
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise _refused(_readable(str(error)), path) from error
    if header.version < 2:
        document = _straight(document)
    _require_sound(document, path)
    return document


def _straight(document: Document) -> Document:
    """Let the centre of every span run straight."""

    def straight(key: Keyframe) -> Keyframe:
        return replace(key, turning=Turning(path="straight"))

    return replace(
        document,
        layers=tuple(
            replace(layer, keyframes=tuple(map(straight, layer.keyframes)))
            for layer in document.layers
        ),
    )


def _unpack(data: bytes, path: Path | str) -> bytes:
    """Return ``document.json``, having checked that unpacking is harmless."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            if len(archive.infolist()) > MAX_ENTRIES:
                raise _refused(f"The archive holds more than {MAX_ENTRIES} entries.", path)
            entry = archive.getinfo(_ENTRY)
            if entry.file_size > MAX_BYTES:
                raise _refused(f"The document is larger than {MAX_BYTES >> 20} MB.", path)
            if entry.file_size > max(RATIO_FREE, MAX_RATIO * entry.compress_size):
                raise _refused("The document is compressed beyond what a drawing can be.", path)
            return archive.read(entry)
    except KeyError:
        raise _refused(f"The archive holds no {_ENTRY}.", path) from None
    except (
        zipfile.BadZipFile,
        zlib.error,
        EOFError,
        OSError,
        ValueError,
        RuntimeError,  # encrypted, or compressed by a method that is not supported
    ) as error:
        raise FileError(
            "The file is damaged or not a Betwixt project.",
            where=Where(path=str(path)),
            hint="If it was copied or downloaded, fetch it again.",
        ) from error


def _require_sound(document: Document, path: Path | str) -> None:
    found = [f"{place}: {what}" for place, what in islice(problems(document), 4)]
    if found:
        more = " And more." if len(found) > 3 else ""
        raise _refused(f"The document is inconsistent. {'; '.join(found[:3])}.{more}", path)


def _refused(what: str, path: Path | str) -> FileError:
    return FileError(what, where=Where(path=str(path)))


def _plain(value: Any) -> Any:
    """Turn what JSON does not know into what it does."""
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    raise NotImplementedError(f"cannot save a {type(value).__name__}")


def _array(kind: Any, value: Any) -> Any:
    """Read pairs of numbers into an array; the only type that msgspec does not know."""
    try:
        pairs = msgspec.convert(value, list[tuple[float, float]])
    except msgspec.ValidationError as error:
        raise ValueError(error) from error  # only then does msgspec add where the array is
    return np.array(pairs, dtype=float).reshape(-1, 2)


def _readable(message: str) -> str:
    """Join the places of nested messages into one: ``layers[0]….points[3]: what``."""
    places = re.findall(r" - at `\$([^`]*)`", message)
    what = re.sub(r" - at `[^`]*`", "", message).rstrip(".")
    place = "".join(reversed(places)).removeprefix(".document").removeprefix(".")
    return f"{place}: {what}." if place else f"{what}."
