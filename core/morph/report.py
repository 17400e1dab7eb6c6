"""What happened while a morph was solved, and how good it is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Iteration:
    """One Newton step."""

    stage: str
    energy: float
    folds: int
    """Triangles with J ≤ 0 after it."""


@dataclass(frozen=True)
class Stage:
    """One stage of the mapping."""

    name: str
    seconds: float
    result: str
    """What came of it, in words."""


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
    mirror: bool
    """Whether the mirror image of the target would match the source far better."""
    repairs: tuple[str, ...]
    """What was changed in the outlines so that they could be used."""
    stages: tuple[Stage, ...]
    """How the map was found, and how its mesh was changed on the way."""
    tried: int
    """Correspondences that were compared; 1 when marks decide."""
