"""Linear triangles: deformation gradients and what is integrated over them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from scipy.sparse import csr_array

from core.geometry.rotation import Complex, to_complex
from core.geometry.triangulation import Indices
from core.model.outline import Array

CORNER_PAIRS = (0, 1, 2, 0, 1, 2), (1, 2, 0, 0, 1, 2)
"""Two different corners of a triangle, then each with itself."""


@dataclass(frozen=True, eq=False)
class Elements:
    """The linear triangles of a rest mesh."""

    triangles: Indices
    """(m, 3), positively oriented at rest."""
    vertices: int
    areas: Array
    """(m,) rest areas."""
    hats: Complex
    """(3, m) gradient of each corner's hat function at rest, as a complex number."""

    @classmethod
    def of(cls, points: Array, triangles: Indices) -> Self:
        """Prepare the elements of rest positions (n, 2) and triangles (m, 3)."""
        z = to_complex(points)[triangles.T]
        opposite = z[[2, 0, 1]] - z[[1, 2, 0]]
        e1, e2 = opposite[2], -opposite[1]
        doubled = e1.real * e2.imag - e1.imag * e2.real
        # a hat's gradient is its opposite edge turned by 90° inwards, over twice the area
        return cls(triangles, len(points), doubled / 2, 1j * opposite / doubled)

    @cached_property
    def corners(self) -> Indices:
        """(3, m) the triangles, corner by corner."""
        return self.triangles.T.copy()

    @cached_property
    def products(self) -> tuple[Complex, Complex]:
        """(6, m) products of the hats' gradients with others' conjugates, and with others, in the
        order of ``CORNER_PAIRS``.
        """
        first, second = (self.hats[list(corner)] for corner in CORNER_PAIRS)
        return first * np.conj(second), first * second

    @cached_property
    def gradients(self) -> Array:
        """(m, 3, 2) the gradients of the hat functions."""
        return np.stack([self.hats.real, self.hats.imag], axis=-1).transpose(1, 0, 2).copy()

    @cached_property
    def operator(self) -> csr_array:
        """(2m, n) matrix D with D x = the transposed deformation gradients, stacked."""
        m = len(self.triangles)
        rows = np.repeat(np.arange(2 * m).reshape(m, 1, 2), 3, axis=1)
        columns = np.repeat(self.triangles[:, :, None], 2, axis=2)
        entries = (self.gradients.ravel(), (rows.ravel(), columns.ravel()))
        return csr_array(entries, shape=(2 * m, self.vertices))

    def turn_and_mirror(self, x: Array) -> tuple[Complex, Complex]:
        """Return F = ∂x/∂X of positions x (n, 2), split as in ``geometry.rotation``, each (m,).

        They are the derivatives of x by X and by its conjugate: each corner's place times half the
        conjugate of its hat's gradient, or half of that itself.
        """
        z = to_complex(x)[self.corners]
        edges, hats = (z[1:] - z[0]) / 2, self.hats[1:]
        turn, mirror = edges * np.conj(hats), edges * hats
        return turn[0] + turn[1], mirror[0] + mirror[1]

    def deformation_gradients(self, x: Array) -> Array:
        """Return F (m, 2, 2) = ∂x/∂X of positions x (n, 2), column form (Song 2013, eq. 1)."""
        turn, mirror = self.turn_and_mirror(x)
        along_x, along_y = turn + mirror, 1j * (turn - mirror)
        columns = np.stack([along_x, along_y], axis=-1)
        return np.stack([columns.real, columns.imag], axis=1)

    def determinants(self, x: Array) -> Array:
        """Return J = det F (m,) of positions x (n, 2)."""
        turn, mirror = self.turn_and_mirror(x)
        return turn.real**2 + turn.imag**2 - mirror.real**2 - mirror.imag**2

    @cached_property
    def laplacian(self) -> csr_array:
        """(n, n) stiffness matrix of Σ A ‖F‖² / 2: the cotangent Laplacian."""
        weights = np.repeat(self.areas, 2)
        return csr_array(self.operator.T @ (self.operator.multiply(weights[:, None])))
