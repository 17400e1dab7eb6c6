"""The cheapest monotone path through a table of costs: elastic matching by dynamic programming.

A step (a, b) goes a samples on along the source and b along the target; a and b have no common
divisor, so every slope has one step. Stretching costs ``a + b − 2√(ab)``, and ``√(ab)`` times the
mean misfit along the step comes on top: the same whichever of the two is called the source.
"""

from __future__ import annotations

from math import gcd

import numpy as np
from numpy.typing import NDArray

from core.geometry.triangulation import Indices
from core.model.outline import Array

Costs = NDArray[np.float32]

FINE, STEEPEST = 4, 8
"""The longest steps: of any slope, and with a one, for what only one of the shapes has."""
STEPS = tuple(
    (a, b)
    for a in range(1, STEEPEST + 1)
    for b in range(1, STEEPEST + 1)
    if gcd(a, b) == 1 and (max(a, b) <= FINE or min(a, b) == 1)
)


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
    ways = np.empty((len(STEPS), count, columns), dtype=np.float32)
    for row in range(1, rows):
        for way, step, (a, b) in zip(ways, steps, STEPS, strict=True):
            np.add(best[pad + row - a, :, pad - b : pad - b + columns], step[row], out=way)
        ways.min(axis=0, out=best[pad + row, :, pad:])
    ends = best[-1, :, columns + pad - slack - 1 :]
    last, costs = ends.argmin(axis=1), ends.min(axis=1).astype(float)
    paths = [
        _walk_back(best[:, c], steps[:, :, c], columns - slack - 1 + int(last[c]))
        if np.isfinite(costs[c])
        else np.empty((0, 2), dtype=np.int64)
        for c in range(count)
    ]
    return paths, costs


def _step_costs(misfits: Costs, widths: tuple[float, float]) -> Costs:
    """Return (steps, n + 1, c, m + 1) what each step costs, by the sample where it ends."""
    count, rows, columns = misfits.shape
    table = np.ascontiguousarray(misfits.transpose(1, 0, 2))
    costs = np.full((len(STEPS), rows, count, columns), np.inf, dtype=np.float32)
    for cost, (a, b) in zip(costs, STEPS, strict=True):
        if a >= rows or b >= columns:
            continue
        length = max(a, b)
        total = 0.5 * (table[a:, :, b:] + table[:-a, :, :-b])  # trapezoidal rule along the step
        for k in range(1, length):
            i, j = round(a * k / length), round(b * k / length)
            total += table[a - i : rows - i, :, b - j : columns - j]
        wide, high = a * widths[0], b * widths[1]
        mean = np.sqrt(wide * high)
        cost[a:, :, b:] = total * np.float32(mean / length) + np.float32(wide + high - 2 * mean)
    return costs


def _walk_back(best: Costs, steps: Costs, column: int) -> Indices:
    """Follow the steps that attained the minimum; quicker than noting them on the way there."""
    back_a, back_b = np.array(STEPS).T - STEEPEST  # ``best`` has a margin
    row = steps.shape[1] - 1
    path = [(row, column)]
    while row > 0:
        way = np.argmin(best[row - back_a, column - back_b] + steps[:, row, column])
        row, column = row - STEPS[way][0], column - STEPS[way][1]
        path.append((row, column))
    return np.array(path[::-1])
