"""Slide the boundary of a map along both outlines to where it distorts least.

Arc length between marks shears limbs whose sides differ in length. Here every vertex of the
boundary may slide: where only the target bends, along the source, elsewhere along the target, so
that both outlines keep what was drawn. Projected Newton on the symmetric Dirichlet energy, by turns
at either end, whose barrier keeps the order of the vertices.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from core.fem.elements import Elements
from core.fem.energies import SymmetricDirichlet
from core.fem.newton import ARMIJO, PAIRS, ElementSystem, density_terms, energy
from core.geometry.polyline import arc_lengths, cross, points_at
from core.geometry.triangulation import Indices, Mesh
from core.model.outline import Array
from core.progress import Watch

Value = TypeVar("Value", np.float64, np.int64)

ROUNDS = 12
SETTLED = 0.01
"""Energy gained by a round, relative, below which it is not worth another."""
STRAIGHT = 1e-6
"""Where an outline turns by less it was not drawn but only split."""
CAREFUL = 0.3
"""How strongly vertices are kept from moving past their neighbours: more is slower but goes on."""
CHORD = 0.3
"""Half the chord that a direction is measured on, in mean distances of vertices."""
CLOSEST, HALVINGS = 0.8, 10
"""What part of the way to its neighbour a vertex may go at once; how often that is halved."""


def slide(mesh: Mesh, target: Array, watch: Watch) -> list[Array]:
    """Return where the boundary vertices of a map without folds belong, ring by ring.

    ``target`` (n, 2) is where the vertices of ``mesh`` go, at about unit area. The places (k, 2) on
    the source and on the target are fractions of a ring's perimeter, counted from its first vertex;
    on either they increase. ``watch(stage)`` is called before every step and may raise
    ``Cancelled``.
    """
    here, there = _bends(mesh.points, mesh.rings), _bends(target, mesh.rings)
    source = _End(mesh.points, mesh, there & ~here)
    image = _End(target, mesh, here | ~there)
    for _ in range(ROUNDS):
        gain = 0.0
        for still, moving in ((source, image), (image, source)):
            watch("sliding")
            gain += moving.improve(Elements.of(still.points, mesh.triangles))
        if gain < SETTLED:
            break
    ends = zip(source.fractions(), image.fractions(), strict=True)
    return [np.column_stack(places) for places in ends]


class _End:
    """One end of the map, whose inner vertices move freely and whose sliders along the outline."""

    def __init__(self, points: Array, mesh: Mesh, slides: NDArray[np.bool_]) -> None:
        """Take positions (n, 2), and which vertices of the boundary (b,), ring by ring, slide."""
        self.points = points.copy()
        self._curves = [points[ring] for ring in mesh.rings]
        self._lengths = [arc_lengths(curve) for curve in self._curves]
        self._at = np.concatenate([lengths[:-1] for lengths in self._lengths])
        boundary = np.concatenate(mesh.rings)
        self._inner = np.setdiff1d(np.arange(len(points)), boundary)
        self._slides, self._sliders = np.flatnonzero(slides), boundary[slides]
        free = 2 * len(self._inner)
        unknown = np.full((len(points), 2), -1)
        unknown[self._inner] = np.arange(free).reshape(-1, 2)
        unknown[self._sliders] = free + np.arange(len(self._sliders))[:, None]  # one for both
        self._triangles, self._size = mesh.triangles, free + len(self._sliders)
        self._unknowns = _by_element(unknown, mesh.triangles)
        self._system = ElementSystem(self._unknowns, self._size)
        i, j = PAIRS
        same = (self._unknowns[i] == self._unknowns[j]) & (i != j)[:, None]
        self._count = np.where(same, 2.0, 1.0)  # off the diagonal entries stand for two

    def fractions(self) -> list[Array]:
        """Return how far along its ring each vertex of the boundary is now, ring by ring."""
        pieces = zip(self._split(self._at), self._lengths, strict=True)
        return [at / lengths[-1] for at, lengths in pieces]

    def improve(self, elements: Elements) -> float:
        """Make one Newton step on the map from ``elements``; return the gain, relative."""
        terms = density_terms(elements, SymmetricDirichlet(), self.points)
        moved = _by_element(self._moved(), self._triangles)
        i, j = PAIRS
        blocks = terms.hessian * (self._count * moved[i] * moved[j])
        gradient = self._system.sum(terms.gradient * moved)
        step = self._system.solve(blocks, -gradient, self._held(terms.energy))
        along = np.zeros(len(self._at))
        along[self._slides] = step[2 * len(self._inner) :]
        inner = step[: 2 * len(self._inner)].reshape(-1, 2)
        length, slope = self._reach(along), float(gradient @ step)
        for _ in range(HALVINGS):
            at, points = self._at + length * along, self.points.copy()
            points[self._sliders] = self._located(at)[self._slides]
            points[self._inner] += length * inner
            value = energy(elements, SymmetricDirichlet(), points)
            if value < terms.energy + ARMIJO * length * slope:
                self._at, self.points = at, points
                return 1 - value / terms.energy
            length /= 2
        return 0.0

    def _moved(self) -> Array:
        """Return (n, 2) how the unknowns move the coordinates: sliders along a tangent."""
        half = np.concatenate([np.full(len(v) - 1, CHORD * v[-1] / len(v)) for v in self._lengths])
        chords = self._located(self._at + half) - self._located(self._at - half)
        moved = np.ones_like(self.points)
        moved[self._sliders] = (chords / (2 * half[:, None]))[self._slides]
        return moved

    def _held(self, energy: float) -> Array:
        """Return (k,) what is added to the unknowns' own stiffness: short edges are held most."""
        gaps = self._split(self._gaps(self._at, closed=True))
        near = np.concatenate([np.minimum(gap, np.roll(gap, 1)) for gap in gaps])[self._slides]
        held = CAREFUL * energy / len(self._at) / near**2
        return np.concatenate([np.zeros(2 * len(self._inner)), held])

    def _reach(self, along: Array) -> float:
        """Return how much of a step may be made before vertices meet."""
        gaps, closing = self._gaps(self._at, closed=True), -self._gaps(along, closed=False)
        meeting = closing > 0
        return min(1.0, CLOSEST * float((gaps[meeting] / closing[meeting]).min(initial=np.inf)))

    def _gaps(self, values: Array, *, closed: bool) -> Array:
        """Return (b,) the differences from vertex to vertex around each ring."""
        rounds = [lengths[-1] if closed else 0.0 for lengths in self._lengths]
        pieces = zip(self._split(values), rounds, strict=True)
        return np.concatenate([np.diff(np.append(v, v[0] + once)) for v, once in pieces])

    def _located(self, at: Array) -> Array:
        """Return (b, 2) the points on the outline at arc lengths (b,)."""
        pieces = zip(self._curves, self._lengths, self._split(at), strict=True)
        return np.concatenate([points_at(*piece) for piece in pieces])

    def _split(self, values: Array) -> list[Array]:
        return np.split(values, np.cumsum([len(curve) for curve in self._curves])[:-1])


def _bends(points: Array, rings: Sequence[Indices]) -> NDArray[np.bool_]:
    """Return (b,) whether the outline bends at each of its vertices."""
    found = []
    for ring in rings:
        edges = np.roll(points[ring], -1, axis=0) - points[ring]
        edges /= np.linalg.norm(edges, axis=1, keepdims=True)
        found.append(np.abs(cross(np.roll(edges, 1, axis=0), edges)) > STRAIGHT)
    return np.concatenate(found)


def _by_element(values: NDArray[Value], triangles: Indices) -> NDArray[Value]:
    """Return (6, m) the values (n, 2) at the coordinates of the elements' corners."""
    return values[triangles].reshape(-1, 6).T
