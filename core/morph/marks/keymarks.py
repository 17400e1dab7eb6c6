"""Boil a correspondence down to few key marks, at corners wherever both shapes have one.

Between neighbouring marks the rest follows by arc length (Song 2013, fig. 5), so marks are set, the
most needed first, until that comes close to the whole correspondence.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from core.geometry.triangulation import Indices
from core.morph.marks.chain import Chain, Pair
from core.morph.marks.contour import Contour, gap
from core.morph.marks.matching import Match

NEAR = 0.02
"""How far from where it is expected a corner's partner may lie."""
SIMILAR = np.radians(70)
"""How differently partners may turn."""
CLOSE, CLOSER = 0.008, 0.003
"""How near the marks have to bring every place to where it belongs; and how near a corner."""
APART, ASIDE = 0.006, 0.009
"""Corners with partners are further apart than this, other places further from them."""
MOST = 24
"""Marks that are suggested at most."""


@dataclass(frozen=True, eq=False)
class Route:
    """A match that leads exactly through fixed pairs, and through corners that belong together."""

    match: Match
    fixed: NDArray[np.bool_]
    """(k,) whether each of its knots was given, and …"""
    corner: NDArray[np.bool_]
    """(k,) … whether it is a pair of corners. The last knot, which is the first, is neither."""

    @classmethod
    def of(
        cls, source: Contour, target: Contour, match: Match, fixed: Sequence[Pair] = ()
    ) -> Route:
        """Correct a match; ``fixed`` pairs are in the same cyclic order on both contours."""
        corners, knots = _corner_pairs(source, target, match), _knots(match)
        begin = (*fixed, *corners, *knots)[0]
        chain = Chain(begin)
        chain.add(fixed)
        chain.add(corners, APART)
        chain.add(knots, ASIDE)
        at, image = np.add(begin, chain.steps).T
        kinds = (
            np.array([*(pair in kind for pair in chain.pairs), False]) for kind in (fixed, corners)
        )
        return cls(replace(match, source=at, target=image), *kinds)

    def reversed(self) -> Route:
        """Return the same route, seen from the target."""
        return replace(self, match=self.match.reversed())

    def key_knots(self) -> Indices:
        """Return which knots suffice as marks, besides the fixed ones, in order."""
        s, t = self.match.source, self.match.target
        known = np.flatnonzero(self.fixed).tolist()
        sure = self.match.sureness(s[:-1]) + self.corner[:-1]
        chosen = [] if known else [int(np.argmax(sure))]
        tolerance = np.where(self.corner, CLOSER, CLOSE)
        while len(chosen) < MOST:
            kept = np.sort([*known, *chosen])
            ends, turn = np.array([kept[-1], *kept, kept[0]]), np.array([-1, *(0 * kept), 1])
            along = np.interp(s, s[ends] + turn, t[ends] + turn) - t
            back = np.interp(t, t[ends] + turn, s[ends] + turn) - s
            needed = np.sqrt(np.abs(along * back)) / tolerance
            if needed.max() <= 1:
                break
            chosen.append(int(np.argmax(needed[:-1])))
        return np.sort(np.array(chosen, dtype=np.int64))


def _knots(match: Match) -> list[Pair]:
    pairs = np.mod(np.column_stack([match.source, match.target])[:-1], 1.0)
    return [(float(s), float(t)) for s, t in pairs]


def _corner_pairs(source: Contour, target: Contour, match: Match) -> list[Pair]:
    """Return corners that are each other's nearest likeness along the match, the closest first."""
    (s, s_turns), (t, t_turns) = source.corners, target.corners
    if not len(s) or not len(t):
        return []
    along, back = gap(t, match.image(s)[:, None]), gap(s[:, None], match.origin(t))
    away = np.sqrt(np.abs(along * back))
    unlike = np.abs(s_turns[:, None] - t_turns)
    possible = (away < NEAR) & (unlike < SIMILAR) & (s_turns[:, None] * t_turns > 0)
    cost = np.where(possible, away / NEAR + unlike / SIMILAR, np.inf)
    j = cost.argmin(axis=1)
    i = np.flatnonzero((cost.argmin(axis=0)[j] == np.arange(len(s))) & possible.any(axis=1))
    i = i[np.argsort(cost[i, j[i]], kind="stable")]
    return [(float(s[k]), float(t[j[k]])) for k in i]
