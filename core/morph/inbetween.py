"""In-betweens: prepare once, then one back-substitution a frame (Song 2013, eqs. 2 to 5).

Each triangle's F = R(θ) S is given an ideal B(t) on the way from I to F: it turns evenly, R(tθ),
while its stretch grows from I to S. The frame has the positions whose gradients come closest.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from core.fem.elements import Elements
from core.fem.energies.fold_barrier import REACH
from core.geometry.rotation import polar, rotate, unwrap
from core.geometry.triangulation import Indices, adjacent_triangles
from core.model.outline import Array
from core.model.recipe import Method
from core.morph.fit import GradientFit
from core.morph.guard import FoldGuard
from core.progress import Watch, unwatched

SURVEY = 16
"""Moments at which a motion is searched for folds beforehand."""
WATCHED = 0.6
"""Between moments with a margin above this, frames are not checked."""


class Interpolate(Protocol):
    """A way from rest to target."""

    def __init__(
        self, rest: Array, target: Array, triangles: Indices, watch: Watch = unwatched
    ) -> None:
        """Prepare for positions (n, 2) at both ends and triangles (m, 3).

        ``watch(stage)`` is called between steps and may raise ``Cancelled``.
        """

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        ...


class PlainRigid:
    """The paper's form: S grows as (1 − t) I + t S, and source areas are the weights."""

    def __init__(
        self, rest: Array, target: Array, triangles: Indices, watch: Watch = unwatched
    ) -> None:
        self._elements = elements = Elements.of(rest, triangles)
        F = elements.deformation_gradients(target)
        theta, self.stretch = polar(F)
        pairs = adjacent_triangles(triangles)
        self.theta = unwrap(theta, pairs, elements.areas) if len(pairs) else theta
        """(m,) rotation of each triangle, unwrapped across neighbours."""
        self._after = after = Elements.of(target, triangles)
        self.weights = self._weights(elements, after, F)
        """(m, 2, 2) how much each triangle's deviation counts."""
        self.fit = GradientFit(elements, self.weights)
        self._mass = (_mass(elements) + _mass(after)) / 2
        self._centres = self._mass @ rest, self._mass @ target

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t; their centre of mass runs straight from end to end."""
        x = self._fitted(t)
        start, end = self._centres
        return x + ((1 - t) * start + t * end - self._mass @ x)

    def _fitted(self, t: float) -> Array:
        return self.fit(self.ideal(t))

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

    def __init__(
        self, rest: Array, target: Array, triangles: Indices, watch: Watch = unwatched
    ) -> None:
        super().__init__(rest, target, triangles, watch)
        S = self.stretch
        mean = (S[:, 0, 0] + S[:, 1, 1]) / 2
        half = np.hypot((S[:, 0, 0] - S[:, 1, 1]) / 2, S[:, 0, 1])
        deviator = S - mean[:, None, None] * np.eye(2)
        safe = np.where(half > 0, half, 1)[:, None, None]
        self._axes = deviator / safe
        """(m, 2, 2) symmetric, with eigenvalues 1 and −1 along the axes of stretch."""
        self._logs = np.log(mean + half), np.log(mean - half)
        self._guard = FoldGuard(self._elements, self._after, self.weights)
        self._margins, self._anchors = self._survey(rest, watch)

    def _fitted(self, t: float) -> Array:
        x = super()._fitted(t)
        k = round(np.clip(t, 0, 1) * SURVEY)
        if 0 <= t <= 1 and self._margins[max(k - 1, 0) : k + 2].min() > WATCHED:
            return x
        ideal = self.ideal(t)
        if self._guard.margin(x, ideal) >= REACH:
            return x
        return self._guard(ideal, self._anchors[k])

    def _survey(self, rest: Array, watch: Watch) -> tuple[Array, list[Array]]:
        """Walk through the motion once: how close frames come to a fold, and a sound frame near
        each moment for the guard to start from.
        """
        margins, anchors = np.ones(SURVEY + 1), [rest]
        for k in range(1, SURVEY + 1):
            watch("in-between")
            ideal = self.ideal(k / SURVEY)
            x = self.fit(ideal)
            margins[k] = self._guard.margin(x, ideal)
            anchors.append(x if margins[k] >= REACH else self._guard(ideal, anchors[-1]))
        return margins, anchors

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

    def __init__(
        self, rest: Array, target: Array, triangles: Indices, watch: Watch = unwatched
    ) -> None:
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
