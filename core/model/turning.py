"""Turning: which way and how often a shape turns between two keys, and where its centre goes."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, tau
from typing import Literal

Direction = Literal["automatic", "clockwise", "counter-clockwise"]
Path = Literal["arc", "straight"]
About = Literal["centre", "joint"]

MOST_TURNS = 100
SLACK = pi / 18
"""Turned back by no more than this, a shape has not turned: else two drawings that all but agree
would be a whole turn apart or none, as the hand shook."""


@dataclass(frozen=True)
class Turning:
    """How a span turns as a whole; positive angles are clockwise, as y points down."""

    direction: Direction = "automatic"
    """Automatic is the shorter way."""
    turns: int = 0
    """Whole turns besides, the same way; clockwise where the shape hardly turns at all."""
    path: Path = "arc"
    """Of the centre: round the point about which the shape turns and grows, or straight."""
    about: About = "centre"
    """What whole turns are about: the shape's own centre, or where it hangs on another layer."""

    def swing(self, nearest: float) -> float:
        """Return the angle from key to key without whole turns; ``nearest`` is in [-π, π)."""
        if self.direction == "clockwise" and nearest < -SLACK:
            return nearest + tau
        if self.direction == "counter-clockwise" and nearest > SLACK:
            return nearest - tau
        return nearest

    def angle(self, nearest: float) -> float:
        """Return the angle from key to key, whole turns included."""
        back = self.direction == "counter-clockwise"
        if self.direction == "automatic":
            back = nearest < -SLACK
        return self.swing(nearest) + tau * (-self.turns if back else self.turns)

    def split(self, angle: float, s: float) -> tuple[Turning, Turning]:
        """Return the turning of both parts of a span that turns by ``angle``, parted at s.

        An arc with whole turns becomes two chords: each part would swing by its own share of them.
        """
        path: Path = "straight" if self.turns else self.path
        return self._through(s * angle, path), self._through((1 - s) * angle, path)

    def _through(self, angle: float, path: Path) -> Turning:
        """Return the turning whose angle this is."""
        if -pi <= angle < pi and (self.direction == "automatic" or abs(angle) <= SLACK):
            return Turning(path=path, about=self.about)
        turns = int((abs(angle) + SLACK) // tau)
        way: Direction = "clockwise" if angle > 0 else "counter-clockwise"
        return Turning(way, turns, path, self.about)


AS_DRAWN = Turning()
