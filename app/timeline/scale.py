"""Time on screen: which frame lies at which pixel."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil
from typing import Self

FINEST, COARSEST = 120.0, 0.02
"""Pixels a frame, at most and at least."""
MARGIN = 28
"""Pixels left free on both sides when everything is fitted in."""
LABEL_ROOM = 40.0
"""Pixels that a frame number needs."""


@dataclass(frozen=True)
class TimeScale:
    """A linear scale from frames to pixels."""

    left: float = 0.0
    """The frame at x = 0."""
    pixels: float = 12.0
    """Pixels a frame."""

    def x(self, frame: float) -> float:
        """Return the pixel of a frame."""
        return (frame - self.left) * self.pixels

    def frame(self, x: float) -> float:
        """Return the frame at a pixel."""
        return self.left + x / self.pixels

    def zoomed(self, factor: float, x: float) -> Self:
        """Zoom; the frame at pixel x stays there."""
        pixels = min(max(self.pixels * factor, COARSEST), FINEST)
        return replace(self, left=self.frame(x) - x / pixels, pixels=pixels)

    def panned(self, dx: float) -> Self:
        """Shift by so many pixels to the right."""
        return replace(self, left=self.left - dx / self.pixels)

    def showing(self, frame: float, width: float) -> Self:
        """Shift by whole pages, if need be, until a frame lies within the width."""
        page = max((width - 2 * MARGIN) / self.pixels, 1.0)
        first = self.frame(MARGIN)
        if 0 <= self.x(frame) <= width:
            return self
        pages = (frame - first) // page
        return replace(self, left=self.left + pages * page)

    @classmethod
    def fitted(cls, first: float, last: float, width: float) -> Self:
        """Show frames first to last in the width."""
        pixels = (max(width, 3 * MARGIN) - 2 * MARGIN) / max(last - first, 1.0)
        pixels = min(max(pixels, COARSEST), FINEST)
        return cls(first - MARGIN / pixels, pixels)


def step_for(pixels: float, room: float) -> int:
    """Return the least of 1, 2, 5, 10, 20, 50, … units of so many pixels that fills the room."""
    step, needed = 1, ceil(room / pixels)
    while True:
        for factor in (1, 2, 5):
            if step * factor >= needed:
                return step * factor
        step *= 10


def multiples(first: int, last: int, step: int, lowest: int) -> list[int]:
    """Return the multiples of a step up to last, from the one at or before first.

    Where that lies below lowest, lowest stands in its place: rulers begin 1, 5, 10, …
    """
    start = max(first, lowest) // step * step
    return [max(number, lowest) for number in range(start, last + 1, step)]
