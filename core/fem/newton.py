"""Projected Newton on Σ A ψ(F) with some vertices fixed.

Each element's Hessian is projected to positive semidefinite in closed form: for an isotropic ψ its
eigenvectors in the space of F are two scaling modes, a flip and a twist (Smith, de Goes and Kim
2019, "Analytic eigensystems for isotropic distortion energies").
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import SuperLU, splu

from core.fem.elements import Elements, determinants
from core.fem.energies import Density, Derivatives
from core.geometry.rotation import signed_svd
from core.geometry.triangulation import Indices
from core.model.outline import Array

ARMIJO = 1e-4
HALVINGS = 30
STEP_TO_FLAT = 0.9
"""Fraction of the way to the first J = 0 that a step may go under a barrier."""


def factorise(matrix: csc_array) -> SuperLU:
    """Factor a sparse symmetric positive definite matrix by LU, without pivoting."""
    return splu(
        matrix,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )


@dataclass(frozen=True, eq=False)
class FreeVertices:
    """Where the element matrices of the free vertices go in the global one: found once."""

    elements: Elements
    free: Indices
    """(k,) the vertices that move."""

    @cached_property
    def _layout(self) -> tuple[Indices, Indices, Indices, Indices]:
        number = np.full(self.elements.vertices, -1)
        number[self.free] = np.arange(len(self.free))
        corners = number[self.elements.triangles]
        unknown = np.where(corners[..., None] < 0, -1, 2 * corners[..., None] + [0, 1])
        unknown = unknown.reshape(-1, 6)
        row = np.repeat(unknown, 6, axis=1).ravel()
        column = np.tile(unknown, (1, 6)).ravel()
        used = np.flatnonzero((row >= 0) & (column >= 0))
        size = 2 * len(self.free)
        keys, slot = np.unique(column[used] * size + row[used], return_inverse=True)
        pointer = np.searchsorted(keys, np.arange(size + 1) * size)
        return used, slot, keys % size, pointer

    def assemble(self, blocks: Array) -> csc_array:
        """Sum element matrices (m, 6, 6) into the (2k, 2k) matrix of the free coordinates."""
        used, slot, rows, pointer = self._layout
        data = np.bincount(slot, weights=blocks.ravel()[used], minlength=len(rows))
        return csc_array((data, rows, pointer), shape=(len(pointer) - 1,) * 2)


@dataclass(frozen=True, eq=False)
class Step:
    """One Newton direction and what was seen on the way."""

    energy: float
    direction: Array
    """(n, 2), zero at fixed vertices."""
    slope: float
    """Derivative of the energy along it; negative."""


def energy(elements: Elements, density: Density, x: Array) -> float:
    """Return Σ A ψ(F) at positions x (n, 2)."""
    _, s1, s2, _ = signed_svd(elements.deformation_gradients(x))
    return float(elements.areas @ density.value(s1, s2))


def newton_step(vertices: FreeVertices, density: Density, x: Array) -> Step:
    """Return the projected Newton direction of Σ A ψ at positions x (n, 2)."""
    elements = vertices.elements
    alpha, s1, s2, beta = signed_svd(elements.deformation_gradients(x))
    d = density.derivatives(s1, s2)
    modes = _modes(alpha, beta, elements.gradients)
    stress = d.d1[:, None] * modes[:, 0] + d.d2[:, None] * modes[:, 1]
    gradient = _scatter(elements, elements.areas[:, None] * stress)
    curvature = _projected_curvature(d, s1, s2) * elements.areas[:, None, None]
    matrix = vertices.assemble(modes.transpose(0, 2, 1) @ (curvature @ modes))
    shift = 1e-10 * matrix.diagonal().max()
    matrix.setdiag(matrix.diagonal() + shift)
    free = gradient[vertices.free].ravel()
    solution = factorise(matrix).solve(-free)
    direction = np.zeros_like(x)
    direction[vertices.free] = solution.reshape(-1, 2)
    value = float(elements.areas @ density.value(s1, s2))
    return Step(value, direction, float(free @ solution))


def line_search(elements: Elements, density: Density, x: Array, step: Step) -> tuple[Array, float]:
    """Return (new positions, new energy) by halving until Armijo's condition holds.

    Under a barrier the first try stops short of the first flat triangle. Where no length helps, x
    itself and its energy are returned.
    """
    length = 1.0
    if density.barrier:
        length = min(1.0, STEP_TO_FLAT * step_to_flat(elements, x, step.direction))
    for _ in range(HALVINGS):
        candidate = x + length * step.direction
        value = energy(elements, density, candidate)
        if value <= step.energy + ARMIJO * length * step.slope:
            return candidate, value
        length /= 2
    return x, step.energy


def step_to_flat(elements: Elements, x: Array, direction: Array) -> float:
    """Return the smallest t > 0 at which a triangle of x + t · direction is flat, or infinity."""
    F, G = (elements.deformation_gradients(v) for v in (x, direction))
    a, c = determinants(G), determinants(F)
    b = F[:, 0, 0] * G[:, 1, 1] + F[:, 1, 1] * G[:, 0, 0]
    b -= F[:, 0, 1] * G[:, 1, 0] + F[:, 1, 0] * G[:, 0, 1]
    root = np.sqrt(np.maximum(b * b - 4 * a * c, 0))
    q = -(b + np.copysign(root, b)) / 2  # the form of the roots in which nothing cancels
    with np.errstate(divide="ignore", invalid="ignore"):
        roots = np.stack([q / a, c / q])
    real = (b * b - 4 * a * c >= 0) & np.isfinite(roots) & (roots > 0)
    return float(roots[real].min(initial=np.inf))


def _modes(alpha: Array, beta: Array, gradients: Array) -> Array:
    """Return (m, 4, 6): how the corners' coordinates excite scaling 1, scaling 2, flip and twist.

    The modes are U E Vᵀ with E = diag(1, 0), diag(0, 1), the symmetric and the antisymmetric
    off-diagonal matrix over √2.
    """
    u1 = np.stack([np.cos(alpha), np.sin(alpha)], axis=1)
    v1 = np.stack([np.cos(beta), np.sin(beta)], axis=1)
    u2 = np.stack([-u1[:, 1], u1[:, 0]], axis=1)
    v2 = np.stack([-v1[:, 1], v1[:, 0]], axis=1)
    g1 = np.einsum("maj,mj->ma", gradients, v1)
    g2 = np.einsum("maj,mj->ma", gradients, v2)
    scale1 = g1[:, :, None] * u1[:, None, :]
    scale2 = g2[:, :, None] * u2[:, None, :]
    across, back = g1[:, :, None] * u2[:, None, :], g2[:, :, None] * u1[:, None, :]
    flip, twist = (across + back) / np.sqrt(2), (across - back) / np.sqrt(2)
    return np.stack([scale1, scale2, flip, twist], axis=1).reshape(-1, 4, 6)


def _projected_curvature(d: Derivatives, s1: Array, s2: Array) -> Array:
    """Return (m, 4, 4) the Hessian of ψ in the basis of the modes, its eigenvalues clamped at 0."""
    blocks = np.zeros((len(s1), 4, 4))
    # the 2 x 2 block of the scaling modes, from its two eigenvalues
    mean, half = (d.d11 + d.d22) / 2, (d.d11 - d.d22) / 2
    radius = np.hypot(half, d.d12)
    high, low = np.maximum(mean + radius, 0), np.maximum(mean - radius, 0)
    middle, spread = (high + low) / 2, (high - low) / 2
    safe = np.where(radius > 0, radius, 1)
    blocks[:, 0, 0] = middle + spread * half / safe
    blocks[:, 1, 1] = middle - spread * half / safe
    blocks[:, 0, 1] = blocks[:, 1, 0] = spread * d.d12 / safe
    blocks[:, 2, 2] = np.maximum(_quotient(d.d1 - d.d2, s1 - s2, d.d11 - d.d12, s1), 0)
    blocks[:, 3, 3] = np.maximum(_quotient(d.d1 + d.d2, s1 + s2, d.d12 + d.d22, s1), 0)
    return blocks


def _quotient(above: Array, below: Array, limit: Array, scale: Array) -> Array:
    """Return above / below, or its limit where below vanishes."""
    vanishing = np.abs(below) < 1e-7 * (1 + scale)
    return np.where(vanishing, limit, above / np.where(vanishing, 1, below))


def _scatter(elements: Elements, blocks: Array) -> Array:
    """Sum corner values (m, 6) into (n, 2)."""
    corners = elements.triangles.ravel()
    values = blocks.reshape(-1, 2)
    return np.column_stack(
        [np.bincount(corners, weights=values[:, i], minlength=elements.vertices) for i in (0, 1)]
    )
