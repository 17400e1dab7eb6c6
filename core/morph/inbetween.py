"""In-betweens: prepare once, then one back-substitution a frame (Song 2013, eqs. 2 to 5).

Each triangle's F = R(θ) S is given an ideal B(t) on the way from I to F: it turns evenly, R(tθ),
while its stretch grows from I to S. The frame has the positions whose gradients come closest.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from core.fem.elements import Elements
from core.geometry.rotation import polar, rotate, unwrap
from core.geometry.triangulation import Indices, adjacent_triangles
from core.model.outline import Array
from core.model.recipe import Method
from core.morph.fit import GradientFit


class Interpolate(Protocol):
    """A way from rest to target."""

    def __init__(self, rest: Array, target: Array, triangles: Indices) -> None:
        """Prepare for positions (n, 2) at both ends and triangles (m, 3)."""

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        ...


class PlainRigid:
    """The paper's form: S grows as (1 − t) I + t S, and source areas are the weights."""

    def __init__(self, rest: Array, target: Array, triangles: Indices) -> None:
        elements = Elements.of(rest, triangles)
        F = elements.deformation_gradients(target)
        theta, self.stretch = polar(F)
        pairs = adjacent_triangles(triangles)
        self.theta = unwrap(theta, pairs, elements.areas) if len(pairs) else theta
        """(m,) rotation of each triangle, unwrapped across neighbours."""
        after = Elements.of(target, triangles)
        self.fit = GradientFit(elements, self._weights(elements, after, F))
        self._mass = (_mass(elements) + _mass(after)) / 2
        self._centres = self._mass @ rest, self._mass @ target

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t; their centre of mass runs straight from end to end."""
        x = self.fit(self.ideal(t))
        start, end = self._centres
        return x + ((1 - t) * start + t * end - self._mass @ x)

    def ideal(self, t: float) -> Array:
        """Return B(t) (m, 2, 2) of every triangle."""
        return rotate(t * self.theta, self._stretched(t))

    def _stretched(self, t: float) -> Array:
        blend = t * self.stretch
        blend[:, [0, 1], [0, 1]] += 1 - t
        return blend

    @staticmethod
    def _weights(before: Elements, after: Elements, F: Array) -> Array:
        return before.areas[:, None, None] * np.eye(2)


class Rigid(PlainRigid):
    """Both ends count alike: S grows as Sᵗ, and deviations weigh as seen from either end.

    The weights average the normal equations of both directions (Baxter et al. 2008), M = ½ (A_s I +
    A_t F⁻¹F⁻ᵀ). Of all weights and paths tried on real pairs, these fold the fewest frames. Needs
    J > 0 everywhere.
    """

    def __init__(self, rest: Array, target: Array, triangles: Indices) -> None:
        super().__init__(rest, target, triangles)
        S = self.stretch
        mean = (S[:, 0, 0] + S[:, 1, 1]) / 2
        half = np.hypot((S[:, 0, 0] - S[:, 1, 1]) / 2, S[:, 0, 1])
        deviator = S - mean[:, None, None] * np.eye(2)
        safe = np.where(half > 0, half, 1)[:, None, None]
        self._axes = deviator / safe
        """(m, 2, 2) symmetric, with eigenvalues 1 and −1 along the axes of stretch."""
        self._logs = np.log(mean + half), np.log(mean - half)

    def _stretched(self, t: float) -> Array:
        """Return Sᵗ, from its eigenvalues."""
        high, low = (np.exp(t * log) for log in self._logs)
        power = ((high - low) / 2)[:, None, None] * self._axes
        power[:, [0, 1], [0, 1]] += ((high + low) / 2)[:, None]
        return power

    @staticmethod
    def _weights(before: Elements, after: Elements, F: Array) -> Array:
        inverse = np.linalg.inv(F)
        there = after.areas[:, None, None] * (inverse @ inverse.transpose(0, 2, 1))
        return (before.areas[:, None, None] * np.eye(2) + there) / 2


class Linear:
    """Straight vertex paths: what rigid interpolation is compared with."""

    def __init__(self, rest: Array, target: Array, triangles: Indices) -> None:
        self._rest, self._target = rest, target

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        return (1 - t) * self._rest + t * self._target


METHODS: dict[Method, type[Interpolate]] = {
    "arap": Rigid,
    "plain arap": PlainRigid,
    "linear": Linear,
}


def _mass(elements: Elements) -> Array:
    """Return (n,) each vertex's share of the area, summing to 1."""
    corners, areas = elements.triangles.ravel(), np.repeat(elements.areas, 3)
    shares = np.bincount(corners, weights=areas, minlength=elements.vertices)
    return shares / shares.sum()
