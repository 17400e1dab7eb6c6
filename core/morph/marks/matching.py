"""Match two contours: where each place of the source belongs on the target.

From every promising way to lay one contour on the other, the cheapest monotone path through a table
of misfits gives a correspondence. That tells better where the source would lie, and so on, limb by
limb: iterated closest points, with a path in place of closest points.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.marks.alignment import (
    Fit,
    far_worse,
    fit,
    fit_limbs,
    leaning,
    overlays,
    peaks,
    shifts,
)
from core.morph.marks.chain import Pair
from core.morph.marks.contour import Complex, Contour, Samples, gap
from core.morph.marks.elastic import cheapest_paths
from core.morph.marks.grid import BINS, COARSE, Grid, bin_width, widths
from core.morph.marks.misfit import (
    confidence,
    direction_misfits,
    position_misfits,
    turn_misfits,
)
from core.progress import Watch, unwatched

SHIFTS, OVERLAYS, BENDS = 2, 3, 2
"""Ways to begin with that are tried, of each kind; as many with the mirrored target."""
KEPT = 3
"""How many of either are followed further."""
SLACK = 4
"""By how many bins a first path may miss its own start."""
REACHES = (0.6, 0.3)
"""How far a part of the contour carries others along, in radii: a round each."""
ALIKE = 0.015
"""Correspondences that differ by less than this part of the perimeter on average are one."""


@dataclass(frozen=True, eq=False)
class Match:
    """A monotone correspondence of two contours, as places on both."""

    source: Array
    """(k,) increasing; the last is the first, one round later."""
    target: Array
    """(k,) where they belong, increasing likewise."""
    cost: float
    """Misfit and stretch along the path: 0 is perfect, 1 is poor."""
    at: Array
    """(n,) places on the source, and …"""
    confidence: Array
    """(n,) … how sure the match is there, in [0, 1]."""
    mirrored: bool

    def image(self, at: Array) -> Array:
        """Return where places on the source (j,) belong on the target."""
        start = self.source[0]
        return np.mod(np.interp(start + np.mod(at - start, 1.0), self.source, self.target), 1.0)

    def origin(self, at: Array) -> Array:
        """Return what belongs to places on the target (j,)."""
        start = self.target[0]
        return np.mod(np.interp(start + np.mod(at - start, 1.0), self.target, self.source), 1.0)

    def reversed(self) -> Match:
        """Return the same correspondence, seen from the target."""
        return replace(self, source=self.target, target=self.source, at=self.image(self.at))

    def sureness(self, at: Array) -> Array:
        """Return the confidence at places on the source (j,)."""
        return np.interp(np.mod(at, 1.0), self.at, self.confidence, period=1.0)


def match_contours(
    source: Contour,
    target: Contour,
    fixed: Sequence[Pair] = (),
    rotation: complex | None = None,
    watch: Watch = unwatched,
) -> list[Match]:
    """Return correspondences of two contours that differ, the cheapest first.

    ``fixed`` pairs of places, in the same cyclic order on both, stay together. Without them the
    mirrored target is tried as well, unless the ``rotation`` (of length one) of the source is
    known; then that alone is tried. ``watch(stage)`` is called before every round and may
    raise ``Cancelled``.
    """
    grid = Grid.through(fixed) if fixed else Grid.free(source, target)
    here = Samples.of(source, grid.source)
    sides = [_Side.of(here, target, grid.target)]
    if not fixed and rotation is None:
        reflected = target.mirrored()
        sides.append(_Side.of(here, reflected, Grid.free(source, reflected).target, mirrored=True))
    coarse, slack = here.every(COARSE), 0 if fixed else SLACK
    laid, bent = [], []
    for side in (side.every(COARSE) for side in sides):
        laid += _laid(source, coarse, side, grid.pins // COARSE, rotation)
        bent += _bent(side, grid.pins // COARSE) if rotation is None else []
    paths = _cheapest(coarse, laid, slack, watch)
    if bent:  # their ends have to meet before they tell where anything lies
        opened = _cheapest(coarse, bent, slack, watch)
        paths += _cheapest(
            here, [_closed(path, sides, free=not fixed) for path in opened], 0, watch
        )
    for reach in REACHES:
        guesses = [_followed(here, path, sides, reach, free=not fixed) for path in paths]
        paths = _cheapest(here, guesses, 0, watch)
    return [_match(here, path) for path in paths]


@dataclass(frozen=True, eq=False)
class _Side:
    """The target, plain or mirrored."""

    contour: Contour
    samples: Samples
    mirrored: bool
    turns: Array
    """(n, m) misfits of the turns with those of the source."""

    @classmethod
    def of(cls, here: Samples, contour: Contour, at: Array, mirrored: bool = False) -> _Side:
        """Sample a target to be matched with the samples of a source."""
        there = Samples.of(contour, at)
        return cls(contour, there, mirrored, turn_misfits(here, there))

    def every(self, step: int) -> _Side:
        """Return every so-manieth sample."""
        return _Side(
            self.contour, self.samples.every(step), self.mirrored, self.turns[::step, ::step]
        )


@dataclass(frozen=True, eq=False)
class _Guess:
    """What is expected to belong together."""

    side: _Side
    pins: Indices
    """(k, 2) samples that do for sure."""
    shape: Array
    """(n, m) misfits of the shape, between all samples."""
    misfits: Array
    """(n, m) of shape and position."""
    leaning: float
    """What it costs to be turned."""

    @classmethod
    def of(
        cls, here: Samples, side: _Side, pins: Indices, points: Complex, rotation: Complex
    ) -> _Guess:
        """Expect samples (n,) of the source at ``points`` (n,), turned by ``rotation`` (n,)."""
        shape = side.turns + direction_misfits(here, rotation, side.samples)
        misfits = shape + position_misfits(points, side.samples.points)
        return cls(side, pins, shape, misfits, float(leaning(rotation).mean()))


@dataclass(frozen=True, eq=False)
class _Path:
    """What came of a guess."""

    guess: _Guess
    knots: Indices
    """(k, 2) samples that belong together, counted on past the end of a ring."""
    cost: float

    @property
    def columns(self) -> Array:
        """(n,) where the samples of the source belong, between samples of the target."""
        first, n = self.knots[0, 0], len(self.guess.misfits)
        return np.roll(np.interp(first + np.arange(n), *self.knots.T), first)

    @property
    def confidence(self) -> Array:
        """(n,) how sure it is that the samples of the source belong there."""
        return confidence(self.guess.misfits, self.guess.shape, self.columns)


# -- where to begin --------------------------------------------------------------------------------


def _laid(
    source: Contour, here: Samples, side: _Side, pins: Indices, rotation: complex | None
) -> list[_Guess]:
    """Lay the source on the target as a whole, in the ways that fit best."""
    there, n = side.samples, len(here.at)
    if len(pins):  # as if the length along the ring told the rest
        ends = np.vstack([pins, [[n, len(there.at)]]])
        columns = np.interp(np.arange(n), *ends.T)
        ways = [(pins, fit(here.points, there.between(columns), widths(here.at)))]
    else:
        ways = [
            (np.array([[0, k]]), fit(here.points, np.roll(there.points, -k), np.ones(n)))
            for k in shifts(here.points, there.points, SHIFTS, rotation)
        ]
    if rotation is None:
        for way in overlays(source, side.contour, here, there, ways[0][1].rotation, OVERLAYS):
            ways.append((pins if len(pins) else _best_cell(way, here, there), way))
    return [
        _Guess.of(here, side, own, way(here.points), np.full(n, way.rotation)) for own, way in ways
    ]


def _best_cell(way: Fit, here: Samples, there: Samples) -> Indices:
    """Return (1, 2) the samples where two contours, one laid on the other, run together best."""
    misfits = turn_misfits(here, there) + direction_misfits(here, way.rotation, there)
    misfits += position_misfits(way(here.points), there.points)
    together = sum(np.roll(misfits, (k, k), axis=(0, 1)) for k in (-2, -1, 0, 1, 2))
    return np.array([np.unravel_index(np.argmin(together), misfits.shape)])


def _bent(side: _Side, pins: Indices) -> list[_Guess]:
    """Go by the turns alone: those of a limb stay when it bends."""
    starts = [pins]
    if not len(pins):
        i = np.arange(len(side.turns))[:, None]
        along = side.turns[i, (i + i.T) % len(i)].sum(axis=0)
        starts = [np.array([[0, k]]) for k in peaks(-along, BENDS)]
    return [_Guess(side, own, side.turns, side.turns, 0.0) for own in starts]


# -- from guess to path, and from path to guess ----------------------------------------------------


def _cheapest(here: Samples, guesses: Sequence[_Guess], slack: int, watch: Watch) -> list[_Path]:
    """Find the cheapest path of each guess; of those that are alike the cheapest stays.

    The most upright one stays in any case, unless it is far worse.
    """
    watch("matching")
    knots, costs = _paths(here, guesses, slack)
    found: list[_Path] = []
    leanings = np.array([guess.leaning for guess in guesses])
    order = np.argsort(costs + leanings, kind="stable")
    plain = [k for k in order if not guesses[k].side.mirrored]
    upright = min(plain, key=leanings.__getitem__)
    if far_worse(costs[upright], costs[plain].min()):
        upright = order[0]
    for k in order:
        path = _Path(guesses[k], knots[k], float(costs[k]))
        mirrored = path.guess.side.mirrored
        rivals = [other for other in found if other.guess.side.mirrored == mirrored]
        if mirrored and len(rivals) < len(found):
            continue  # a mirror is worth nothing unless it is better than all that is not
        wanted = len(rivals) < KEPT or k == upright
        if wanted and all(_apart(path, other) > ALIKE for other in rivals):
            found.append(path)
    return found


def _apart(path: _Path, other: _Path) -> float:
    m = path.guess.misfits.shape[1]
    return float(np.mean(np.abs(gap(path.columns / m, other.columns / m))))


def _paths(here: Samples, guesses: Sequence[_Guess], slack: int) -> tuple[list[Indices], Array]:
    """Run from pin to pin, for all guesses at once; return their knots (k, 2) and costs."""
    n, m = guesses[0].misfits.shape
    there = guesses[0].side.samples
    pins = np.stack([guess.pins for guess in guesses])
    ends = np.concatenate([pins[:, 1:], pins[:, :1] + [n, m]], axis=1)
    knots: list[list[Indices]] = [[] for _ in guesses]
    costs = np.zeros(len(guesses))
    for begin, end in zip(pins.swapaxes(0, 1), ends.swapaxes(0, 1), strict=True):
        rows, columns = end[0] - begin[0]  # the same for every guess
        down, along = np.arange(rows + 1), np.arange(-slack, columns + slack + 1)
        tables = [
            guess.misfits[np.ix_((i + down) % n, (j + along) % m)]
            for guess, (i, j) in zip(guesses, begin, strict=True)
        ]
        size = bin_width(here.at, begin[0, 0]), bin_width(there.at, begin[0, 1])
        paths, piece = cheapest_paths(np.array(tables, dtype=np.float32), size, 2 * slack)
        costs += piece / BINS
        for own, path, start in zip(knots, paths, begin, strict=True):
            own.append((path[1:] if own else path) + start - [0, slack])
    return [np.concatenate(own) for own in knots], costs


def _closed(path: _Path, sides: Sequence[_Side], free: bool) -> _Guess:
    """Go by the turns once more."""
    side = sides[path.guess.side.mirrored]
    return _Guess(side, _pins(path, side, free), side.turns, side.turns, 0.0)


def _followed(
    here: Samples, path: _Path, sides: Sequence[_Side], reach: float, free: bool
) -> _Guess:
    """Expect every part of the source where the path has led the parts around it."""
    before, there = here.every(len(here.at) // len(path.columns)), path.guess.side
    matched = there.samples.between(path.columns)
    limbs = fit_limbs(here.points, before.points, matched, widths(before.at), reach)
    side = sides[there.mirrored]
    return _Guess.of(here, side, _pins(path, side, free), limbs(here.points), limbs.rotation)


def _pins(path: _Path, side: _Side, free: bool) -> Indices:
    """Return what belongs together for sure, as samples of a side that may be finer."""
    pins = _best_pin(path) if free else path.guess.pins
    return pins * (len(side.turns) // len(path.guess.misfits))


def _best_pin(path: _Path) -> Indices:
    """Choose where to open the ring next: where the match is surest, far from where it was open."""
    n, m = path.guess.misfits.shape
    third = len(path.knots) // 3
    middle = path.knots[third:-third] % [n, m]
    return middle[[np.argmax(path.confidence[middle[:, 0]])]]


def _match(here: Samples, path: _Path) -> Match:
    guess, (rows, columns) = path.guess, path.knots.T
    there = guess.side.samples
    return Match(
        np.unwrap(here.at[rows % len(here.at)], period=1.0),
        np.unwrap(there.at[columns % len(there.at)], period=1.0),
        path.cost,
        here.at,
        path.confidence,
        guess.side.mirrored,
    )
