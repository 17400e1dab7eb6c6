"""Easing: how progress in time ``t`` becomes progress in shape ``s``."""

from __future__ import annotations

from dataclasses import dataclass


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
        if self.x1 == self.y1 and self.x2 == self.y2:
            return t
        low, high = 0.0, 1.0
        for _ in range(60):  # bisection: x(u) is monotone, and no start value can go astray
            u = (low + high) / 2
            if _cubic(u, self.x1, self.x2) < t:
                low = u
            else:
                high = u
        return _cubic(u, self.y1, self.y2)


def _cubic(u: float, a: float, b: float) -> float:
    return 3 * (1 - u) ** 2 * u * a + 3 * (1 - u) * u * u * b + u**3


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
