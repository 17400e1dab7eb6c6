"""Slide the boundary of a map along the target to where it distorts least.

Arc length between marks shears limbs whose sides differ in length. Here the vertices of the
boundary slide along the target, the inner ones follow. Projected Newton, on the energy that unfolds
while there are folds and on the symmetric Dirichlet energy after, whose barrier keeps the order of
the vertices. That rounds the target's corners off; the order and the distances that the vertices
come to are what counts.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from core.fem.elements import Elements
from core.fem.energies import Density, FoldoverFree, SymmetricDirichlet
from core.fem.newton import ARMIJO, PAIRS, ElementSystem, density_terms, energy
from core.geometry.polyline import arc_lengths, points_at
from core.geometry.triangulation import Mesh
from core.model.outline import Array
from core.morph.untangle import VALID, first_epsilon, next_epsilon
from core.progress import Watch

Value = TypeVar("Value", np.float64, np.int64)

STEPS = 12
SETTLED = 0.005
"""Energy gained by a step, relative, below which it is not worth another."""
FURTHER = 1.5
"""How far vertices are taken in the end, measured by how far they came: those in the way of others
stop them early."""
APART = 0.01
"""How much of the distance between vertices is kept where that would let them meet."""
CAREFUL = 0.3
"""How strongly vertices are kept from moving past their neighbours: more is slower but goes on."""
CHORD = 0.3
"""Half the chord that a direction is measured on, in mean distances of vertices."""
CLOSEST, HALVINGS = 0.8, 10
"""What part of the way to its neighbour a vertex may go at once; how often that is halved."""


def slide(mesh: Mesh, target: Array, watch: Watch) -> list[Array]:
    """Return where the boundary vertices of a map belong on the target, ring by ring.

    ``target`` (n, 2) is where the vertices of ``mesh`` go, at about unit area; the map may have
    folds. The places (k, 2) on the source and on the target are fractions of a ring's perimeter,
    counted from its first vertex; on either they increase. ``watch(stage)`` is called before every
    step and may raise ``Cancelled``.
    """
    elements, sliders = Elements.of(mesh.points, mesh.triangles), _Sliders(mesh, target)
    J = elements.determinants(target)
    epsilon = first_epsilon(J)
    for _ in range(STEPS):
        watch("sliding")
        sound = J.min() > VALID
        before, after = sliders.step(
            elements, SymmetricDirichlet() if sound else FoldoverFree(epsilon)
        )
        if sound and after > (1 - SETTLED) * before:
            break
        J = elements.determinants(sliders.points)
        epsilon = next_epsilon(epsilon, J, before, after)
    here = [arc_lengths(mesh.points[ring]) for ring in mesh.rings]
    return [
        np.column_stack([lengths[:-1] / lengths[-1], there])
        for lengths, there in zip(here, sliders.places(), strict=True)
    ]


class _Sliders:
    """The target's vertices: the inner ones move freely, those of the boundary along it."""

    def __init__(self, mesh: Mesh, target: Array) -> None:
        self.points = target.copy()
        """(n, 2) where they are."""
        self._curves = [target[ring] for ring in mesh.rings]
        self._lengths = [arc_lengths(curve) for curve in self._curves]
        self._at = np.concatenate([lengths[:-1] for lengths in self._lengths])
        b, free = mesh.boundary_size, 2 * (len(target) - mesh.boundary_size)
        unknown = np.empty((len(target), 2), np.int64)
        unknown[b:] = np.arange(free).reshape(-1, 2)
        unknown[:b] = free + np.arange(b)[:, None]  # one for both coordinates
        self._free, self._triangles = free, mesh.triangles
        unknowns = self._by_element(unknown)
        self._system = ElementSystem(unknowns, free + b)
        i, j = PAIRS
        same = (unknowns[i] == unknowns[j]) & (i != j)[:, None]
        self._count = np.where(same, 2.0, 1.0)  # off the diagonal entries stand for two

    def places(self) -> list[Array]:
        """Return how far along its ring each vertex of the boundary belongs, ring by ring."""
        found = zip(self._lengths, self._split(self._at), strict=True)
        return [
            _taken_further(lengths[:-1], at, lengths[-1]) / lengths[-1] for lengths, at in found
        ]

    def step(self, elements: Elements, density: Density) -> tuple[float, float]:
        """Make one Newton step on the map from ``elements``; return the energy before and after."""
        terms = density_terms(elements, density, self.points)
        moved = self._by_element(self._moved())
        i, j = PAIRS
        blocks = terms.hessian * (self._count * moved[i] * moved[j])
        gradient = self._system.sum(terms.gradient * moved)
        step = self._system.solve(blocks, -gradient, self._held(terms.energy))
        inner, along = step[: self._free].reshape(-1, 2), step[self._free :]
        length, slope = self._reach(along), float(gradient @ step)
        for _ in range(HALVINGS):
            at = self._at + length * along
            points = np.concatenate([self._located(at), self.points[len(at) :] + length * inner])
            value = energy(elements, density, points)
            if value < terms.energy + ARMIJO * length * slope:
                self._at, self.points = at, points
                return terms.energy, value
            length /= 2
        return terms.energy, terms.energy

    def _moved(self) -> Array:
        """Return (n, 2) how the unknowns move the coordinates: sliders along a tangent."""
        half = np.concatenate([np.full(len(v) - 1, CHORD * v[-1] / len(v)) for v in self._lengths])
        chords = self._located(self._at + half) - self._located(self._at - half)
        moved = np.ones_like(self.points)
        moved[: len(chords)] = chords / (2 * half[:, None])
        return moved

    def _held(self, energy: float) -> Array:
        """Return (k,) what is added to the unknowns' own stiffness: short edges are held most."""
        gaps = self._split(self._gaps(self._at, closed=True))
        near = np.concatenate([np.minimum(gap, np.roll(gap, 1)) for gap in gaps])
        held = CAREFUL * energy / len(self._at) / near**2
        return np.concatenate([np.zeros(self._free), held])

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

    def _by_element(self, values: NDArray[Value]) -> NDArray[Value]:
        """Return (6, m) the values (n, 2) at the coordinates of the elements' corners."""
        return values[self._triangles].reshape(-1, 6).T


def _taken_further(start: Array, end: Array, once: float) -> Array:
    """Return arc lengths (k,) further on the way from start to end, in order around a ring.

    Where they would pass each other they stay close together, half way between the extremes that
    keep the order.
    """
    further = start + FURTHER * (end - start)
    around = np.concatenate([further - once, further, further + once])
    highest = np.maximum.accumulate(around)
    lowest = np.minimum.accumulate(around[::-1])[::-1]
    ordered = ((highest + lowest) / 2)[len(end) : 2 * len(end)]
    return ordered + APART * (end - ordered)
