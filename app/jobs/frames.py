"""Frames of solutions that are at hand: what is shown waits for none to be made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

from PySide6.QtCore import QObject, Signal

from core.model.outline import Array

if TYPE_CHECKING:
    from collections.abc import Mapping

    from core.geometry.triangulation import Indices
    from core.morph.morph import Morph

    Instant = tuple[Morph, float]
    """A solution, and progress s in it."""

BUDGET = 2**28
"""Bytes of positions that are kept."""
AT_ONCE = 20_000
"""Triangles up to which a frame that need not be held is made while the artist looks on."""
WISHES = 8
"""Frames that may be missing at one time: more were on screen before."""


class Frames(QObject):
    """Keeps the frames that were made in the background, and notes which are missing on screen.

    A frame that costs little is made at once. In place of any other that is not there yet stands
    the nearest one that is; whoever shows it can tell, and hears when the frame itself has come.
    """

    missed = Signal()
    """A frame is missing on screen."""
    came = Signal()
    """One that was missing is there."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._made: WeakKeyDictionary[Morph, dict[float, Array]] = WeakKeyDictionary()
        """In the order in which solutions got frames last."""
        self._tried: WeakKeyDictionary[Morph, tuple[float, Array | None]] = WeakKeyDictionary()
        """The last frame that was made at once, or could not be: several views ask for it."""
        self._missing: dict[Instant, None] = {}

    @property
    def missing(self) -> Instant | None:
        """The frame that was found missing last."""
        return next(reversed(self._missing), None)

    def exact(self, morph: Morph, s: float) -> Array | None:
        """Return positions (n, 2) of a frame if it is at hand."""
        if s in (0, 1):
            return morph.at(s)
        made = self._made.get(morph, {}).get(s)
        return self._at_once(morph, s) if made is None else made

    def at(self, morph: Morph, s: float) -> Array:
        """Return positions (n, 2) of a frame, or else of the nearest one; that it is missing is
        noted.
        """
        exact = self.exact(morph, s)
        if exact is not None:
            return exact
        self._miss((morph, s))
        made = self._made.get(morph, {})
        nearest = min((0.0, 1.0, *made), key=lambda other: abs(other - s))
        return made[nearest] if nearest in made else morph.at(nearest)

    def made(self, morph: Morph) -> Mapping[float, Array]:
        """Return all frames of a solution that are kept, by s."""
        return self._made.get(morph, {})

    def keep(self, morph: Morph, frames: Mapping[float, Array]) -> None:
        """Keep frames that were made; the oldest give way to them."""
        made = self._made.pop(morph, {})
        self._made[morph] = made
        made.update(frames)
        for s in frames:
            self._make_room(made, s)
        found = [instant for instant in self._missing if instant[0] is morph and instant[1] in made]
        for instant in found:
            del self._missing[instant]
        if found:
            self.came.emit()

    def give_up(self, instant: Instant) -> None:
        """Miss a frame no longer: it cannot be made."""
        self._missing.pop(instant, None)

    def give_all_up(self) -> None:
        """Miss nothing any longer: something else is on screen."""
        self._missing.clear()

    def _at_once(self, morph: Morph, s: float) -> Array | None:
        if len(morph.triangles) > AT_ONCE:
            return None
        tried = self._tried.get(morph)
        if tried is None or tried[0] != s:
            tried = self._tried[morph] = s, morph.plain(s)
        return tried[1]

    def _miss(self, instant: Instant) -> None:
        known = instant in self._missing
        self._missing.pop(instant, None)
        self._missing[instant] = None
        if len(self._missing) > WISHES:
            del self._missing[next(iter(self._missing))]
        if not known:
            self.missed.emit()

    def _make_room(self, mine: dict[float, Array], s: float) -> None:
        """Drop the frames of other solutions, then those of this one farthest from s."""
        others = [made for made in self._made.values() if made is not mine and made]
        excess = sum(map(_bytes, [*others, mine])) - BUDGET
        for made in others:
            if excess <= 0:
                return
            excess -= _bytes(made)
            made.clear()
        while excess > 0 and len(mine) > 1:
            farthest = max(mine, key=lambda other: abs(other - s))
            excess -= mine.pop(farthest).nbytes


def _bytes(made: dict[float, Array]) -> int:
    """Return the bytes of some frames, all of one size."""
    return len(made) * next(iter(made.values())).nbytes if made else 0


@dataclass(frozen=True, eq=False)
class Shown:
    """A solution as it is seen on screen: every frame is there at once, though perhaps inexact."""

    morph: Morph
    frames: Frames

    @property
    def rings(self) -> tuple[Indices, ...]:
        """The boundary as vertex indices, exterior first."""
        return self.morph.rings

    def at(self, s: float) -> Array:
        """Return positions (n, 2) at progress s, or what stands in for them."""
        return self.frames.at(self.morph, s)
