"""Positions whose gradients come closest to given ones: prepared once, one solve each."""

from __future__ import annotations

from typing import cast

import numpy as np
from scipy.sparse import bsr_array, csr_array

from core.fem.elements import Elements
from core.fem.newton import Factor
from core.geometry.rotation import Complex, to_points
from core.geometry.triangulation import Indices
from core.model.outline import Array

KEPT = 2**25
"""Bytes of answers to pushes that are kept: neighbouring frames are held at the same vertices."""


class GradientFit:
    """Minimises Σ tr((F(x) − B) M (F(x) − B)ᵀ) over positions x, for ideal gradients B.

    That is (x − x̂)ᵀ K (x − x̂) up to a constant, x̂ being the minimum. K depends on the mesh and the
    weights M alone (Song 2013, eqs. 3 to 5; a cotangent Laplacian when M is the triangle's area),
    so it is factored here. A spring ties vertex 0 to the origin; as no force moves the whole shape,
    it is always at rest.
    """

    def __init__(self, elements: Elements, weights: Array) -> None:
        """Prepare for weights M (m, 2, 2), symmetric positive definite."""
        m = len(weights)
        blocks = bsr_array((weights, np.arange(m), np.arange(m + 1)), shape=(2 * m, 2 * m))
        matrix = csr_array(elements.operator.T @ blocks.tocsr() @ elements.operator)
        matrix[0, 0] *= 2
        self._factor = Factor(matrix.tocsc())
        self._load = _load_operator(elements, weights)
        self._answers: dict[int, Array] = {}
        """By the vertex that is pushed."""

    def load(self, ideal: Complex) -> Array:
        """Return the right-hand sides (n, 2) for ideal gradients: turns and mirrors (2, m)."""
        return to_points(self._load @ ideal.ravel())

    def solve(self, load: Array) -> Array:
        """Return the positions (n, 2) that balance a load (n, 2)."""
        return self._factor.solve(load)

    def __call__(self, ideal: Complex) -> Array:
        """Return the positions x̂ (n, 2) for ideal gradients: turns and mirrors (2, m)."""
        return self.solve(self.load(ideal))

    def stiffness(self, vertices: Indices) -> Array:
        """Return K (k, k) of some vertices when all others follow: its Schur complement."""
        compliance = np.empty((len(vertices), len(vertices)))
        for row, vertex in zip(compliance, vertices.tolist(), strict=True):
            row[:] = self._answer(vertex)[vertices]
        return cast(Array, np.linalg.inv((compliance + compliance.T) / 2))

    def _answer(self, vertex: int) -> Array:
        """Return how far every vertex (n,) goes when one is pushed."""
        answer = self._answers.get(vertex)
        if answer is None:
            unit = np.zeros((self._load.shape[0], 1))
            unit[vertex] = 1
            answer = self._answers[vertex] = self.solve(unit)[:, 0]
            if len(self._answers) * answer.nbytes > KEPT:
                del self._answers[next(iter(self._answers))]
        return answer


def _load_operator(elements: Elements, weights: Array) -> csr_array:
    """Return (n, 2m): what turns and mirrors load the vertices with, as complex numbers.

    A corner whose hat function has the gradient g gets B M g.
    """
    m = len(weights)
    pull = np.einsum("mij,mcj->mci", weights, elements.gradients)
    corners = (pull[..., 0] + 1j * pull[..., 1]).ravel()
    rows, columns = elements.triangles.ravel(), np.repeat(np.arange(m), 3)
    entries = np.concatenate([corners, np.conj(corners)])
    places = np.tile(rows, 2), np.concatenate([columns, columns + m])
    return csr_array((entries, places), shape=(elements.vertices, 2 * m))
