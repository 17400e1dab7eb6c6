"""Walks opened by a hair wherever they share a node.

Each pass through a shared node takes the chord of a small circle between its two edges. Chords of
passes that do not cross do not meet, so the result is simple however many touch (Chang, Erickson
and Xu, "Detecting weakly simple polygons", SODA 2015). Passes along the same edge are told apart by
whether inside or outside lies between them.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from typing import NamedTuple

import numpy as np

from core.geometry.mending import BeyondRepair
from core.geometry.mending.meetings import TOUCH
from core.geometry.mending.walks import Walks
from core.geometry.origin import Origin
from core.geometry.polyline import cross
from core.geometry.triangulation import Indices
from core.model.outline import Array

SPREAD = 0.5
"""Angle (radians) between neighbouring edges where they leave the circle around a touch."""
WIDEST = 0.3
"""Radius of that circle at most, as a fraction of the shortest edge there."""

End = tuple[int, int, int]
"""Walk, step in it, and which edge of that: -1 for the one that arrives, 1 that leaves."""


class Opened(NamedTuple):
    """Rings that share no node any more."""

    rings: tuple[Array, ...]
    """Each (n, 2)."""
    origins: tuple[Origin, ...]
    """Where each ring's vertices were on the ring as drawn."""
    vertices: tuple[Indices, ...]
    """Which of all given vertices each ring's are; -1 for new ones."""


class Opening:
    """How walks, the exterior positive and holes negative, are opened at the nodes they share."""

    def __init__(self, walks: Walks) -> None:
        """BeyondRepair where the order of passes along the same edge is not known."""
        self._walks = walks
        self._angles = _angles(walks, _shifts(walks))
        self._shortest = _shortest(walks)

    def by(self, hair: float) -> Opened:
        """Return the rings, none of whose vertices is moved farther than a hair."""
        rings, origins, vertices = [], [], []
        for w in range(len(self._walks.walks)):
            points, at, vertex = zip(*self._passed(w, hair), strict=True)
            size, backwards = self._walks.sizes[w], self._walks.backwards[w]
            rings.append(np.array(points))
            origins.append(Origin(np.array(at), size, backwards))
            vertices.append(np.array(vertex))
        return Opened(tuple(rings), tuple(origins), tuple(vertices))

    def _passed(self, w: int, hair: float) -> list[tuple[Array, tuple[float, float], int]]:
        """Return the vertices of a ring: point, place on the ring as drawn, and number."""
        nodes, walk = self._walks.points, self._walks.walks[w]
        passed = []
        for i, step in enumerate(walk):
            here = nodes[step.node]
            if (w, i, 1) not in self._angles:
                number = step.node if step.node < self._walks.given else -1
                passed.append((here, (step.arrive, step.leave), number))
                continue
            before, after = walk[i - 1], walk[(i + 1) % len(walk)]
            radius = min(hair, WIDEST * self._shortest[step.node])
            for way, other, start, end in (
                (-1, before, step.arrive, before.leave),
                (1, after, step.leave, after.arrive),
            ):
                angle = self._angles[w, i, way]
                point = here + radius * np.array([np.cos(angle), np.sin(angle)])
                share = radius / float(np.hypot(*(nodes[other.node] - here)))
                place = self._between(w, way, start, end, share)
                passed.append((point, (place, place), -1))
        return passed

    def _between(self, w: int, way: int, start: float, end: float, share: float) -> float:
        """Return the place at a share of the way from one on a ring to another."""
        size, sign = self._walks.sizes[w], -way if self._walks.backwards[w] else way
        return (start + sign * share * (sign * (end - start) % size)) % size


def _shortest(walks: Walks) -> dict[int, float]:
    """Return the length of the shortest edge at each node."""
    shortest: dict[int, float] = defaultdict(lambda: np.inf)
    for a, b in walks.edges():
        length = float(np.hypot(*(walks.points[a] - walks.points[b])))
        shortest[a], shortest[b] = min(shortest[a], length), min(shortest[b], length)
    return shortest


def _shifts(walks: Walks) -> dict[tuple[int, int], int]:
    """Return, for edges (node, node) passed in both directions, which side passes keep to.

    1 to their left, away from the outside between them, as at a slit; -1 to their right, away from
    the inside between them, as at a bridge without width. Where more than two passes share an edge,
    or two in the same direction, their order is not known.
    """
    passes = Counter(walks.edges())
    if max(passes.values()) > 1:
        raise BeyondRepair
    tails, heads = (walks.points[list(end)] for end in zip(*passes, strict=True))
    shifts = {}
    for a, b in passes:
        if (b, a) in passes:
            middle = (walks.points[a] + walks.points[b]) / 2  # the two passes cancel
            inside = round(_winding(middle, tails, heads)) != 0
            shifts[a, b] = 1 if inside else -1
    return shifts


def _angles(walks: Walks, shifts: dict[tuple[int, int], int]) -> dict[End, float]:
    """Return at what angle each edge at a shared node meets the circle around it."""
    meetings: dict[int, list[tuple[float, int, End]]] = defaultdict(list)
    shared = walks.shared()
    for w, walk in enumerate(walks.walks):
        for i, step in enumerate(walk):
            if step.node not in shared:
                continue
            before, after = walk[i - 1].node, walk[(i + 1) % len(walk)].node
            arriving, leaving = walks.directions(step.node, [before, after]).tolist()
            meetings[step.node] += [
                (arriving, -shifts.get((before, step.node), 0), (w, i, -1)),
                (leaving, shifts.get((step.node, after), 0), (w, i, 1)),
            ]
    angles: dict[End, float] = {}
    for meeting in meetings.values():
        meeting.sort()
        spread = _spread(np.array([angle for angle, _, _ in meeting]))
        angles |= {end: float(a) for (_, _, end), a in zip(meeting, spread, strict=True)}
    return angles


def _winding(point: Array, tails: Array, heads: Array) -> float:
    """Return how often edges (n, 2) to (n, 2) wind around a point; those through it count zero."""
    a, b = tails - point, heads - point
    sine, cosine = cross(a, b), np.einsum("ij,ij->i", a, b)
    through = (cosine < 0) & (np.abs(sine) <= TOUCH * np.hypot(*(heads - tails).T))
    return float(np.sum(np.where(through, 0, np.arctan2(sine, cosine))) / (2 * np.pi))


def _spread(angles: Array) -> Array:
    """Move sorted angles (k,) apart, by as little as that takes, in the same cyclic order."""
    count = len(angles)
    least = min(SPREAD, np.pi / count)
    gap = np.diff(np.append(angles, angles[0] + 2 * np.pi))
    start = (int(np.argmax(gap)) + 1) % count
    steps = least * np.arange(count)
    run = np.unwrap(np.roll(angles, -start)) - steps
    forth = np.maximum.accumulate(run)
    back = np.minimum.accumulate(run[::-1])[::-1]
    return np.roll((forth + back) / 2 + steps, start)
