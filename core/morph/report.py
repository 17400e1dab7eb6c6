"""What happened while a morph was solved, and how good it is."""

from __future__ import annotations

from dataclasses import dataclass

from core.errors import Repair
from core.model import RingPoint
from core.morph.certificate import Certificate


@dataclass(frozen=True)
class Iteration:
    """One Newton step."""

    stage: str
    energy: float
    folds: int
    """Triangles with J ≤ 0 after it."""


@dataclass(frozen=True)
class Stage:
    """One stage of the work."""

    name: str
    seconds: float
    result: str
    """What came of it, in words."""
    folds: int | None = None
    """Triangles with J ≤ 0 in the target after it, if it left a map, and …"""
    distortion: float | None = None
    """… its mean distortion."""


@dataclass(frozen=True)
class Report:
    """Diagnostics of a solved morph."""

    vertices: int
    triangles: int
    certificate: Certificate
    """Whether the map is one to one, and where it folds if it is not."""
    distortion_mean: float
    """Area-weighted mean of (‖F‖² + ‖F⁻¹‖²) / 4 at unit areas: 1 is an isometry, ∞ a fold."""
    distortion_worst: float
    """The largest of any triangle."""
    smallest_angle: float
    """Smallest angle of any triangle at either end, in radians."""
    iterations: tuple[Iteration, ...]
    mirror: bool
    """Whether the mirror image of the target would match the source far better, which is told only
    where the map distorts a lot (``POOR`` in ``pipeline.py``).
    """
    repairs: tuple[Repair, ...]
    """What was changed in the outlines so that they could be used."""
    stages: tuple[Stage, ...]
    """In order: how the map was found, and how its mesh was changed on the way."""
    tried: int
    """Correspondences that were compared; 1 when marks decide."""
    proposed: tuple[tuple[RingPoint, RingPoint, float], ...] = ()
    """The marks that were used where none were given: a place on the source, one on the target, and
    in [0, 1] how sure it is that they belong together.
    """

    @property
    def folds_source(self) -> tuple[int, ...]:
        """Triangles with no positive area at rest; empty unless the mesh is broken."""
        return self.certificate.folds[0]

    @property
    def folds_target(self) -> tuple[int, ...]:
        """Triangles with J ≤ 0 in the target."""
        return self.certificate.folds[1]

    @property
    def seconds(self) -> float:
        """All the time it took."""
        return sum(stage.seconds for stage in self.stages)
