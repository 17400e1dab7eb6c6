"""A boundary that nears itself: distances of its vertices from its edges are gaps, too."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from core.geometry.crossing import crosses_itself
from core.geometry.flatness import times_of_flatness
from core.geometry.rotation import Complex, to_points, unit
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.motion.barrier import LEFT_ALONE, Derivatives
from core.morph.motion.runs import Pairs, Runs, Test

REACH = 0.01
"""Largest distance at which contact is felt, at unit area."""
STIFFNESS = 0.1
SHARP, FLAT = 0.2, 0.2
"""Turn of the boundary at a vertex that counts in full, in radians, and what a straight one counts:
boundaries meet corner first, and then slide along without catching on the vertices between."""
SHORT_OF_TOUCH = 0.9
"""Fraction of the way to the first meeting that a step may go."""
BOWED = 1.2
"""How much longer the way of a vertex may be than straight, between moments that are looked at."""
TINY = 1e-100


class Contact:
    """Pairs of a boundary vertex and a boundary edge, kept apart.

    A pair's reach is but a part of its smallest distance in frames to be left alone, such as both
    ends, so that they feel none. A pair's number is the vertex's place on the boundary times
    the boundary's length, plus the edge's place.
    """

    def __init__(self, rings: Sequence[Indices], rest: Complex, target: Complex) -> None:
        """Prepare for rings of vertex indices and positions (n,) at both ends."""
        self._left: tuple[Complex, ...] = rest, target
        self._rings = sorted(rings, key=lambda ring: -np.ptp(rest[ring].real))  # exterior first
        self._starts = np.concatenate(self._rings)
        sizes = [len(ring) for ring in self._rings]
        places = np.split(np.arange(sum(sizes)), np.cumsum(sizes)[:-1])
        self._next = np.concatenate([np.roll(place, -1) for place in places])
        self._stops = self._starts[self._next]
        self._runs = Runs(self._starts, self._stops)
        self._left_discs = tuple(map(self._runs.discs, self._left))
        self._weights = STIFFNESS / 2 * (self._sharpness(rest) + self._sharpness(target))

    def leaving(self, *frames: Complex) -> Self:
        """Return the contact that is not felt in some frames (n,) either."""
        other = copy(self)
        other._left = *self._left, *frames
        other._left_discs = *self._left_discs, *map(self._runs.discs, frames)
        return other

    def crosses(self, z: Complex) -> bool:
        """Whether the boundary crosses itself at positions z (n,)."""
        return crosses_itself([to_points(z[ring]) for ring in self._rings])

    def corners(self, pairs: Indices) -> Indices:
        """Return (c, 3): each pair's vertex and both ends of its edge."""
        vertex, edge = np.divmod(pairs, len(self._starts))
        return np.column_stack([self._starts[vertex], self._starts[edge], self._stops[edge]])

    def near(self, z: Complex, within: float, among: Indices | None = None) -> Indices:
        """Return the pairs with a gap below ``within`` at positions z (n,), in order."""
        pairs = self._close(z, within) if among is None else among
        corners = self.corners(pairs)
        distance = _distances(z[corners.T])
        close = distance < within * REACH
        return pairs[close][distance[close] < within * self._reach(corners[close])]

    def meeting(self, here: Complex, there: Complex) -> Indices:
        """Return the pairs that may be felt on the way between two frames (n,), in order."""
        return self.meetings([here, there])[0]

    def meetings(self, frames: Sequence[Complex]) -> list[Indices]:
        """Return the pairs that may be felt on the way from each frame (n,) to the next, in order.

        Seen from its edge, a vertex is taken to move about straight.
        """
        found = [self._closing(here, there) for here, there in pairwise(frames)]
        sizes, pairs = [len(each) for each in found], np.concatenate(found)
        way = np.repeat(np.arange(len(found)), sizes)
        here, there = self._seen_from_edges(np.array(frames), (way, way + 1), pairs)
        closing = np.abs(there - here).max(axis=0)
        least = _off_edges(here) + _off_edges(there) - BOWED * closing
        felt = np.flatnonzero(least < 2 * REACH)
        felt = felt[least[felt] < 2 * self._reach(self.corners(pairs[felt]))]
        return np.split(pairs[felt], np.searchsorted(felt, np.cumsum(sizes)[:-1]))

    def _seen_from_edges(
        self, frames: Complex, moments: Sequence[Indices], pairs: Indices
    ) -> list[Complex]:
        """Return (2, c) how vertices lie from both ends of their edges, seen along the edge.

        That is in frames (k, n) at moments (c,), for some of these in turn.
        """
        places = frames[:, self._starts]
        back = np.conj(unit(places[:, self._next] - places)).ravel()
        vertex, edge = np.divmod(pairs, len(self._starts))
        corners = np.stack([vertex, edge, self._next[edge]])
        seen = []
        for first in (moment * len(self._starts) for moment in moments):
            point, *ends = places.ravel()[first + corners]
            seen.append((point - ends) * back[first + edge])
        return seen

    def _close(self, z: Complex, within: float) -> Indices:
        """Return at least the pairs with a gap below ``within``."""

        def test(level: int, runs: Pairs) -> NDArray[np.bool_]:
            return discs[level].least(runs) < within * self._most_reach(level, runs)

        discs = self._runs.discs(z)
        return self._find(z, within * REACH, test)

    def _closing(self, here: Complex, there: Complex) -> Indices:
        """Return at least the pairs that may be felt on the way."""

        def test(level: int, runs: Pairs) -> NDArray[np.bool_]:
            least = ways[level].least(runs) - BOWED * ways[level].closing(runs)
            return least < 2 * self._most_reach(level, runs)

        way = aligned(there, here) - here
        radius = REACH + BOWED * np.abs(way[self._starts]).max()
        ways = self._runs.ways(here, there)
        return self._find(here + way / 2, radius, test)

    def gaps(self, pairs: Indices, vertices: Indices) -> Distances:
        """Return pairs as gaps between the vertices held, which come in order.

        A place close to a vertex is close to both its edges: it is counted out once, so that a
        vertex weighs what any place on an edge does.
        """
        edges, size = self.corners(pairs), len(self._next)
        reach = self._reach(edges)
        following = pairs - pairs % size + self._next[pairs % size]
        place = np.searchsorted(pairs, following) % max(len(pairs), 1)
        twice = np.flatnonzero(pairs[place] == following)
        corners = np.concatenate([edges, edges[twice][:, [0, 2, 2]]])
        reach = np.concatenate([reach, np.minimum(reach[twice], reach[place[twice]])])
        sign = np.repeat([1, -1], [len(edges), len(twice)])
        weights = sign * self._weights[corners[:, 0]] * reach
        return Distances(np.searchsorted(vertices, corners), weights, reach)

    def _sharpness(self, end: Complex) -> Array:
        """Return (n,) boundary length around each vertex, less where the boundary is not convex."""
        edges = end[self._stops] - end[self._starts]
        after = edges[self._next]
        length = (np.abs(edges) + np.abs(after)) / 2
        sharpness = np.zeros(len(end))
        sharpness[self._stops] = length * np.clip(np.angle(after / edges) / SHARP, FLAT, 1)
        return sharpness

    def _find(self, z: Complex, distance: float, test: Test) -> Indices:
        """Return neighbours that pass a test of runs, in order, none of them on one edge."""
        vertex, edge = self._runs.find(z, distance, test)
        apart = (vertex != edge) & (vertex != self._next[edge])
        return np.sort(vertex[apart] * len(self._starts) + edge[apart])

    def _reach(self, corners: Indices) -> Array:
        least = np.min([_distances(frame[corners.T]) for frame in self._left], axis=0)
        return np.minimum(REACH, LEFT_ALONE * least)

    def _most_reach(self, level: int, runs: Pairs) -> Array:
        """Return what the reach of no pair in runs exceeds."""
        least = np.min([discs[level].most(runs) for discs in self._left_discs], axis=0)
        return np.minimum(REACH, LEFT_ALONE * least)


class NoContact(Contact):
    """A boundary that may cross itself."""

    def __init__(self) -> None:
        """There is nothing to prepare."""

    def leaving(self, *frames: Complex) -> Self:
        """Return the same."""
        return self

    def crosses(self, z: Complex) -> bool:
        """Say that it need not be known."""
        return False

    def corners(self, pairs: Indices) -> Indices:
        """Return those of no pair."""
        return np.empty((0, 3), dtype=int)

    def near(self, z: Complex, within: float, among: Indices | None = None) -> Indices:
        """Return no pair."""
        return np.empty(0, dtype=int)

    def meetings(self, frames: Sequence[Complex]) -> list[Indices]:
        """Return no pair on any way."""
        return [np.empty(0, dtype=int) for _ in frames[1:]]

    def gaps(self, pairs: Indices, vertices: Indices) -> Distances:
        """Return no gap."""
        return Distances(self.corners(pairs), np.empty(0), np.empty(0))


@dataclass(frozen=True, eq=False)
class Distances:
    """Distances of points from edges, in units of those at which they are felt."""

    bent: ClassVar = False
    corners: Indices
    weights: Array
    reach: Array
    """(c,)"""

    def __call__(self, z: Complex) -> Array:
        """Return the gaps (c,) at positions z (k,)."""
        return _distances(z[self.corners.T]) / self.reach

    def derivatives(self, z: Complex, which: Indices) -> Derivatives:
        """Return some of the gaps with their derivatives.

        Beside an edge the distance is that from a line which turns as its ends move; beyond its
        ends it is that of two points.
        """
        edge, share, away = _closest(*z[self.corners[which].T])
        distance, length = np.abs(away), np.maximum(np.abs(edge), TINY)
        normal, shares = away / distance, np.stack([np.ones_like(share), share - 1, -share], axis=1)
        slopes = (normal[:, None] * shares).view(float)
        across = ((1j * normal)[:, None] * shares).view(float)
        along = ((edge / length)[:, None] * shares).view(float)
        turning = ((normal / length)[:, None] * np.array([0, -1, 1])).view(float)
        mixed = _outer(turning, along)
        line = -mixed - mixed.transpose(0, 2, 1)
        line -= distance[:, None, None] * _outer(turning, turning)
        point = _outer(across, across) / distance[:, None, None]
        beside, reach = (share > 0) & (share < 1), self.reach[which]
        bends = np.where(beside[:, None, None], line, point) / reach[:, None, None]
        return Derivatives(distance / reach, slopes / reach[:, None], bends)

    def free_way(self, z: Complex, step: Complex) -> float:
        """Return a part of a step that stops short of the first point to meet its edge."""
        here, way = z[self.corners.T], step[self.corners.T]
        times = times_of_flatness(here, way)
        _, pair = hits = np.nonzero((times > 0) & (times * SHORT_OF_TOUCH < 1))
        meets = here[:, pair] + times[hits] * way[:, pair]
        on_edge = _distances(meets) <= 1e-9 * np.abs(meets[2] - meets[1])
        return SHORT_OF_TOUCH * float(times[hits][on_edge].min(initial=np.inf))


def _closest(point: Complex, start: Complex, stop: Complex) -> tuple[Complex, Array, Complex]:
    """Return the edge, the share of it at its place closest to the point, and the way from there.

    An edge may have no length.
    """
    edge, offset = stop - start, point - start
    along = edge.real * offset.real + edge.imag * offset.imag
    share = np.clip(along / np.maximum(edge.real**2 + edge.imag**2, TINY), 0, 1)
    return edge, share, offset - share * edge


def _off_edges(seen: Complex) -> Array:
    """Return the distances (c,) of points seen so from their edges."""
    from_start, from_stop = seen
    beyond = np.maximum(from_stop.real, -from_start.real).clip(0)
    return np.hypot(beyond, from_start.imag)


def _distances(corners: Complex) -> Array:
    """Return the distances (c,) of points from edges, given as (3, c)."""
    return np.abs(_closest(*corners)[2])


def _outer(a: Array, b: Array) -> Array:
    return a[:, :, None] * b[:, None]


def aligned(z: Complex, model: Complex) -> Complex:
    """Return positions (n,) turned and moved closest to a model."""
    product = np.vdot(z - z.mean(), model - model.mean())
    return model.mean() + product / abs(product) * (z - z.mean())
