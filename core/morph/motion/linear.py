"""Straight vertex paths: what rigid interpolation is compared with."""

from __future__ import annotations

from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.progress import Watch, unwatched


class Linear:
    """Moves every vertex straight to its target."""

    turn = None

    def __init__(
        self, rest: Array, target: Array, triangles: Indices, watch: Watch = unwatched
    ) -> None:
        self._rest, self._target = rest, target

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        return (1 - t) * self._rest + t * self._target
