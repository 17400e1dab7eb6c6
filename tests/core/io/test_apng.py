"""What is read back from an animated PNG is what was written, frame by frame."""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Iterator, Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.io.exporters.apng import ApngWriter, Pixels


def written(frames: Sequence[Pixels], fps: float = 24.0) -> bytes:
    file = io.BytesIO()
    writer = ApngWriter(file, len(frames), fps)
    for frame in frames:
        writer.add(frame)
    writer.end()
    return file.getvalue()


def chunks(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at = 8
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length : at + 12 + length])[0] == zlib.crc32(
            kind + body
        )
        yield kind, body
        at += 12 + length


def unpacked(data: bytes, width: int, height: int) -> Pixels:
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, 1 + 4 * width)
    assert (rows[:, 0] == 2).all()
    return np.cumsum(rows[:, 1:], axis=0, dtype=np.uint8).reshape(height, width, 4)


def read(data: bytes) -> tuple[list[Pixels], list[float]]:
    """The frames as they are seen, and how many seconds each lasts."""
    shown: list[Pixels] = []
    seconds: list[float] = []
    numbers: list[int] = []
    canvas = np.zeros((0, 0, 4), np.uint8)
    place = (0, 0, 0, 0)
    for kind, body in chunks(data):
        if kind == b"IHDR":
            width, height, *form = struct.unpack(">IIBBBBB", body)
            assert form == [8, 6, 0, 0, 0]
            canvas = np.zeros((height, width, 4), np.uint8)
        elif kind == b"acTL":
            count, plays = struct.unpack(">II", body)
            assert plays == 0
        elif kind == b"fcTL":
            number, *place, over, under, dispose, blend = struct.unpack(">IIIIIHHBB", body)
            assert (dispose, blend) == (0, 0)
            numbers.append(number)
            seconds.append(over / under)
        elif kind in (b"IDAT", b"fdAT"):
            if kind == b"fdAT":
                numbers.append(struct.unpack(">I", body[:4])[0])
                body = body[4:]
            width, height, left, top = place
            canvas = canvas.copy()
            canvas[top : top + height, left : left + width] = unpacked(body, width, height)
            shown.append(canvas)
    assert kind == b"IEND"
    assert len(shown) == count
    assert numbers == list(range(len(numbers)))
    return shown, seconds


@given(
    st.tuples(st.integers(1, 4), st.integers(1, 7), st.integers(1, 5)).flatmap(
        lambda shape: arrays(np.uint8, (*shape, 4))
    )
)
def test_every_frame_comes_back_to_the_last_bit(frames: np.ndarray) -> None:
    shown, _ = read(written(list(frames)))
    assert len(shown) == len(frames)
    for frame, back in zip(frames, shown, strict=True):
        assert np.array_equal(frame, back)


@pytest.mark.parametrize("fps", [1.0, 12.0, 23.976, 24.0, 29.97, 60.0, 240.0])
def test_a_frame_lasts_as_long_as_the_frame_rate_says(fps: float) -> None:
    _, seconds = read(written([np.zeros((2, 2, 4), np.uint8)] * 3, fps))
    assert seconds == pytest.approx([1 / fps] * 3, rel=1e-6)


def test_what_does_not_move_takes_no_room() -> None:
    still = np.random.default_rng(1).integers(0, 255, (60, 80, 4)).astype(np.uint8)
    assert len(written([still] * 20)) < 1.1 * len(written([still]))
