"""What every way from rest to target can do."""

from __future__ import annotations

from typing import Protocol

from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.progress import Watch, unwatched


class Interpolate(Protocol):
    """A way from the shape at rest to the target's."""

    def __init__(
        self, rest: Array, target: Array, triangles: Indices, watch: Watch = unwatched
    ) -> None:
        """Prepare for positions (n, 2) at both ends and triangles (m, 3).

        ``watch(stage)`` is called between steps and may raise ``Cancelled``.
        """

    @property
    def turn(self) -> float | None:
        """The mean rotation on the way, in [-π, π).

        None where every vertex has a path of its own, and frames lie where they belong.
        """

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t, wherever they lie."""
        ...
