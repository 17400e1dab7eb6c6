"""What is seen of solutions: on screen, another frame may stand in for one that is not made yet."""

from __future__ import annotations

from collections.abc import Callable

from core.model.outline import Array
from core.morph.morph import Morph

Seen = Callable[[Morph, float], Array]
"""Positions (n, 2) of a solution at s."""


def as_solved(morph: Morph, s: float) -> Array:
    """Return the frame itself."""
    return morph.at(s)
