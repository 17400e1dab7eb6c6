"""Linear triangles: deformation gradients and what is integrated over them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from scipy.sparse import csr_array

from core.geometry.rotation import Complex
from core.geometry.triangulation import Indices
from core.model.outline import Array


@dataclass(frozen=True, eq=False)
class Elements:
    """The linear triangles of a rest mesh."""

    triangles: Indices
    """(m, 3), positively oriented at rest."""
    vertices: int
    areas: Array
    """(m,) rest areas."""
    gradients: Array
    """(m, 3, 2) gradient of each corner's hat function at rest."""

    @classmethod
    def of(cls, points: Array, triangles: Indices) -> Self:
        """Prepare the elements of rest positions (n, 2) and triangles (m, 3)."""
        corners = points[triangles]
        opposite = np.roll(corners, 1, axis=1) - np.roll(corners, -1, axis=1)  # x_{a-1} − x_{a+1}
        e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        doubled = e1[:, 0] * e2[:, 1] - e1[:, 1] * e2[:, 0]
        # a hat's gradient is its opposite edge turned by 90° inwards, over twice the area
        gradients = np.stack([-opposite[..., 1], opposite[..., 0]], axis=-1)
        return cls(triangles, len(points), doubled / 2, gradients / doubled[:, None, None])

    @cached_property
    def hats(self) -> Complex:
        """(3, m) the gradients as complex numbers, corner by corner."""
        return (self.gradients[..., 0] + 1j * self.gradients[..., 1]).T.copy()

    @cached_property
    def operator(self) -> csr_array:
        """(2m, n) matrix D with D x = the transposed deformation gradients, stacked."""
        m = len(self.triangles)
        rows = np.repeat(np.arange(2 * m).reshape(m, 1, 2), 3, axis=1)
        columns = np.repeat(self.triangles[:, :, None], 2, axis=2)
        entries = (self.gradients.ravel(), (rows.ravel(), columns.ravel()))
        return csr_array(entries, shape=(2 * m, self.vertices))

    def deformation_gradients(self, x: Array) -> Array:
        """Return F (m, 2, 2) = ∂x/∂X of positions x (n, 2), column form (Song 2013, eq. 1)."""
        return (self.operator @ x).reshape(-1, 2, 2).transpose(0, 2, 1)

    @cached_property
    def laplacian(self) -> csr_array:
        """(n, n) stiffness matrix of Σ A ‖F‖² / 2: the cotangent Laplacian."""
        weights = np.repeat(self.areas, 2)
        return csr_array(self.operator.T @ (self.operator.multiply(weights[:, None])))


def determinants(F: Array) -> Array:
    """Return J = det F (m,)."""
    return F[:, 0, 0] * F[:, 1, 1] - F[:, 0, 1] * F[:, 1, 0]
