"""Easing: how progress in time ``t`` becomes progress in shape ``s``."""

from __future__ import annotations

from dataclasses import dataclass, replace

FLAT = 1e-9
"""A rise too small to be divided by."""
WILD = 100.0
"""How far y may overshoot; half of an easing that would be wilder is made even."""


@dataclass(frozen=True)
class Easing:
    """A cubic Bézier timing curve from (0, 0) to (1, 1), as in CSS; or a hold until the next key.

    ``x1`` and ``x2`` lie in [0, 1], so that the curve is a function of time. ``y1`` and ``y2`` may
    overshoot.
    """

    x1: float = 1 / 3
    y1: float = 1 / 3
    x2: float = 2 / 3
    y2: float = 2 / 3
    hold: bool = False

    def __call__(self, t: float) -> float:
        """Return s for t ∈ [0, 1]; exact at both ends."""
        if t >= 1:
            return 1.0
        if t <= 0 or self.hold:
            return 0.0
        return t if self._even else _cubic(self._parameter(t), self.y1, self.y2)

    def even_at(self, start: bool, end: bool) -> Easing:
        """Return the easing that begins, ends, or does both at the pace of an even one."""
        x1, y1 = (1 / 3, 1 / 3) if start else (self.x1, self.y1)
        x2, y2 = (2 / 3, 2 / 3) if end else (self.x2, self.y2)
        return replace(self, x1=x1, y1=y1, x2=x2, y2=y2) if start or end else self

    def split(self, t: float) -> tuple[Easing, Easing]:
        """Return the timing before and after t ∈ (0, 1), each as an easing of its own.

        Run one after the other they are this one: exactly, unless time all but turns back on the
        curve (``x1 > x2``), or overshooting it returns to a key at t; they come close then.
        """
        if self.hold or self._even:
            return self, self
        u = self._parameter(t)
        a, b, end = complex(self.x1, self.y1), complex(self.x2, self.y2), 1 + 1j
        first, middle, last = u * a, a + u * (b - a), b + u * (end - b)  # de Casteljau
        before, after = first + u * (middle - first), middle + u * (last - middle)
        here = before + u * (after - before)
        late = _from_handles(end - last, end - after, end - here)  # from its end, then turned round
        return (
            _from_handles(first, before, here),
            Easing(1 - late.x2, 1 - late.y2, 1 - late.x1, 1 - late.y1),
        )

    @property
    def _even(self) -> bool:
        return self.x1 == self.y1 and self.x2 == self.y2

    def _parameter(self, t: float) -> float:
        """Return the curve parameter at which the time is t."""
        low, high = 0.0, 1.0
        for _ in range(60):  # bisection: x(u) is monotone, and no start value can go astray
            u = (low + high) / 2
            if _cubic(u, self.x1, self.x2) < t:
                low = u
            else:
                high = u
        return u


def _cubic(u: float, a: float, b: float) -> float:
    return 3 * (1 - u) ** 2 * u * a + 3 * (1 - u) * u * u * b + u**3


def _from_handles(a: complex, b: complex, end: complex) -> Easing:
    """Return the curve from 0 to ``end`` by way of two handles, x + iy, scaled to the unit square.

    Its first handle is shortened where it reaches past the end. Turned round, y may overshoot by
    one more.
    """
    if abs(end.imag) < FLAT:
        return LINEAR
    x1, y1 = a.real / end.real, a.imag / end.imag
    x2, y2 = b.real / end.real, b.imag / end.imag
    if x1 > 1:
        x1, y1 = 1.0, y1 / x1
    return Easing(x1, y1, min(x2, 1.0), y2) if max(abs(y1), abs(y2)) <= WILD - 1 else LINEAR


LINEAR = Easing()
EASE_IN = Easing(0.42, 0.0, 1.0, 1.0)
EASE_OUT = Easing(0.0, 0.0, 0.58, 1.0)
EASE_IN_OUT = Easing(0.42, 0.0, 0.58, 1.0)
HOLD = Easing(hold=True)

PRESETS = {
    "linear": LINEAR,
    "ease in": EASE_IN,
    "ease out": EASE_OUT,
    "ease in and out": EASE_IN_OUT,
    "hold": HOLD,
}
