"""Frames without folds: the fit of ideal gradients, held back where a triangle nears a fold."""

from __future__ import annotations

import numpy as np

from core.fem.elements import Elements, determinants
from core.fem.energies.fold_barrier import FoldBarrier
from core.fem.newton import (
    PAIRS,
    FreeVertices,
    Terms,
    backtrack,
    density_terms,
    energy,
    safe_length,
    step_of,
)
from core.geometry.rotation import Complex
from core.model.outline import Array
from core.morph.motion.gradients import determinant, matrices

STIFFNESS = 0.1
CONVERGED = 1e-13
"""Newton decrement at which a frame is done, at unit area."""
MAX_STEPS = 60


class FoldGuard:
    """Minimises Σ tr((F − B) M (F − B)ᵀ) + w det B b(det F / det B) over positions.

    The barrier b is felt only close to a fold: elsewhere the minimum is
    the plain fit's, so frames run into each other smoothly and both ends stay exact.
    """

    def __init__(self, before: Elements, after: Elements, weights: Array) -> None:
        """Prepare for rest and target elements and the fit's weights M (m, 2, 2)."""
        self._elements, self._weights = before, weights
        self._areas = (before.areas + after.areas) / 2
        self._vertices = FreeVertices(before, np.arange(1, before.vertices))
        grams = 2 * before.gradients @ weights @ before.gradients.transpose(0, 2, 1)
        full = np.zeros((len(weights), 3, 2, 3, 2))
        full[:, :, [0, 1], :, [0, 1]] = grams
        rows, columns = PAIRS
        self._hessian = full.reshape(-1, 6, 6)[:, rows, columns].T

    def margin(self, x: Array, ideal: Complex) -> float:
        """Return the smallest det F / det B: a fold is 0 or less."""
        F = self._elements.deformation_gradients(x)
        return float((determinants(F) / determinant(ideal)).min())

    def __call__(self, ideal: Complex, start: Array) -> Array:
        """Return positions (n, 2) for ideal gradients B (2, m), from a start without folds."""
        J, B = determinant(ideal), matrices(ideal)
        stiffness = STIFFNESS * self._areas / self._elements.areas * J
        density = FoldBarrier(J, stiffness)

        def total(y: Array) -> float:
            return self._misfit(y, B)[0] + energy(self._elements, density, y)

        x = start
        for _ in range(MAX_STEPS):
            misfit, gradient = self._misfit(x, B)
            near = density_terms(self._elements, density, x)
            terms = Terms(
                misfit + near.energy, gradient + near.gradient, self._hessian + near.hessian
            )
            step = step_of(self._vertices, terms)
            if -step.slope < CONVERGED:
                break
            x, _ = backtrack(total, x, step, safe_length(self._elements, x, step))
        return x

    def _misfit(self, x: Array, ideal: Array) -> tuple[float, Array]:
        """Return Σ tr((F − B) M (F − B)ᵀ) and its gradient (6, m)."""
        off = self._elements.deformation_gradients(x) - ideal
        weighted = off @ self._weights
        value = float(np.einsum("mij,mij->", weighted, off))
        corners = 2 * self._elements.gradients @ weighted.transpose(0, 2, 1)
        return value, corners.reshape(-1, 6).T
