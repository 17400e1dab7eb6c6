"""What happened while a morph was solved, and how good it is."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Iteration:
    """One Newton step."""

    stage: str
    energy: float
    folds: int
    """Triangles with J ≤ 0 after it."""


@dataclass(frozen=True)
class Report:
    """Diagnostics of a solved morph."""

    vertices: int
    triangles: int
    folds_source: tuple[int, ...]
    """Triangles with no positive area at rest; empty unless the mesh is broken."""
    folds_target: tuple[int, ...]
    """Triangles with J ≤ 0 in the target."""
    distortion_mean: float
    """Area-weighted mean of (‖F‖² + ‖F⁻¹‖²) / 4 at unit areas: 1 is an isometry, ∞ a fold."""
    distortion_worst: float
    """The largest of any triangle."""
    smallest_angle: float
    """Smallest angle of any triangle at either end, in radians."""
    iterations: tuple[Iteration, ...]
    timings: dict[str, float]
    """Seconds by stage, in order."""
    repairs: tuple[str, ...]
    """What was changed in the outlines so that they could be used."""
    split_chords: int
    """Interior edges between boundary vertices that were split."""

    def as_dict(self) -> dict[str, Any]:
        """Return plain data, for JSON."""
        return asdict(self)
