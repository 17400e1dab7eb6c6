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
from core.morph.marks.alignment import Fit, fit, fit_limbs, overlays, shifts
from core.morph.marks.chain import Pair
from core.morph.marks.contour import Complex, Contour, Samples, gap
from core.morph.marks.elastic import cheapest_paths
from core.morph.marks.grid import BINS, Grid, bin_width, widths
from core.morph.marks.misfit import confidence, position_misfits, shape_misfits

SHIFTS, OVERLAYS = 3, 3
"""Ways to lay the source on the target that are tried first; as many on the mirrored target."""
KEPT = 3
"""How many of either are followed further."""
SLACK = 8
"""By how many bins a first path may miss its own start."""
REACHES = (0.6, 0.3)
"""How far a part of the contour carries others along, in radii: a round each."""
ALIKE = 0.015
"""Correspondences that differ by less than this part of the perimeter on average are one."""
UPRIGHT = 0.02
"""What a half turn counts for when paths are compared: it decides between equals."""


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

    def sureness(self, at: Array) -> Array:
        """Return the confidence at places on the source (j,)."""
        return np.interp(np.mod(at, 1.0), self.at, self.confidence, period=1.0)


def match_contours(
    source: Contour,
    target: Contour,
    fixed: Sequence[Pair] = (),
    rotation: complex | None = None,
) -> list[Match]:
    """Return correspondences of two contours that differ, the cheapest first.

    ``fixed`` pairs of places, in the same cyclic order on both, stay together. Without them the
    mirrored target is tried as well, unless the ``rotation`` (of length one) of the source is
    known; then that alone is tried.
    """
    grid = Grid.through(fixed) if fixed else Grid.free(source, target)
    here = Samples.of(source, grid.source)
    guesses = _guesses(grid, source, here, target, rotation)
    if not fixed and rotation is None:
        reflected = target.mirrored()
        mirror = _guesses(Grid.free(source, reflected), source, here, reflected, None)
        guesses += [replace(guess, mirrored=True) for guess in mirror]
    paths = _cheapest(here, guesses, 0 if fixed else SLACK)
    for reach in REACHES:
        paths = _cheapest(here, [_followed(here, path, reach, free=not fixed) for path in paths])
    return [_match(here, path) for path in paths]


# -- from guess to path, and from path to guess ----------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Guess:
    """Where the source is expected on the target."""

    there: Samples
    pins: Indices
    """(k, 2) samples that belong together."""
    points: Complex
    """(n,) where the samples of the source are expected."""
    rotation: Complex
    """(n,) how they are turned."""
    mirrored: bool = False


@dataclass(frozen=True, eq=False)
class _Path:
    """What came of a guess."""

    guess: _Guess
    shape: Array
    """(n, m) misfits of the shape, between all samples."""
    misfits: Array
    """(n, m) of shape and position."""
    knots: Indices
    """(k, 2) samples that belong together, counted on past the end of a ring."""
    cost: float

    @property
    def columns(self) -> Array:
        """(n,) where the samples of the source belong, between samples of the target."""
        n = len(self.misfits)
        rows = self.knots[0, 0] + np.arange(n)
        return np.roll(np.interp(rows, *self.knots.T), self.knots[0, 0])


def _guesses(
    grid: Grid, source: Contour, here: Samples, target: Contour, rotation: complex | None
) -> list[_Guess]:
    """Lay the source on the target in the ways that fit best as a whole."""
    there = Samples.of(target, grid.target)
    if len(grid.pins):  # as if the length along the ring told the rest
        ends = np.vstack([grid.pins, [[len(here.at), len(there.at)]]])
        columns = np.interp(np.arange(len(here.at)), *ends.T)
        ways = [fit(here.points, there.between(columns), widths(here.at))]
        pins = [grid.pins]
    else:
        steps = shifts(here.points, there.points, SHIFTS, rotation)
        ways = [fit(here.points, np.roll(there.points, -k), np.ones(BINS)) for k in steps]
        pins = [np.array([[0, k]]) for k in steps]
    if rotation is None:
        coarse = here.every(2), there.every(2)
        for way in overlays(source, target, *coarse, ways[0].rotation, OVERLAYS):
            ways.append(way)
            pins.append(grid.pins if len(grid.pins) else _best_cell(way, *coarse) * 2)
    n = len(here.at)
    return [
        _Guess(there, own, way(here.points), np.full(n, way.rotation))
        for own, way in zip(pins, ways, strict=True)
    ]


def _best_cell(way: Fit, here: Samples, there: Samples) -> Indices:
    """Return (1, 2) the samples where two contours, one laid on the other, run together best."""
    misfits = shape_misfits(here, way.rotation[None], there)
    misfits += position_misfits(way(here.points), there.points)
    together = sum(np.roll(misfits, (k, k), axis=(0, 1)) for k in (-2, -1, 0, 1, 2))
    return np.array([np.unravel_index(np.argmin(together), misfits.shape)])


def _cheapest(here: Samples, guesses: Sequence[_Guess], slack: int = 0) -> list[_Path]:
    """Find the cheapest path of each guess; of those that are alike the cheapest stays."""
    shapes = [shape_misfits(here, guess.rotation, guess.there) for guess in guesses]
    misfits = [
        shape + position_misfits(guess.points, guess.there.points)
        for shape, guess in zip(shapes, guesses, strict=True)
    ]
    knots, costs = _paths(here, guesses, misfits, slack)
    found: list[_Path] = []
    turned = [(1 - guess.rotation.real.mean()) / 2 for guess in guesses]
    for k in np.argsort(costs + UPRIGHT * np.array(turned), kind="stable"):
        path = _Path(guesses[k], shapes[k], misfits[k], knots[k], float(costs[k]))
        rivals = [other for other in found if other.guess.mirrored == path.guess.mirrored]
        if path.guess.mirrored and len(rivals) < len(found):
            continue  # a mirror is worth nothing unless it is better than all that is not
        if len(rivals) < KEPT and all(_apart(path, other) > ALIKE for other in rivals):
            found.append(path)
    return found


def _apart(path: _Path, other: _Path) -> float:
    m = path.misfits.shape[1]
    return float(np.mean(np.abs(gap(path.columns / m, other.columns / m))))


def _paths(
    here: Samples, guesses: Sequence[_Guess], misfits: Sequence[Array], slack: int
) -> tuple[list[Indices], Array]:
    """Run from pin to pin, for all guesses at once; return their knots (k, 2) and costs."""
    n, m = misfits[0].shape
    pins = np.stack([guess.pins for guess in guesses])
    ends = np.concatenate([pins[:, 1:], pins[:, :1] + [n, m]], axis=1)
    knots: list[list[Indices]] = [[] for _ in guesses]
    costs = np.zeros(len(guesses))
    for begin, end in zip(pins.swapaxes(0, 1), ends.swapaxes(0, 1), strict=True):
        rows, columns = end[0] - begin[0]  # the same for every guess
        down, along = np.arange(rows + 1), np.arange(-slack, columns + slack + 1)
        tables = [
            table[np.ix_((i + down) % n, (j + along) % m)]
            for table, (i, j) in zip(misfits, begin, strict=True)
        ]
        size = bin_width(here.at, begin[0, 0]), bin_width(guesses[0].there.at, begin[0, 1])
        paths, piece = cheapest_paths(np.array(tables, dtype=np.float32), size, 2 * slack)
        costs += piece / BINS
        for own, path, start in zip(knots, paths, begin, strict=True):
            own.append((path[1:] if own else path) + start - [0, slack])
    return [np.concatenate(own) for own in knots], costs


def _followed(here: Samples, path: _Path, reach: float, free: bool) -> _Guess:
    """Expect every part of the source where the path has led the parts around it."""
    matched = path.guess.there.between(path.columns)
    limbs = fit_limbs(here.points, here.points, matched, widths(here.at), reach)
    pins = _best_pin(path) if free else path.guess.pins
    return replace(path.guess, pins=pins, points=limbs(here.points), rotation=limbs.rotation)


def _best_pin(path: _Path) -> Indices:
    """Choose where to open the ring next: where it fits best, far from where it was open."""
    n, m = path.misfits.shape
    middle = path.knots[len(path.knots) // 3 : -(len(path.knots) // 3)] % [n, m]
    return middle[[np.argmin(path.misfits[middle[:, 0], middle[:, 1]])]]


def _match(here: Samples, path: _Path) -> Match:
    there, knots = path.guess.there, path.knots
    source, target = here.at[knots[:, 0] % len(here.at)], there.at[knots[:, 1] % len(there.at)]
    return Match(
        np.unwrap(source, period=1.0),
        np.unwrap(target, period=1.0),
        path.cost,
        here.at,
        confidence(path.misfits, path.shape, path.columns),
        path.guess.mirrored,
    )
