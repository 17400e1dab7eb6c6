"""Rings as walks through nodes, so that places where they meet are passed more than once."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, Self

import numpy as np

from core.geometry.mending.meetings import Edges, merged
from core.geometry.origin import Origin
from core.geometry.polyline import signed_area
from core.model.outline import Array


class Step(NamedTuple):
    """One node of a walk, and where on its ring, in vertices, the walk arrives and leaves."""

    node: int
    arrive: float
    leave: float


Walk = list[Step]


@dataclass(eq=False)
class Walks:
    """The walks of all rings, exterior first, and what was cut off them."""

    points: Array
    """(n, 2) nodes; those that are given vertices come first."""
    walks: list[Walk]
    sizes: list[int]
    """Vertices of each ring as it was drawn."""
    given: int
    """How many of the nodes are given vertices."""
    backwards: list[bool]
    """Whether each walk goes against its ring."""
    spikes: list[int] = field(default_factory=list)
    """Nodes at the tips that were cut off."""
    loops: list[int] = field(default_factory=list)
    """Crossings whose loops were cut off."""
    lost: float = 0.0
    """Area of those loops."""

    @classmethod
    def of(cls, rings: Sequence[Array], origins: Sequence[Origin]) -> Self:
        """Make every place where rings meet a node."""
        edges = Edges(rings)
        touches = edges.touches()
        crossings = edges.crossings(touches)
        touches = edges.within(touches)
        crossing, *shares = edges.crossing_points(crossings)
        points = np.concatenate([edges.start, crossing])
        node = merged(points)
        number = len(edges.start) + np.arange(len(crossing))
        on = np.concatenate([touches[1], *crossings])
        at = np.concatenate([edges.along(touches), *shares])
        what = node[np.concatenate([touches[0], number, number])]
        inserted = defaultdict(list)
        for edge, u, new in sorted(zip(on.tolist(), at.tolist(), what.tolist(), strict=True)):
            inserted[edge].append((u, new))
        walks, edge = [], 0
        for ring, origin in zip(rings, origins, strict=True):
            walk = []
            for i in range(len(ring)):
                walk.append(Step(int(node[edge]), *origin.at[i].tolist()))
                walk += [Step(new, *[origin.between(i, u)] * 2) for u, new in inserted[edge]]
                edge += 1
            walks.append(walk)
        sizes = [origin.size for origin in origins]
        return cls(points, walks, sizes, len(edges.start), [False] * len(walks))

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
        for w, walk in enumerate(self.walks):
            if (self._area(walk) > 0) != (w == 0):
                self.walks[w] = _reversed(walk)
                self.backwards[w] = not self.backwards[w]

    def shared(self) -> set[int]:
        """Return the nodes that are passed more than once."""
        visits = Counter(step.node for walk in self.walks for step in walk)
        return {node for node, count in visits.items() if count > 1}

    def edges(self) -> Iterator[tuple[int, int]]:
        """Yield every edge of every walk, from node to node."""
        for walk in self.walks:
            nodes = [step.node for step in walk]
            yield from zip(nodes, [*nodes[1:], nodes[0]], strict=True)

    def directions(self, node: int, others: Sequence[int]) -> Array:
        """Return the angles (k,) at which other nodes lie as seen from one."""
        x, y = (self.points[list(others)] - self.points[node]).T
        return np.arctan2(y, x)

    def _area(self, walk: Walk) -> float:
        return signed_area(self.points[[step.node for step in walk]])

    def _loops(self, walk: Walk) -> Iterator[tuple[float, int, Walk]]:
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
        turn = self.directions(walk[i].node, [*a, *b])
        turn = (turn - turn[0]) % (2 * np.pi)
        return bool((turn[2] < turn[1]) != (turn[3] < turn[1]))


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
