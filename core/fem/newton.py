"""Projected Newton on Σ A ψ(F) with some vertices fixed.

Each element's Hessian is projected to positive semidefinite in closed form: for an isotropic ψ its
eigenvectors in the space of F are two scaling modes, a flip and a twist (Smith, de Goes and Kim
2019, "Analytic eigensystems for isotropic distortion energies").
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np
import qdldl
from scipy.sparse import csc_array, csc_matrix, triu

from core.fem.elements import CORNER_PAIRS, Elements
from core.fem.energies import Density, Derivatives
from core.geometry.flatness import first_flatness
from core.geometry.rotation import Complex, to_complex
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

FIRST, SECOND = 2 * np.array(CORNER_PAIRS)
PAIRS = (
    np.concatenate([FIRST, FIRST + 1, FIRST, FIRST[:3] + 1]),
    np.concatenate([SECOND, SECOND + 1, SECOND + 1, SECOND[:3]]),
)
"""Which of the six coordinates of its corners the entries of an element's matrix belong to: x and
x, y and y, x and y, and y and x of different corners. Each pair comes once."""
TINY = 1e-300


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
        self._size, self._free = size, np.flatnonzero(unknowns.ravel() >= 0)
        self._number = unknowns.ravel()[self._free]
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

    def sum(self, values: Array) -> Array:
        """Sum values of the corners' coordinates (6, m) into those of the unknowns (size,)."""
        weights = values.ravel()[self._free]
        return np.bincount(self._number, weights, self._size).astype(float, copy=False)

    def solve(self, blocks: Array, load: Array, held: Array | float = 0.0) -> Array:
        """Sum element matrices (21, m), see ``PAIRS``, and solve for load (size,).

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
    turn, mirror = map(np.abs, elements.turn_and_mirror(x))
    value = density.value(turn + mirror, turn - mirror)
    return float(elements.areas @ value)


@dataclass(frozen=True, eq=False)
class Terms:
    """An energy at some positions, with its derivatives element by element."""

    energy: float
    gradient: Array
    """(6, m) by the coordinates of the corners."""
    hessian: Array
    """(21, m) element matrices, positive semidefinite, see ``PAIRS``."""

    def __add__(self, other: Terms) -> Terms:
        """Return the terms of both energies' sum, over the same triangles."""
        return Terms(
            self.energy + other.energy,
            self.gradient + other.gradient,
            self.hessian + other.hessian,
        )


def density_terms(elements: Elements, density: Density, x: Array) -> Terms:
    """Return Σ A ψ at positions x (n, 2), its Hessian projected."""
    turn, mirror = elements.turn_and_mirror(x)
    size, other = np.abs(turn), np.abs(mirror)
    s1, s2 = size + other, size - other
    d = density.derivatives(s1, s2)
    turn, mirror = turn / np.maximum(size, TINY), mirror / np.maximum(other, TINY)
    half = elements.areas / 2
    by_turn, by_mirror = half * (d.d1 + d.d2) * turn, half * (d.d1 - d.d2) * mirror
    stress = by_turn * elements.hats + by_mirror * np.conj(elements.hats)
    return Terms(
        float(elements.areas @ density.value(s1, s2)),
        np.stack([stress.real, stress.imag], axis=1).reshape(6, -1),
        _hessian(elements, _Modes.of(d, s1, s2), turn, mirror),
    )


def newton_step(vertices: FreeVertices, density: Density, x: Array) -> Step:
    """Return the projected Newton direction of Σ A ψ at positions x (n, 2)."""
    return step_of(vertices, density_terms(vertices.elements, density, x))


def step_of(vertices: FreeVertices, terms: Terms) -> Step:
    """Return the direction that minimises an energy's quadratic model over the free vertices."""
    gradient = vertices.sum(terms.gradient)
    solution = vertices.solve(terms.hessian, -gradient)
    direction = np.zeros((vertices.elements.vertices, 2))
    direction[vertices.free] = solution.reshape(-1, 2)
    return Step(terms.energy, direction, float(gradient @ solution))


def line_search(elements: Elements, density: Density, x: Array, step: Step) -> tuple[Array, float]:
    """Return (new positions, new energy) of Σ A ψ further along a step.

    Under a barrier the first try stops short of the first flat triangle. Where a full step gains
    more than its quadratic model says, it is made longer while that helps: away from a pole
    Newton's method creeps (on σ⁻², by a third of σ).
    """

    def objective(y: Array) -> float:
        return energy(elements, density, y)

    if not density.barrier:
        return backtrack(objective, x, step, 1.0)
    reach = STEP_TO_FLAT * step_to_flat(elements, x, step.direction)
    y, value = backtrack(objective, x, step, min(1.0, reach))
    length = GROWTH
    while length < reach and value < step.energy + step.slope / 2:
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


@dataclass(frozen=True, eq=False)
class _Modes:
    """How stiff ψ is, each (m,), towards changes of F that add to its turn or mirror part.

    With F = turn + mirror as complex numbers, σ₁ and σ₂ being |turn| ± |mirror|, the scaling modes
    add along either part, the twist across the turn and the flip across the mirror.
    """

    turn: Array
    mirror: Array
    mixed: Array
    """Of the turn towards the mirror."""
    twist: Array
    flip: Array

    @classmethod
    def of(cls, d: Derivatives, s1: Array, s2: Array) -> Self:
        """Clamp the eigenvalues of ψ's Hessian at 0.

        Those of the scaling modes are the two of [[ψ₁₁, ψ₁₂], [ψ₁₂, ψ₂₂]].
        """
        mean, half = (d.d11 + d.d22) / 2, (d.d11 - d.d22) / 2
        radius = np.sqrt(half * half + d.d12 * d.d12)
        high, low = np.maximum(mean + radius, 0), np.maximum(mean - radius, 0)
        share = (high - low) / np.maximum(2 * radius, TINY)
        mean, half, across = (high + low) / 2, share * half, share * d.d12
        flip = _quotient(d.d1 - d.d2, s1 - s2, d.d11 - d.d12, s1)
        twist = _quotient(d.d1 + d.d2, s1 + s2, d.d12 + d.d22, s1)
        return cls(mean + across, mean - across, half, np.maximum(twist, 0), np.maximum(flip, 0))


def _hessian(elements: Elements, k: _Modes, turn: Complex, mirror: Complex) -> Array:
    """Return the element matrices (21, m) of Σ A k v vᵀ over all modes, in the order of PAIRS.

    A corner with the hat gradient h excites what adds along the turn by v = turn · h, along the
    mirror by v = mirror · conj(h), and i times as much across. As a 2 x 2 block v wᵀ takes z to
    (v conj(w) z + v w conj(z)) / 2.
    """
    conjugate, plain = elements.products
    weight = elements.areas / 4
    mixed = 2 * weight * k.mixed * turn
    rotating = weight * (k.turn + k.twist) * conjugate
    rotating += weight * (k.mirror + k.flip) * np.conj(conjugate)
    rotating += (mixed * np.conj(mirror) * plain).real
    flipping = weight * (k.turn - k.twist) * turn**2 * plain
    flipping += weight * (k.mirror - k.flip) * mirror**2 * np.conj(plain)
    flipping += mixed * mirror * conjugate.real
    both, apart = flipping + rotating, flipping - rotating
    return np.concatenate([both.real, -apart.real, apart.imag, both.imag[:3]])


def _quotient(above: Array, below: Array, limit: Array, scale: Array) -> Array:
    """Return above / below, or its limit where below vanishes."""
    vanishing = np.abs(below) < 1e-7 * (1 + scale)
    return np.where(vanishing, limit, above / np.where(vanishing, 1, below))
