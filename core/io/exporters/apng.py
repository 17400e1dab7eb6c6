"""Animated PNG: a PNG of the first frame, and for every other one the part that has changed.

Format: https://www.w3.org/TR/png-3/, sections 11.3.6.2 and 11.3.6.3. What does not know it shows
the first frame.
"""

from __future__ import annotations

import struct
import zlib
from fractions import Fraction
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

SIGNATURE = b"\x89PNG\r\n\x1a\n"
RGBA = 6
"""The colour type of eight bits each of red, green, blue and alpha."""
UP = 2
"""The filter that keeps the difference to the row above: flat colours become zeros."""
STAY, REPLACE = 0, 0
"""A frame stays until the next, whose pixels replace what they cover."""
LONGEST = 0xFFFF
"""The largest number in the fraction of a second that a frame lasts."""

Pixels = NDArray[np.uint8]


class ApngWriter:
    """Writes frames to an open file as they come; all have the size of the first."""

    def __init__(self, file: BinaryIO, frames: int, fps: float) -> None:
        self._file, self._frames = file, frames
        self._lasts = Fraction(1 / fps).limit_denominator(LONGEST)
        self._before: Pixels | None = None
        self._number = 0

    def add(self, frame: Pixels) -> None:
        """Write the next frame: (height, width, 4) of straight RGBA."""
        if self._before is None:
            self._begin(frame)
            self._control(frame, 0, 0)
            self._chunk(b"IDAT", _packed(frame))
        else:
            top, left, bottom, right = _changed(self._before, frame)
            part = frame[top:bottom, left:right]
            self._control(part, left, top)
            self._chunk(b"fdAT", self._next() + _packed(part))
        self._before = frame

    def end(self) -> None:
        """Finish the file after the last frame."""
        self._chunk(b"IEND", b"")

    def _begin(self, frame: Pixels) -> None:
        height, width, _ = frame.shape
        self._file.write(SIGNATURE)
        self._chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, RGBA, 0, 0, 0))
        self._chunk(b"acTL", struct.pack(">II", self._frames, 0))  # again and again

    def _control(self, part: Pixels, left: int, top: int) -> None:
        height, width, _ = part.shape
        lasts = self._lasts.numerator, self._lasts.denominator
        place = struct.pack(">IIII", width, height, left, top)
        self._chunk(b"fcTL", self._next() + place + struct.pack(">HHBB", *lasts, STAY, REPLACE))

    def _next(self) -> bytes:
        self._number += 1
        return struct.pack(">I", self._number - 1)

    def _chunk(self, kind: bytes, data: bytes) -> None:
        check = zlib.crc32(kind + data)
        self._file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check))


def _changed(before: Pixels, after: Pixels) -> tuple[int, int, int, int]:
    """Return top, left, bottom and right of what differs; one pixel where nothing does."""
    differs = (before != after).any(axis=2)
    if not differs.any():
        return 0, 0, 1, 1
    rows, columns = (np.flatnonzero(differs.any(axis=axis)) for axis in (1, 0))
    return int(rows[0]), int(columns[0]), int(rows[-1]) + 1, int(columns[-1]) + 1


def _packed(part: Pixels) -> bytes:
    """Filter and compress."""
    rows = part.reshape(len(part), -1)
    rows = np.vstack([rows[:1], rows[1:] - rows[:-1]])
    return zlib.compress(np.insert(rows, 0, UP, axis=1).tobytes())
