"""The cheapest monotone path through a table of costs: elastic matching by dynamic programming.

A step (a, b) goes a samples on along the source and b along the target; a and b have no common
divisor, so every slope has one step. Stretching costs ``a + b − 2√(ab)``, and ``√(ab)`` times the
mean misfit along the step comes on top: the same whichever of the two is called the source.
"""

from __future__ import annotations

from math import gcd

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from core.geometry.triangulation import Indices
from core.model.outline import Array

Costs = NDArray[np.float32]

FINE, STEEPEST = 4, 8
"""The longest steps: of any slope, and with a one, for what only one of the shapes has."""
FLAT = tuple((1, b) for b in range(STEEPEST, 0, -1))
STEEP = tuple((a, 1) for a in range(STEEPEST, 1, -1))
OTHER = tuple((a, b) for a in range(2, FINE + 1) for b in range(2, FINE + 1) if gcd(a, b) == 1)
STEPS = (*FLAT, *STEEP, *OTHER)
"""In this order, those that come from one row, and those that come from one column, are windows."""


def cheapest_paths(
    misfits: Costs, widths: tuple[float, float] = (1.0, 1.0), slack: int = 0
) -> tuple[list[Indices], Array]:
    """Find the cheapest paths through tables of misfits (c, n + 1, m + 1), all at once.

    A path runs from the first row to the last; it may begin within the first ``slack`` columns and
    end within the last. ``widths`` are those of a row and a column. Returns the paths (k, 2), as
    rows and columns, and their costs (c,); an empty path of cost ∞ where all would be too steep.
    """
    count, rows, columns = misfits.shape
    steps = _step_costs(misfits, widths)
    pad = STEEPEST  # so that every step has somewhere to come from
    best = np.full((rows + pad, count, columns + pad), np.inf, dtype=np.float32)
    best[pad, :, pad : pad + slack + 1] = 0.0
    window = sliding_window_view(best, columns, axis=2).transpose(0, 2, 1, 3)  # by shift
    ways = np.empty((len(STEPS), count, columns), dtype=np.float32)
    flat, steep = len(FLAT), len(FLAT) + len(STEEP)
    for row in range(1, rows):
        here, cost = pad + row, steps[row]
        np.add(window[here - 1, :pad], cost[:flat], out=ways[:flat])
        np.add(window[here - pad : here - 1, pad - 1], cost[flat:steep], out=ways[flat:steep])
        for way, (a, b) in enumerate(OTHER, steep):
            np.add(window[here - a, pad - b], cost[way], out=ways[way])
        ways.min(axis=0, out=best[here, :, pad:])
    ends = best[-1, :, columns + pad - slack - 1 :]
    costs = ends.min(axis=1).astype(float)
    return _walked_back(best, steps, columns - slack - 1 + ends.argmin(axis=1), costs), costs


def _step_costs(misfits: Costs, widths: tuple[float, float]) -> Costs:
    """Return (n + 1, steps, c, m + 1) what each step costs, by the sample where it ends."""
    count, rows, columns = misfits.shape
    table = np.ascontiguousarray(misfits.transpose(1, 0, 2))
    costs = np.full((rows, len(STEPS), count, columns), np.inf, dtype=np.float32)
    for way, (a, b) in enumerate(STEPS):
        if a >= rows or b >= columns:
            continue
        length = max(a, b)
        total = table[a:, :, b:] + table[:-a, :, :-b]  # trapezoidal rule along the step
        total *= np.float32(0.5)
        for k in range(1, length):
            i, j = round(a * k / length), round(b * k / length)
            total += table[a - i : rows - i, :, b - j : columns - j]
        wide, high = a * widths[0], b * widths[1]
        mean = np.sqrt(wide * high)
        total *= np.float32(mean / length)
        np.add(total, np.float32(wide + high - 2 * mean), out=costs[a:, way, :, b:])
    return costs


def _walked_back(best: Costs, steps: Costs, ends: Indices, costs: Array) -> list[Indices]:
    """Follow, for all tables at once, the steps that attained the minimum.

    That is quicker than noting them on the way there.
    """
    back, table = np.array(STEPS), np.arange(len(ends))
    cell = np.column_stack([np.where(np.isfinite(costs), len(steps) - 1, 0), ends])
    trail = [cell]
    while cell[:, 0].any():
        rows, columns = (cell[:, None] - back + STEEPEST).T
        ways = best[rows, table, columns].T + steps[cell[:, 0], :, table, cell[:, 1]]
        cell = cell - back[ways.argmin(axis=1)] * (cell[:, :1] > 0)
        trail.append(cell)
    cells = np.array(trail[::-1])
    length = np.count_nonzero(cells[:, :, 0], axis=0)
    return [cells[-1 - n :, c] if n else cells[:0, c] for c, n in enumerate(length)]
