"""The box around an outline: its handles, and the transforms that dragging them means."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from app.canvas.view import View
from core.geometry.places import measured
from core.model import Outline
from core.model.outline import Array

PADDING = 7.0
"""Screen pixels between the outline and its box."""
ROTATOR = 26.0
"""Screen pixels from the box up to the handle that rotates."""
SMALLEST = 0.02
"""Scale factors stay this far from zero, so that a drag cannot flatten an outline for good."""
ANGLE_STEP = np.radians(15)

CORNERS_AND_SIDES = ((0, 0), (0.5, 0), (1, 0), (1, 0.5), (1, 1), (0.5, 1), (0, 1), (0, 0.5))
"""The handles that scale, as fractions of the box."""


@dataclass(frozen=True, eq=False)
class TransformBox:
    """Axis-aligned bounds of an outline, curves included, in the document."""

    low: Array
    high: Array

    @classmethod
    def around(cls, outline: Outline) -> Self:
        """Return the box of an outline."""
        points = np.concatenate([measure.polyline.points for measure in measured(outline)])
        return cls(points.min(axis=0), points.max(axis=0))

    @property
    def centre(self) -> Array:
        """(2,) its middle."""
        return (self.low + self.high) / 2

    def at(self, fraction: tuple[float, float]) -> Array:
        """Return a document point by fractions of width and height."""
        return self.low + np.asarray(fraction) * (self.high - self.low)

    def frame(self, view: View) -> Array:
        """Return (4, 2) pixels of the box with padding: low x and low y first, then around."""
        corners = view.to_screen([self.at(f) for f in ((0, 0), (1, 0), (1, 1), (0, 1))])
        away = corners - corners.mean(axis=0)
        return corners + PADDING * np.where(away == 0, 0, np.sign(away))

    def handles(self, view: View) -> Array:
        """Return (8, 2) pixels of the handles that scale."""
        f = np.array(CORNERS_AND_SIDES)
        a, b, _, d = self.frame(view)
        return a + f[:, :1] * (b - a) + f[:, 1:] * (d - a)

    def rotator(self, view: View) -> Array:
        """Return (2,) the pixel of the handle that rotates."""
        a, b, _, _ = self.frame(view)
        return (a + b) / 2 - [0, ROTATOR]

    def scaling(
        self, handle: int, start: Array, now: Array, *, even: bool, centred: bool
    ) -> tuple[Array, Array]:
        """Return (M, offset) for a handle dragged from ``start`` to ``now``.

        ``even`` keeps the proportions; ``centred`` scales about the middle instead of the
        opposite side.
        """
        f = np.array(CORNERS_AND_SIDES[handle])
        anchor = self.centre if centred else self.at((1 - f[0], 1 - f[1]))
        reach = self.at((f[0], f[1])) - anchor
        moved = reach + (now - start)
        free = (f != 0.5) & (np.abs(reach) > 1e-9)
        factors = np.where(free, moved / np.where(free, reach, 1.0), 1.0)
        if even and free.any():
            factors = np.full(2, factors[free][np.argmax(np.abs(factors[free] - 1))])
        small = np.abs(factors) < SMALLEST
        factors[small] = np.where(factors[small] < 0, -SMALLEST, SMALLEST)
        return np.diag(factors), anchor - factors * anchor

    def rotation(self, start: Array, now: Array, *, steps: bool) -> tuple[Array, Array]:
        """Return (M, offset) for a turn about the middle; ``steps`` rounds it to 15°."""
        a, b = start - self.centre, now - self.centre
        angle = np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b)
        if steps:
            angle = ANGLE_STEP * np.round(angle / ANGLE_STEP)
        c, s = np.cos(angle), np.sin(angle)
        matrix = np.array([[c, -s], [s, c]])
        return matrix, self.centre - matrix @ self.centre
