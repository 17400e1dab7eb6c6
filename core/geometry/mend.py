"""Mends rings that meet themselves or each other where they should not.

Every place where the outline meets itself becomes a node of all the walks that pass through it.
Then what goes forth and back is cut off, and so are small loops; and where several passes share a
node, each takes the chord of a small circle between its two edges. Chords of passes that do not
cross do not meet, so the result is simple however many touch (Chang, Erickson and Xu, "Detecting
weakly simple polygons", SODA 2015). Passes along the same edge are told apart by whether inside or
outside lies between them.

All lengths are fractions of the outline's diagonal: the rings come at unit size.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from shapely import STRtree

from core.geometry.crossing import crosses_itself
from core.geometry.origin import Origin
from core.geometry.polyline import cross, signed_area
from core.geometry.triangulation import Indices
from core.model.outline import Array

Mask = NDArray[np.bool_]

TOUCH = 1e-9
"""Parts of an outline that are closer than this touch."""
HAIRS = 5e-4, 5e-5, 5e-6, 5e-7
"""How far drawn vertices may move where a touch is opened: the first that fits."""
SPREAD = 0.5
"""Angle (radians) between neighbouring edges where they leave the circle around a touch."""
MOST_CROSSINGS = 64
"""Crossings beyond which an outline is a scribble."""


BATCH = 64
"""Edges that are looked at together, so that a scribble is known before all of it is."""


class Step(NamedTuple):
    """One node of a walk, and where on its ring, in vertices, the walk arrives and leaves."""

    node: int
    arrive: float
    leave: float


Walk = list[Step]


@dataclass(frozen=True, eq=False)
class Mended:
    """Rings that are simple and disjoint; exterior positive, holes negative."""

    rings: tuple[Array, ...]
    """Each (n, 2)."""
    origins: tuple[Origin, ...]
    """Where each ring's vertices were on the ring as drawn."""
    vertices: tuple[Indices, ...]
    """Which of all given vertices each ring's are; -1 for new ones."""
    hair: float
    """How far vertices moved where it was opened, at most."""
    touches: Array
    """(k, 2) where it was opened."""
    spikes: Array
    """(k, 2) tips that were cut off."""
    loops: Array
    """(k, 2) crossings whose loops were cut off."""
    lost: float
    """Area of those loops."""


class BeyondRepair(Exception):  # noqa: N818 - says what is so
    """Mending would change the shape; ``flat`` is a ring of which nothing would be left."""

    def __init__(self, flat: int | None = None) -> None:
        super().__init__()
        self.flat = flat


def separate(rings: Sequence[Array]) -> bool:
    """Whether no two parts of rings (n, 2) at unit size touch, unless as neighbours."""
    return len(_Edges(rings).touches()[0]) == 0


def mend(rings: Sequence[Array], origins: Sequence[Origin], most_lost: float) -> Mended:
    """Mend rings (n, 2) at unit size, exterior first.

    Neighbouring vertices are distinct; ``origins`` tells where they were drawn. Loops are cut off
    up to the area ``most_lost``. Raises ``BeyondRepair`` where that does not do.
    """
    walks = _Walks.of(rings, origins)
    walks.cut_spikes()
    walks.cut_loops(most_lost)
    walks.cut_spikes()
    for index, walk in enumerate(walks.walks):
        if len(walk) < 3:
            raise BeyondRepair(index)
    if walks.lost > most_lost:
        raise BeyondRepair
    walks.orient()
    for hair in HAIRS:
        found = walks.opened(hair)
        if not crosses_itself(found.rings) and separate(found.rings):
            return Mended(
                *found,
                hair,
                walks.points[sorted(walks.shared())],
                walks.points[walks.spikes],
                walks.points[walks.loops],
                walks.lost,
            )
    raise BeyondRepair


class _Opened(NamedTuple):
    rings: tuple[Array, ...]
    origins: tuple[Origin, ...]
    vertices: tuple[Indices, ...]


class _Edges:
    """The edges of all rings, numbered by the vertex they start from."""

    def __init__(self, rings: Sequence[Array]) -> None:
        self.start = np.concatenate(rings)
        first = np.cumsum([0, *map(len, rings)])
        number = np.arange(first[-1])
        each = np.split(number, first[1:-1])
        self.after = np.concatenate([np.roll(ring, -1) for ring in each])
        self.before = np.concatenate([np.roll(ring, 1) for ring in each])
        self.segments = shapely.linestrings(np.stack([self.start, self.end], axis=1))
        self.tree = STRtree(self.segments)

    @property
    def end(self) -> Array:
        return self.start[self.after]

    def touches(self) -> tuple[Indices, Indices]:
        """Return vertices (k,) and the edges (k,) of others that they touch."""
        points = shapely.points(self.start)
        vertex, edge = self.tree.query(points, predicate="dwithin", distance=TOUCH)
        apart = (edge != vertex) & (self.after[edge] != vertex)
        return vertex[apart], edge[apart]

    def crossings(self) -> tuple[Indices, Indices]:
        """Return pairs of edges that cross, each once; a scribble is beyond repair."""
        found: list[Indices] = []
        for part in np.array_split(np.arange(len(self.start)), 1 + len(self.start) // BATCH):
            first, second = self.tree.query(self.segments[part], predicate="crosses")
            found.append(np.stack([part[first], second]))
            if sum(pairs.shape[1] for pairs in found) > 2 * MOST_CROSSINGS:
                raise BeyondRepair
        first, second = np.concatenate(found, axis=1)
        return first[first < second], second[first < second]

    def touching(self, touches: tuple[Indices, Indices], pairs: tuple[Indices, Indices]) -> Mask:
        """Return (k,) which pairs of edges touch with an end of either."""
        vertex, edge = touches
        count = len(self.start)
        near = [_pair(edge, v, count) for v in (vertex, self.before[vertex])]
        return np.isin(_pair(*pairs, count), np.concatenate(near))


def _pair(a: Indices, b: Indices, count: int) -> Indices:
    return np.minimum(a, b) * count + np.maximum(a, b)


@dataclass(eq=False)
class _Walks:
    points: Array
    """(n, 2) nodes."""
    walks: list[Walk]
    sizes: list[int]
    """Vertices of each ring as it was drawn."""
    given: int
    """How many of the nodes are given vertices: they come first."""
    spikes: list[int] = field(default_factory=list)
    loops: list[int] = field(default_factory=list)
    lost: float = 0.0
    backwards: list[bool] = field(default_factory=list)

    @classmethod
    def of(cls, rings: Sequence[Array], origins: Sequence[Origin]) -> _Walks:
        """Make every place where rings meet a node."""
        edges = _Edges(rings)
        crossings = edges.crossings()
        vertex, edge = touches = edges.touches()
        first, second = (end[~edges.touching(touches, crossings)] for end in crossings)
        near = [np.hypot(*(edges.start[vertex] - p[edge]).T) <= TOUCH for p in _ends(edges)]
        node = _merged(
            len(edges.start),
            np.concatenate([vertex[near[0]], vertex[near[1]]]),
            np.concatenate([edge[near[0]], edges.after[edge[near[1]]]]),
        )
        inner = ~(near[0] | near[1])
        vertex, edge = vertex[inner], edge[inner]
        crossing, along = _crossing_points(edges, first, second)
        number = len(edges.start) + np.arange(len(first))
        on = np.concatenate([edge, first, second])
        what = np.concatenate([node[vertex], number, number])
        where = np.concatenate([_along(edges, vertex, edge), *along])
        inserted = defaultdict(list)
        for e, u, n in sorted(zip(on.tolist(), where.tolist(), what.tolist(), strict=True)):
            inserted[e].append((u, n))
        walks, k = [], 0
        for ring, origin in zip(rings, origins, strict=True):
            walk = []
            for i in range(len(ring)):
                walk.append(Step(int(node[k]), *origin.at[i].tolist()))
                for u, n in inserted[k]:
                    walk.append(Step(n, *[origin.between(i, u)] * 2))
                k += 1
            walks.append(walk)
        points = np.concatenate([edges.start, crossing])
        return cls(points, walks, [origin.size for origin in origins], len(edges.start))

    def cut_spikes(self) -> None:
        """Cut off what goes forth and back along the same nodes."""
        self.walks = [_without_spikes(walk, self.spikes) for walk in self.walks]

    def cut_loops(self, most_lost: float) -> None:
        """Cut off the smaller loop at every crossing of a ring with itself, the smallest first."""
        for w in range(len(self.walks)):
            while self.lost <= most_lost and (loops := list(self._loops(self.walks[w]))):
                area, node, self.walks[w] = min(loops, key=lambda loop: loop[0])
                self.lost += area
                self.loops.append(node)

    def orient(self) -> None:
        """Turn the exterior to positive area, and holes to negative."""
        areas = [self._area(walk) for walk in self.walks]
        self.backwards = [(area > 0) != (w == 0) for w, area in enumerate(areas)]
        self.walks = [
            _reversed(walk) if back else walk
            for walk, back in zip(self.walks, self.backwards, strict=True)
        ]

    def shared(self) -> set[int]:
        """Return the nodes that are passed more than once."""
        visits = Counter(step.node for walk in self.walks for step in walk)
        return {node for node, count in visits.items() if count > 1}

    def opened(self, hair: float) -> _Opened:
        """Return the rings with every shared node opened."""
        angles = self._angles(self._shifts)
        rings, origins, vertices = [], [], []
        for w, walk in enumerate(self.walks):
            size, sign = self.sizes[w], -1 if self.backwards[w] else 1
            points: list[Array] = []
            at: list[tuple[float, float]] = []
            vertex: list[int] = []
            for i, (node, arrive, leave) in enumerate(walk):
                here = self.points[node]
                if (w, i, 1) not in angles:
                    points.append(here)
                    at.append((arrive, leave))
                    vertex.append(node if node < self.given else -1)
                    continue
                before, after = walk[i - 1], walk[(i + 1) % len(walk)]
                radius = min(hair, 0.3 * self._shortest[node])
                for way, other, own, end in (
                    (-1, before, arrive, before.leave),
                    (1, after, leave, after.arrive),
                ):
                    angle = angles[w, i, way]
                    points.append(here + radius * np.array([np.cos(angle), np.sin(angle)]))
                    share = radius / np.hypot(*(self.points[other.node] - here))
                    gap = way * sign * (end - own) % size
                    place = (own + way * sign * share * gap) % size
                    at.append((place, place))
                    vertex.append(-1)
            rings.append(np.array(points))
            origins.append(Origin(np.array(at), size, self.backwards[w]))
            vertices.append(np.array(vertex))
        return _Opened(tuple(rings), tuple(origins), tuple(vertices))

    # -- details -------------------------------------------------------------------------------

    def _area(self, walk: Walk) -> float:
        return signed_area(self.points[[step.node for step in walk]])

    def _loops(self, walk: Walk) -> Iterable[tuple[float, int, Walk]]:
        """Yield each loop's area, the crossing it hangs on, and the walk without it."""
        visits = defaultdict(list)
        for i, step in enumerate(walk):
            visits[step.node].append(i)
        for node, at in visits.items():
            for i, j in ((i, j) for k, i in enumerate(at) for j in at[k + 1 :]):
                if not self._crosses(walk, i, j):
                    continue
                inner = [Step(node, walk[j].arrive, walk[i].leave), *walk[i + 1 : j]]
                joint = Step(node, walk[i].arrive, walk[j].leave)
                outer = [*walk[:i], joint, *walk[j + 1 :]]
                small, large = sorted((inner, outer), key=lambda part: abs(self._area(part)))
                yield abs(self._area(small)), node, large

    def _crosses(self, walk: Walk, i: int, j: int) -> bool:
        """Whether two passes through the same node cross there, on four edges of their own."""
        a, b = ([walk[k - 1].node, walk[(k + 1) % len(walk)].node] for k in (i, j))
        if len({*a, *b}) < 4:
            return False
        turn = self._directions(walk[i].node, [*a, *b])
        turn = (turn - turn[0]) % (2 * np.pi)
        return bool((turn[2] < turn[1]) != (turn[3] < turn[1]))

    def _directions(self, node: int, others: Sequence[int]) -> Array:
        x, y = (self.points[list(others)] - self.points[node]).T
        return np.arctan2(y, x)

    @cached_property
    def _shortest(self) -> dict[int, float]:
        """The length of the shortest edge at each node."""
        shortest: dict[int, float] = defaultdict(lambda: np.inf)
        for a, b in (edge for walk in self.walks for edge in _edges_of(walk)):
            length = float(np.hypot(*(self.points[a] - self.points[b])))
            shortest[a], shortest[b] = min(shortest[a], length), min(shortest[b], length)
        return shortest

    @cached_property
    def _shifts(self) -> dict[tuple[int, int], int]:
        """Return, for edges (node, node) passed in both directions, which side passes keep to.

        1 to their left, away from the outside between them, as at a slit; -1 to their right, away
        from the inside between them, as at a bridge without width. Where more than two passes share
        an edge, or two in the same direction, their order is not known.
        """
        passes = Counter(edge for walk in self.walks for edge in _edges_of(walk))
        if max(passes.values()) > 1:
            raise BeyondRepair
        tails, heads = (self.points[list(end)] for end in zip(*passes, strict=True))
        shifts = {}
        for a, b in passes:
            if (b, a) in passes:
                middle = (self.points[a] + self.points[b]) / 2  # the two passes cancel
                inside = round(_winding(middle, tails, heads)) != 0
                shifts[a, b] = 1 if inside else -1
        return shifts

    def _angles(self, shifts: dict[tuple[int, int], int]) -> dict[tuple[int, int, int], float]:
        """Return at what angle (walk, step, -1 arriving or 1 leaving) meets its node's circle."""
        ends = defaultdict(list)
        shared = self.shared()
        for w, walk in enumerate(self.walks):
            for i, step in enumerate(walk):
                if step.node not in shared:
                    continue
                before, after = walk[i - 1].node, walk[(i + 1) % len(walk)].node
                arriving, leaving = self._directions(step.node, [before, after])
                shift = shifts.get((before, step.node), 0)
                ends[step.node].append((float(arriving), -shift, (w, i, -1)))
                shift = shifts.get((step.node, after), 0)
                ends[step.node].append((float(leaving), shift, (w, i, 1)))
        angles: dict[tuple[int, int, int], float] = {}
        for meeting in ends.values():
            meeting.sort()
            spread = _spread(np.array([angle for angle, _, _ in meeting]))
            angles |= {key: float(a) for (_, _, key), a in zip(meeting, spread, strict=True)}
        return angles


def _ends(edges: _Edges) -> tuple[Array, Array]:
    return edges.start, edges.end


def _merged(count: int, a: Indices, b: Indices) -> Indices:
    """Return (count,) the first of all vertices that pairs (a, b) make one."""
    graph = coo_array((np.ones(len(a)), (a, b)), shape=(count, count))
    _, label = connected_components(graph, directed=False)
    _, first = np.unique(label, return_index=True)
    return first[label]


def _along(edges: _Edges, vertex: Indices, edge: Indices) -> Array:
    """Return (k,) which fraction of its edge each vertex lies at."""
    away, whole = edges.start[vertex] - edges.start[edge], edges.end[edge] - edges.start[edge]
    return np.einsum("ij,ij->i", away, whole) / np.einsum("ij,ij->i", whole, whole)


def _crossing_points(
    edges: _Edges, first: Indices, second: Indices
) -> tuple[Array, tuple[Array, Array]]:
    """Return (k, 2) where pairs of edges cross, and at which fractions (k,) of each."""
    p, q = edges.start[first], edges.start[second]
    d, e = edges.end[first] - p, edges.end[second] - q
    u, v = cross(q - p, e) / cross(d, e), cross(q - p, d) / cross(d, e)
    return p + u[:, None] * d, (u, v)


def _without_spikes(walk: Walk, tips: list[int]) -> Walk:
    """Take out steps to a node and back; their tips are added to ``tips``."""
    kept: Walk = []
    for step in walk:
        if len(kept) > 1 and kept[-2].node == step.node:
            tips.append(kept.pop().node)
        if kept and kept[-1].node == step.node:
            kept[-1] = Step(step.node, kept[-1].arrive, step.leave)
        else:
            kept.append(step)
    while len(kept) > 2:  # around the start
        if kept[-1].node == kept[0].node:
            kept[0] = Step(kept[0].node, kept.pop().arrive, kept[0].leave)
        elif kept[-2].node == kept[0].node:
            tips.append(kept.pop().node)
        elif kept[-1].node == kept[1].node:
            tips.append(kept.pop(0).node)
        else:
            break
    return kept


def _reversed(walk: Walk) -> Walk:
    return [Step(node, leave, arrive) for node, arrive, leave in (walk[0], *walk[:0:-1])]


def _edges_of(walk: Walk) -> Iterable[tuple[int, int]]:
    nodes = [step.node for step in walk]
    return zip(nodes, [*nodes[1:], nodes[0]], strict=True)


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
