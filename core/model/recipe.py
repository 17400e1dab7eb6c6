"""The numeric recipe of a layer: how finely it is meshed, and what it is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Method = Literal["arap", "plain arap", "linear", "intrinsic"]
Material = Literal["symmetric-dirichlet", "st-venant-kirchhoff"]

LEAST_DENSITY, MOST_DENSITY = 3, 10_000
"""What a density can be."""


@dataclass(frozen=True)
class Recipe:
    """Settings of the mapping and of the in-betweens."""

    method: Method = "arap"
    """How in-betweens are made: as rigidly as possible; the same in the paper's plain form; on
    straight vertex paths; or by the outline's edge lengths and turning angles."""
    density: int = 128
    """Boundary vertices to aim for: the outline's edges are split to perimeter / density."""
    material: Material = "symmetric-dirichlet"
    """The energy that places interior vertices: least distortion, or the paper's material."""
    mu: float = 1.0
    """μ of the St. Venant–Kirchhoff material: resistance to strain."""
    lam: float = 1.0
    """λ of the St. Venant–Kirchhoff material: resistance to a change of area."""
