"""Projected Newton on Σ A ψ(F) with some vertices fixed.

Each element's Hessian is projected to positive semidefinite in closed form: for an isotropic ψ its
eigenvectors in the space of F are two scaling modes, a flip and a twist (Smith, de Goes and Kim
2019, "Analytic eigensystems for isotropic distortion energies").
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import qdldl
from scipy.sparse import csc_array, csc_matrix, triu

from core.fem.elements import Elements
from core.fem.energies import Density, Derivatives
from core.geometry.flatness import first_flatness
from core.geometry.rotation import (
    Complex,
    signed_singular_values,
    to_complex,
    turn_and_mirror,
    unit,
)
from core.geometry.triangulation import Indices
from core.model.outline import Array

ARMIJO = 1e-4
HALVINGS = 30
STEP_TO_FLAT = 0.9
"""Fraction of the way to the first J = 0 that a step may go under a barrier."""
GROWTH = 1.5
"""How much further a step that helped goes at the next try."""
REGULARISATION = 1e-10
"""Added to the Hessian's diagonal, relative to its largest entry."""

PAIRS = np.triu_indices(6)
"""The upper triangle of an element matrix: rows and columns."""


class Factor:
    """A sparse symmetric positive definite matrix, factored as L D Lᵀ once for many loads.

    QDLDL and not scipy's SuperLU, whose memory is lost where a factor dies in another thread than
    it was made in (scipy issue 15921).
    """

    def __init__(self, matrix: csc_array) -> None:
        self._solver = qdldl.Solver(csc_matrix(triu(matrix)), upper=True)

    def solve(self, load: Array) -> Array:
        """Return x (n, k) for which the matrix times x is a load (n, k), column by column."""
        x = np.empty(load.shape[::-1])
        for row, column in zip(x, load.T, strict=True):
            row[:] = self._solver.solve(column)
        return x.T


class ElementSystem:
    """Linear systems of element matrices: their sparsity is found once, only numbers change."""

    def __init__(self, unknowns: Indices, size: int) -> None:
        """Prepare for ``size`` unknowns; (6, m) says which the coordinates of elements' corners
        are, or -1 where they are fixed.
        """
        ends = unknowns[np.array(PAIRS)]  # (2, 21, m)
        row, column = ends.min(axis=0).ravel(), ends.max(axis=0).ravel()
        self._used = np.flatnonzero(row >= 0)
        keys, self._slot = np.unique(
            column[self._used] * size + row[self._used], return_inverse=True
        )
        pointer = np.searchsorted(keys, np.arange(size + 1) * size)
        self._upper = csc_matrix((np.zeros(len(keys)), keys % size, pointer), shape=(size, size))
        self._diagonal = pointer[1:] - 1
        self._factor: qdldl.Solver | None = None

    def solve(self, blocks: Array, load: Array, held: Array | float = 0.0) -> Array:
        """Sum element matrices, given as upper triangles (21, m), and solve for load (size,).

        ``held`` is added to the diagonal.
        """
        data = np.bincount(self._slot, weights=blocks.ravel()[self._used])
        data[self._diagonal] += REGULARISATION * data[self._diagonal].max() + held
        self._upper.data[:] = data
        if self._factor is None:
            self._factor = qdldl.Solver(self._upper, upper=True)
        else:
            self._factor.update(self._upper, upper=True)
        return self._factor.solve(load)


class FreeVertices(ElementSystem):
    """The linear systems of the free vertices."""

    def __init__(self, elements: Elements, free: Indices) -> None:
        """Prepare for the vertices ``free`` (k,) of ``elements``; all others are fixed."""
        self.elements, self.free = elements, free
        number = np.full(elements.vertices, -1)
        number[free] = np.arange(len(free))
        corners = number[elements.triangles]
        unknowns = np.where(corners[..., None] < 0, -1, 2 * corners[..., None] + [0, 1])
        super().__init__(unknowns.reshape(-1, 6).T, 2 * len(free))


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
    s1, s2 = signed_singular_values(elements.deformation_gradients(x))
    return float(elements.areas @ density.value(s1, s2))


@dataclass(frozen=True, eq=False)
class Terms:
    """An energy at some positions, with its derivatives element by element."""

    energy: float
    gradient: Array
    """(6, m) by the coordinates of the corners."""
    hessian: Array
    """(21, m) upper triangles, positive semidefinite."""

    def __add__(self, other: Terms) -> Terms:
        """Return the terms of both energies' sum, over the same triangles."""
        return Terms(
            self.energy + other.energy,
            self.gradient + other.gradient,
            self.hessian + other.hessian,
        )


def density_terms(elements: Elements, density: Density, x: Array) -> Terms:
    """Return Σ A ψ at positions x (n, 2), its Hessian projected."""
    turn, mirror = turn_and_mirror(elements.deformation_gradients(x))
    s1, s2 = np.abs(turn) + np.abs(mirror), np.abs(turn) - np.abs(mirror)
    d = density.derivatives(s1, s2)
    modes = _modes(elements.hats, unit(turn), unit(mirror))
    stress = d.d1 * modes[0] + d.d2 * modes[1]
    eigenmodes = _weighted_eigenmodes(d, s1, s2, modes) * np.sqrt(elements.areas)
    value = float(elements.areas @ density.value(s1, s2))
    return Terms(value, elements.areas * stress, _squared(eigenmodes))


def newton_step(vertices: FreeVertices, density: Density, x: Array) -> Step:
    """Return the projected Newton direction of Σ A ψ at positions x (n, 2)."""
    return step_of(vertices, density_terms(vertices.elements, density, x))


def step_of(vertices: FreeVertices, terms: Terms) -> Step:
    """Return the direction that minimises an energy's quadratic model over the free vertices."""
    gradient = _scatter(vertices.elements, terms.gradient)[vertices.free].ravel()
    solution = vertices.solve(terms.hessian, -gradient)
    direction = np.zeros((vertices.elements.vertices, 2))
    direction[vertices.free] = solution.reshape(-1, 2)
    return Step(terms.energy, direction, float(gradient @ solution))


def line_search(elements: Elements, density: Density, x: Array, step: Step) -> tuple[Array, float]:
    """Return (new positions, new energy) of Σ A ψ further along a step.

    Under a barrier the first try stops short of the first flat triangle, and a full step is made
    longer while that helps: away from a pole Newton's method creeps (on σ⁻², by a third of σ).
    """

    def objective(y: Array) -> float:
        return energy(elements, density, y)

    if not density.barrier:
        return backtrack(objective, x, step, 1.0)
    reach = STEP_TO_FLAT * step_to_flat(elements, x, step.direction)
    y, value = backtrack(objective, x, step, min(1.0, reach))
    length = GROWTH
    while length < reach and value < step.energy:
        longer = x + length * step.direction
        if (after := objective(longer)) >= value:
            break
        y, value, length = longer, after, GROWTH * length
    return y, value


def backtrack(
    objective: Callable[[Array], float], x: Array, step: Step, length: float
) -> tuple[Array, float]:
    """Return (new positions, new energy) by halving a length until Armijo's condition holds.

    Where no length helps, x itself and its energy are returned.
    """
    for _ in range(HALVINGS):
        candidate = x + length * step.direction
        value = objective(candidate)
        if value <= step.energy + ARMIJO * length * step.slope:
            return candidate, value
        length /= 2
    return x, step.energy


def safe_length(elements: Elements, x: Array, step: Step) -> float:
    """Return the longest part of a step, at most all of it, that stops short of a flat triangle."""
    return min(1.0, STEP_TO_FLAT * step_to_flat(elements, x, step.direction))


def step_to_flat(elements: Elements, x: Array, direction: Array) -> float:
    """Return the smallest t > 0 at which a triangle of x + t · direction is flat, or infinity."""
    corners = elements.triangles.T
    return first_flatness(to_complex(x)[corners], to_complex(direction)[corners])


def _modes(hats: Complex, turn: Complex, mirror: Complex) -> Array:
    """Return (4, 6, m): how the corners' coordinates excite scaling 1, scaling 2, flip and twist.

    With F = R(α) diag(σ₁, σ₂) R(β)ᵀ the modes are R(α) E R(β)ᵀ for E = diag(1, 0), diag(0, 1) and
    the symmetric and the antisymmetric off-diagonal matrix over √2. They need no angles: turn =
    exp(i(α − β)) and mirror = exp(i(α + β)) are what F consists of.
    """
    even, odd = turn * hats, mirror * np.conj(hats)
    modes = np.stack(
        [(even + odd) / 2, (even - odd) / 2, 1j * odd / np.sqrt(2), 1j * even / np.sqrt(2)]
    )
    return np.stack([modes.real, modes.imag], axis=2).reshape(4, 6, -1)


def _weighted_eigenmodes(d: Derivatives, s1: Array, s2: Array, modes: Array) -> Array:
    """Return (4, 6, m) the eigenmodes of ψ's Hessian times the roots of its eigenvalues.

    Negative eigenvalues are clamped at 0, so the sum of their outer products is the projected
    Hessian. The scaling modes mix by the angle that diagonalises their 2 x 2 block.
    """
    mean, half = (d.d11 + d.d22) / 2, (d.d11 - d.d22) / 2
    radius = np.hypot(half, d.d12)
    share = np.divide(half, radius, out=np.ones_like(radius), where=radius > 0)
    cos = np.sqrt((1 + share) / 2)
    sin = np.copysign(np.sqrt(np.maximum(1 - share, 0) / 2), d.d12)
    eigenvalues = np.stack(
        [
            mean + radius,
            mean - radius,
            _quotient(d.d1 - d.d2, s1 - s2, d.d11 - d.d12, s1),
            _quotient(d.d1 + d.d2, s1 + s2, d.d12 + d.d22, s1),
        ]
    )
    mixed = np.stack(
        [cos * modes[0] + sin * modes[1], cos * modes[1] - sin * modes[0], modes[2], modes[3]]
    )
    return np.sqrt(np.maximum(eigenvalues, 0))[:, None] * mixed


def _squared(modes: Array) -> Array:
    """Return the upper triangles (21, m) of Σ v vᵀ over modes v (k, 6, m), in the order of PAIRS.

    Row by row: no copies are made, which takes a twentieth of the time of one contraction.
    """
    rows = [np.einsum("km,kpm->pm", modes[:, i], modes[:, i:]) for i in range(6)]
    return np.concatenate(rows)


def _quotient(above: Array, below: Array, limit: Array, scale: Array) -> Array:
    """Return above / below, or its limit where below vanishes."""
    vanishing = np.abs(below) < 1e-7 * (1 + scale)
    return np.where(vanishing, limit, above / np.where(vanishing, 1, below))


def _scatter(elements: Elements, blocks: Array) -> Array:
    """Sum corner values (6, m) into (n, 2)."""
    corners = elements.triangles.T.ravel()
    sums = [
        np.bincount(corners, weights=blocks[i::2].ravel(), minlength=elements.vertices)
        for i in (0, 1)
    ]
    return np.column_stack(sums)
