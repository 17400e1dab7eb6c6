"""In-betweens: prepare once, then one back-substitution a frame (Song 2013, eqs. 2 to 5).

Each triangle's F = R(θ) S is given the ideal B(t) = R(tθ) ((1 − t) I + t S); the positions whose
gradients come closest, Σ A ‖F(x) − B(t)‖², solve a Poisson problem whose matrix does not depend
on t.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_array

from core.fem.elements import Elements
from core.fem.newton import factorise
from core.geometry.rotation import polar, rotate, unwrap
from core.geometry.triangulation import Indices, adjacent_triangles
from core.model.outline import Array
from core.model.recipe import Method

Interpolate = Callable[[float], Array]
"""t → positions (n, 2)."""


class RigidInbetween:
    """As-rigid-as-possible frames between rest (n, 2) and target (n, 2)."""

    def __init__(self, rest: Array, target: Array, triangles: Indices) -> None:
        elements = Elements.of(rest, triangles)
        theta, self.stretch = polar(elements.deformation_gradients(target))
        pairs = adjacent_triangles(triangles)
        self.theta = unwrap(theta, pairs, elements.areas) if len(pairs) else theta
        """(m,) rotation of each triangle, unwrapped across neighbours."""
        weights = np.repeat(elements.areas, 2)
        self._load = csr_array(elements.operator.T.multiply(weights[None, :]))[1:]
        self._factor = factorise(elements.laplacian[1:, 1:].tocsc())  # vertex 0 is pinned
        self._mass = _mass(triangles, elements.areas, len(rest))
        self._centres = self._mass @ rest, self._mass @ target

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t; their centre of mass runs straight from end to end."""
        x = np.zeros((len(self._mass), 2))
        x[1:] = self.solve(self.load(self.ideal(t)))
        start, end = self._centres
        return x + ((1 - t) * start + t * end - self._mass @ x)

    def ideal(self, t: float) -> Array:
        """Return B(t) (m, 2, 2) of every triangle."""
        blend = t * self.stretch
        blend[:, [0, 1], [0, 1]] += 1 - t
        return rotate(t * self.theta, blend)

    def load(self, ideal: Array) -> Array:
        """Return the right-hand sides (n − 1, 2) for ideal gradients (m, 2, 2)."""
        return self._load @ ideal.transpose(0, 2, 1).reshape(-1, 2)

    def solve(self, load: Array) -> Array:
        """Return the positions (n − 1, 2) of all vertices but the pinned one: one solve."""
        return self._factor.solve(load)


class LinearInbetween:
    """Straight vertex paths: what rigid interpolation is compared with."""

    def __init__(self, rest: Array, target: Array, triangles: Indices) -> None:
        self._rest, self._target = rest, target

    def __call__(self, t: float) -> Array:
        """Return positions (n, 2) at t."""
        return (1 - t) * self._rest + t * self._target


METHODS: dict[Method, Callable[[Array, Array, Indices], Interpolate]] = {
    "arap": RigidInbetween,
    "linear": LinearInbetween,
}


def _mass(triangles: Indices, areas: Array, vertices: int) -> Array:
    """Return (n,) each vertex's share of the area, summing to 1."""
    shares = np.bincount(triangles.ravel(), weights=np.repeat(areas, 3), minlength=vertices)
    return shares / shares.sum()
