"""Positions whose gradients come closest to given ones: prepared once, one solve each."""

from __future__ import annotations

import numpy as np
from scipy.sparse import bsr_array, csr_array

from core.fem.elements import Elements
from core.fem.newton import factorise
from core.model.outline import Array


class GradientFit:
    """Minimises Σ tr((F(x) − B) M (F(x) − B)ᵀ) over positions x, for ideal gradients B.

    Its matrix depends on the mesh and the weights M alone (Song 2013, eqs. 3 to 5; a cotangent
    Laplacian when M is the triangle's area), so it is factored here. Vertex 0 is pinned at the
    origin.
    """

    def __init__(self, elements: Elements, weights: Array) -> None:
        """Prepare for weights M (m, 2, 2), symmetric positive definite."""
        m = len(weights)
        blocks = bsr_array((weights, np.arange(m), np.arange(m + 1)), shape=(2 * m, 2 * m))
        weighted = csr_array(elements.operator.T @ blocks.tocsr())[1:]
        self._load = weighted
        self._factor = factorise((weighted @ elements.operator[:, 1:]).tocsc())

    def load(self, ideal: Array) -> Array:
        """Return the right-hand sides (n − 1, 2) for ideal gradients (m, 2, 2)."""
        return self._load @ ideal.transpose(0, 2, 1).reshape(-1, 2)

    def solve(self, load: Array) -> Array:
        """Return the positions (n − 1, 2) of all vertices but the pinned one."""
        return self._factor.solve(load)

    def __call__(self, ideal: Array) -> Array:
        """Return the positions (n, 2)."""
        solved = self.solve(self.load(ideal))
        return np.concatenate([np.zeros((1, 2)), solved])
