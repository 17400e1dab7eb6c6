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
from core.model.outline import Array
from core.morph.marks.chain import Chain, Pair
from core.morph.marks.contour import WIDE, Contour, gap
from core.morph.marks.matching import Match

NEAR, NEARER = 0.02, 0.3
"""How far from where it is expected a corner's partner may lie; and how far in widths of the limb
that it is on: what slides further along one side shears it."""
SIMILAR = np.radians(70)
"""How differently partners may turn."""
CLOSE, CLOSER, CLOSEST = 0.008, 0.003, 0.001
"""How near the marks have to bring every place to where it belongs, how near a corner, and what is
always near enough."""
SLIM = 0.2
"""How near in widths of the limb, where that is less."""
APART, ASIDE = 0.006, 0.009
"""Corners with partners are further apart than this, other places further from them."""
ENOUGH = 0.02
"""Fixed marks that bring every place so near need no others."""
MOST = 24
"""So many marks need no others, either."""
SAME = 1e-9
"""Places this near to each other are one."""


@dataclass(frozen=True, eq=False)
class Route:
    """A match that leads exactly through fixed pairs, and through corners that belong together."""

    match: Match
    fixed: NDArray[np.bool_]
    """(k,) whether each of its knots was given, and …"""
    corner: NDArray[np.bool_]
    """(k,) … whether it is a pair of corners. The last knot, which is the first, is neither."""
    key: NDArray[np.bool_]
    """(k,) Whether it is to be a mark in any case."""
    width: Array
    """(k,) How wide the limb is that it is on, in perimeters."""

    @classmethod
    def of(
        cls,
        source: Contour,
        target: Contour,
        match: Match,
        fixed: Sequence[Pair] = (),
        keys: Sequence[float] | Array = (),
    ) -> Route:
        """Correct a match; ``fixed`` pairs are in the same cyclic order on both contours.

        ``keys`` are places on the source of knots that are to be marks.
        """
        corners, knots = _corner_pairs(source, target, match), _knots(source, target, match)
        begin = (*fixed, *corners, *knots)[0]
        chain = Chain(begin)
        chain.add(fixed)
        chain.add(corners, APART)
        chain.add(knots, ASIDE)
        at, image = np.add(begin, chain.steps).T
        given, corner = (
            np.array([*(pair in kind for pair in chain.pairs), False]) for kind in (fixed, corners)
        )
        near = np.abs(gap(at[:-1, None], np.asarray(keys))) < SAME
        key = np.append(near.any(axis=1), False)
        width = np.minimum(source.widths_at(at), target.widths_at(image))
        return cls(replace(match, source=at, target=image), given, corner, key, width)

    @classmethod
    def plain(cls, match: Match) -> Route:
        """Take a match as it is."""
        none = np.zeros(len(match.source), dtype=bool)
        return cls(match, none, none, none, np.full(len(none), WIDE))

    def reversed(self) -> Route:
        """Return the same route, seen from the target."""
        return replace(self, match=self.match.reversed())

    def key_knots(self) -> Indices:
        """Return which knots suffice as marks, besides the fixed ones, in order."""
        s, t = self.match.source, self.match.target
        known = np.flatnonzero(self.fixed).tolist()
        chosen = np.flatnonzero(self.key & ~self.fixed).tolist()
        if not known and not chosen:
            chosen = [int(np.argmax(self.match.sureness(s[:-1]) + self.corner[:-1]))]
        tolerance = np.where(self.corner, CLOSER, CLOSE)
        tolerance = np.minimum(tolerance, np.maximum(SLIM * self.width, CLOSEST))
        while len(known) + len(chosen) < MOST:
            kept = np.sort([*known, *chosen])
            ends, turn = np.array([kept[-1], *kept, kept[0]]), np.array([-1, *(0 * kept), 1])
            along = np.interp(s, s[ends] + turn, t[ends] + turn) - t
            back = np.interp(t, t[ends] + turn, s[ends] + turn) - s
            off = np.sqrt(np.abs(along * back))
            needed = off / tolerance
            if needed.max() <= 1 or (not chosen and off.max() <= ENOUGH):
                break
            chosen.append(int(np.argmax(needed[:-1])))
        return np.sort(np.array(chosen, dtype=np.int64))


def _knots(source: Contour, target: Contour, match: Match) -> list[Pair]:
    at, image = source.drawn(match.source[:-1] % 1.0), target.drawn(match.target[:-1] % 1.0)
    return list(zip(at.tolist(), image.tolist(), strict=True))


def _corner_pairs(source: Contour, target: Contour, match: Match) -> list[Pair]:
    """Return corners that are each other's nearest likeness along the match, the closest first."""
    (s, s_turns), (t, t_turns) = source.corners, target.corners
    if not len(s) or not len(t):
        return []
    along, back = gap(t, match.image(s)[:, None]), gap(s[:, None], match.origin(t))
    away = np.sqrt(np.abs(along * back))
    unlike = np.abs(s_turns[:, None] - t_turns)
    width = np.minimum(source.widths_at(s)[:, None], target.widths_at(t))
    near = np.minimum(NEAR, NEARER * width)
    possible = (away < near) & (unlike < SIMILAR) & (s_turns[:, None] * t_turns > 0)
    cost = np.where(possible, away / NEAR + unlike / SIMILAR, np.inf)
    j = cost.argmin(axis=1)
    i = np.flatnonzero((cost.argmin(axis=0)[j] == np.arange(len(s))) & possible.any(axis=1))
    i = i[np.argsort(cost[i, j[i]], kind="stable")]
    return [(float(s[k]), float(t[j[k]])) for k in i]
