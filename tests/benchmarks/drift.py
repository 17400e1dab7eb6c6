"""What can be said of any motion of outlines, whatever made it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.geometry.crossing import crosses_itself
from core.geometry.polyline import arc_lengths, signed_area
from tests.benchmarks.pairs import Rings


@dataclass(frozen=True)
class Drift:
    """How a boundary fares on its way."""

    crossing: tuple[float, ...]
    """Moments at which it crosses itself."""
    area: float
    """How far a frame's area strays from a steady change at most, relative to it."""
    perimeter: float
    """The same for the perimeter."""

    @classmethod
    def of(cls, frames: Sequence[Rings], times: np.ndarray) -> Drift:
        """Measure frames at times (k,) from 0 to 1."""
        crossing = [t for t, rings in zip(times, frames, strict=True) if crosses_itself(rings)]
        areas = np.array([abs(sum(map(signed_area, rings))) for rings in frames])
        lengths = np.array([sum(arc_lengths(ring)[-1] for ring in rings) for rings in frames])
        return cls(tuple(map(float, crossing)), deviation(areas, times), deviation(lengths, times))

    def record(self) -> dict[str, object]:
        """Return plain values by name."""
        return {
            "crossing_frames": len(self.crossing),
            "crossing": " ".join(f"{t:.3f}" for t in self.crossing),
            "area_drift": self.area,
            "perimeter_drift": self.perimeter,
        }


def deviation(values: np.ndarray, times: np.ndarray) -> float:
    """Return how far values (k,) stray at most from a steady change, relative to it.

    Anything between even steps and even ratios is steady.
    """
    first, last = values[0], values[-1]
    ratios, steps = first ** (1 - times) * last**times, (1 - times) * first + times * last
    return float(max(0, (values / steps - 1).max(), (1 - values / ratios).max()))
