"""Gaps that must not close, and positions that keep them open while straying least."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Protocol, cast

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from core.geometry.rotation import Complex
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.progress import Watch, unwatched

ARMIJO = 1e-4
HALVINGS = 30
MOST_STEPS, LEAST_STEPS = 60, 8
WORK = 1e9
"""Cubes of held vertices, times steps, that are worth while for a frame."""
LEFT_ALONE = 1 / 4
"""Part of its size in frames that are to be left alone below which a gap may be felt elsewhere."""
REGULARISATION = 1e-10
"""Added to a Hessian's diagonal where it is not definite, relative to its largest entry."""
CONVERGED = 1e-16
"""Newton decrement below which one more step settles positions, at unit area: tiny triangles weigh
their area, and must be lifted off their folds as well."""


@dataclass(frozen=True, eq=False)
class Derivatives:
    """How gaps change with the three corners each depends on."""

    gaps: Array
    """(c,)"""
    slopes: Array
    """(c, 6) by the corners' coordinates."""
    bends: Array
    """(c, 6, 6) second derivatives."""


class Gaps(Protocol):
    """Gaps of one kind, in units of the gap below which they are felt: closed at 0."""

    bent: ClassVar[bool]
    """Whether they bend so sharply that a step which leaves that out gets nowhere."""

    @property
    def corners(self) -> Indices:
        """(c, 3) the vertices on which each depends, numbered among those that are held."""

    @property
    def weights(self) -> Array:
        """(c,) how much the barrier of each counts; below 0 takes off what two others count."""

    def __call__(self, z: Complex) -> Array:
        """Return the gaps (c,) at positions z (k,)."""

    def derivatives(self, z: Complex, which: Indices) -> Derivatives:
        """Return some of the gaps with their derivatives."""

    def free_way(self, z: Complex, step: Complex) -> float:
        """Return a part of a step within which no gap closes."""
        ...


def settle(
    fitted: Complex,
    stiffness: Array,
    kinds: Sequence[Gaps],
    start: Complex,
    watch: Watch = unwatched,
) -> Complex:
    """Minimise (z − fitted)ᴴ K (z − fitted) + Σ w b(u(z)) from a start (k,) with open gaps.

    The barrier b is felt below a gap of 1 and infinite at 0 (Li et al. 2020, "Incremental potential
    contact"). Steps are Newton's; at first, and where the energy is not convex, Hessians are made
    so gap by gap: projected, or Gauss and Newton's. Wherever it ends, all gaps are open. A start
    with a closed gap, which is none but for rounding, is returned as it is.
    """
    pull = np.zeros((2 * len(fitted), 2 * len(fitted)))
    pull[::2, ::2] = pull[1::2, 1::2] = 2 * stiffness

    def energy(z: Complex) -> float:
        off = z - fitted
        misfit = float(np.vdot(off, stiffness @ off).real)
        return misfit + sum(float(kind.weights @ barrier(kind(z))) for kind in kinds)

    with np.errstate(invalid="ignore"):  # a closed gap may be infinitely bad either way
        z, value, convex = start, energy(start), True
    if not np.isfinite(value):
        return start
    for _ in range(steps_worth(len(fitted))):
        watch("in-between")
        terms = [_terms(kind, z) for kind in kinds]
        gradient = pull @ (z - fitted).view(float)
        for term in terms:
            np.add.at(gradient, term.unknowns.ravel(), term.slopes.ravel())
        direction, convex = _direction(pull, terms, gradient, convex)
        step, slope = direction.view(complex), float(gradient @ direction)
        length = min([1.0, *(kind.free_way(z, step) for kind in kinds)])
        if -slope < CONVERGED:
            return z + length * step
        for _ in range(HALVINGS):
            reached = energy(z + length * step)
            if reached <= value + ARMIJO * length * slope:
                break
            length /= 2
        else:
            return z
        z, value, convex = z + length * step, reached, convex and length < 1
    return z


def steps_worth(held: int) -> int:
    """Return how many steps are made at most between so many vertices.

    The more are held the longer a step takes, as their cube: no frame may take for ever.
    """
    return int(np.clip(WORK / max(held, 1) ** 3, LEAST_STEPS, MOST_STEPS))


def barrier(u: Array) -> Array:
    """Return b(u) = −(u − 1)² ln u for gaps u (c,): 0 above 1, infinite at 0 and below."""
    inside = np.clip(u, 1e-300, 1)
    return np.where(u > 0, -((inside - 1) ** 2) * np.log(inside), np.inf)


@dataclass(frozen=True, eq=False)
class _Terms:
    """Derivatives of Σ w b(u) by the unknowns (c, 6) that each gap depends on."""

    unknowns: Indices
    slopes: Array
    """(c, 6)"""
    squares: Array
    """(c, 6, 6) part of the Hessian that has the sign of w."""
    bends: Array
    """(c, 6, 6) the other part."""
    added: NDArray[np.bool_]
    """(c,) whether w > 0."""
    bent: bool

    def add_to(self, matrix: Array, *, convex: bool) -> None:
        """Add the Hessian to a matrix, or but what of each term is convex."""
        blocks, unknowns = self.squares, self.unknowns
        if self.bent or not convex:
            blocks = blocks + self.bends
        if convex:
            blocks, unknowns = blocks[self.added], unknowns[self.added]
            blocks = _projected(blocks) if self.bent else blocks
        places = unknowns[:, :, None] * len(matrix) + unknowns[:, None]
        np.add.at(matrix.reshape(-1), places.ravel(), blocks.ravel())


def _projected(blocks: Array) -> Array:
    """Return the closest positive semidefinite matrices (c, 6, 6) to symmetric ones."""
    values, axes = np.linalg.eigh(blocks)
    return (axes * np.maximum(values, 0)[:, None]) @ axes.transpose(0, 2, 1)


def _terms(kind: Gaps, z: Complex) -> _Terms:
    felt = np.flatnonzero(kind(z) < 1)
    at, weights = kind.derivatives(z, felt), kind.weights[felt]
    u, log = at.gaps, np.log(at.gaps)
    slope = -weights * (2 * (u - 1) * log + (u - 1) ** 2 / u)
    bend = -weights * (2 * log + 4 * (u - 1) / u - (u - 1) ** 2 / u**2)
    unknowns = 2 * kind.corners[felt][:, :, None] + np.arange(2)
    return _Terms(
        unknowns.reshape(-1, 6),
        slope[:, None] * at.slopes,
        bend[:, None, None] * at.slopes[:, :, None] * at.slopes[:, None],
        slope[:, None, None] * at.bends,
        weights > 0,
        kind.bent,
    )


def _direction(
    pull: Array, terms: Sequence[_Terms], gradient: Array, convex: bool
) -> tuple[Array, bool]:
    """Return a step downhill, and whether it had to be made convex, as one may know beforehand."""
    if not convex:
        try:
            return _downhill(pull, terms, gradient, convex=False), False
        except LinAlgError:
            pass
    return _downhill(pull, terms, gradient, convex=True), True


def _downhill(pull: Array, terms: Sequence[_Terms], gradient: Array, *, convex: bool) -> Array:
    matrix = pull.copy()
    for term in terms:
        term.add_to(matrix, convex=convex)
    if convex:
        matrix[np.diag_indices_from(matrix)] += REGULARISATION * matrix.diagonal().max(initial=0)
    factor = cho_factor(matrix.T, overwrite_a=True, check_finite=False)
    return cast(Array, -cho_solve(factor, gradient, check_finite=False))
