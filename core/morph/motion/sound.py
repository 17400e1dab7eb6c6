"""Fitted frames, held back from folding where the plain fit comes close to it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from core.fem.energies.fold_barrier import REACH
from core.geometry.rotation import Complex
from core.model.outline import Array
from core.morph.motion.fit import GradientFit
from core.morph.motion.guard import FoldGuard
from core.progress import Watch

SURVEY = 16
"""Moments at which a motion is searched for folds beforehand."""
WATCHED = 0.6
"""Between moments with a margin above this, frames are not checked."""


Ideal = Callable[[float], Complex]
"""Ideal gradients at t, as turns and mirrors (2, m)."""


class SoundFrames:
    """Frames of a motion without folds, up to where they lie."""

    def __init__(
        self, ideal: Ideal, fit: GradientFit, guard: FoldGuard, rest: Array, watch: Watch
    ) -> None:
        """Walk through the motion once: how close frames come to a fold, and a sound frame near
        each moment for the guard to start from.
        """
        self._ideal, self._fit, self._guard = ideal, fit, guard
        self._margins, self._anchors = np.ones(SURVEY + 1), [rest]
        for k in range(1, SURVEY + 1):
            watch("in-between")
            B = ideal(k / SURVEY)
            x = fit(B)
            self._margins[k] = guard.margin(x, B)
            held = self._margins[k] < REACH
            self._anchors.append(guard(B, self._anchors[-1]) if held else x)

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        B = self._ideal(t)
        x = self._fit(B)
        k = round(np.clip(t, 0, 1) * SURVEY)
        if 0 <= t <= 1 and self._margins[max(k - 1, 0) : k + 2].min() > WATCHED:
            return x
        if self._guard.margin(x, B) >= REACH:
            return x
        return self._guard(B, self._anchors[k])
