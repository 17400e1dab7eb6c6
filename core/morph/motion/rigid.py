"""As rigid as possible: prepare once, then one back-substitution a frame (Song 2013, eqs. 2 to 5).

The frame has the positions whose gradients come closest to the ideal ones.
"""

from __future__ import annotations

import numpy as np

from core.fem.elements import Elements
from core.geometry.rotation import to_complex
from core.geometry.triangulation import Indices, boundary_rings
from core.model.outline import Array
from core.morph.motion.contact import Contact
from core.morph.motion.fit import GradientFit
from core.morph.motion.gradients import IdealGradients, LinearStretch, LogStretch
from core.morph.motion.guard import FoldGuard
from core.morph.motion.passing import BY_ITSELF, Exponent, PassingGradients, Rates
from core.morph.motion.series import Series
from core.morph.motion.sound import Ideal, SoundFrames
from core.progress import Watch, unwatched


class PlainRigid:
    """The paper's form: S grows as (1 − t) I + t S, and source areas are the weights."""

    def __init__(
        self, rest: Array, target: Array, triangles: Indices, watch: Watch = unwatched
    ) -> None:
        before = Elements.of(rest, triangles)
        F = before.deformation_gradients(target)
        self.ideal = IdealGradients(F, triangles, before.areas, LinearStretch)
        self.turn, self.theta = self.ideal.turn, self.ideal.theta
        self.fit = GradientFit(before, before.areas[:, None, None] * np.eye(2))
        self._frames = Series(lambda t: self.fit(self.ideal(t)))

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t, vertex 0 at the origin."""
        return self._frames(t)


class Rigid:
    """Both ends count alike: S grows as Sᵗ, deviations weigh as seen from either end, no
    triangle folds, and no boundary crosses itself unless ``limbs_pass``.

    The weights average the normal equations of both directions (Baxter et al. 2008), M = ½ (A_s I +
    A_t F⁻¹F⁻ᵀ). Of all weights and paths tried on real pairs, these fold the fewest frames. Needs
    J > 0 everywhere.
    """

    def __init__(
        self,
        rest: Array,
        target: Array,
        triangles: Indices,
        watch: Watch = unwatched,
        rates: Rates = BY_ITSELF,
    ) -> None:
        """Prepare; ``rates`` are velocity gradients that the ends are to have."""
        before, after = Elements.of(rest, triangles), Elements.of(target, triangles)
        F = before.deformation_gradients(target)
        weights = _symmetric_weights(before, after, F)
        even = IdealGradients(F, triangles, _shares(before) + _shares(after), LogStretch)
        self.turn, self.theta = even.turn, even.theta
        self.exponent = Exponent.of(F, even.theta)
        self.ideal: Ideal = even if rates is BY_ITSELF else PassingGradients(self.exponent, *rates)
        self.fit = GradientFit(before, weights)
        ends = (to_complex(end) for end in (rest, target))
        contact = Contact(boundary_rings(triangles), *ends)
        guard = FoldGuard(before, after)
        turning = _around_vertices(even.theta, before)
        self._frames = SoundFrames(self.ideal, turning, self.fit, guard, contact, watch)

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t, wherever they lie."""
        return self._frames(t)

    @property
    def limbs_pass(self) -> bool:
        """Whether limbs pass one another, as no way round was found: the boundary crosses then."""
        return self._frames.limbs_pass

    def plain(self, t: float) -> Array | None:
        """Return positions (n, 2) at t if they need not be held, which costs little; else None."""
        return self._frames.plain(t)


def _shares(elements: Elements) -> Array:
    """Return each triangle's share (m,) of the area."""
    return elements.areas / elements.areas.sum()


def _around_vertices(values: Array, elements: Elements) -> Array:
    """Return the mean (n,) of triangles' values (m,) around each vertex, by area."""
    corners, areas = elements.triangles.ravel(), np.repeat(elements.areas, 3)
    total = np.bincount(corners, areas * np.repeat(values, 3), elements.vertices)
    return total / np.bincount(corners, areas, elements.vertices)


def _symmetric_weights(before: Elements, after: Elements, F: Array) -> Array:
    """Return (m, 2, 2) how much each triangle's deviation counts."""
    inverse = np.linalg.inv(F)
    there = after.areas[:, None, None] * (inverse @ inverse.transpose(0, 2, 1))
    return (before.areas[:, None, None] * np.eye(2) + there) / 2
