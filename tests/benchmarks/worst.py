"""Which pairs are the worst, and why: how far each exceeds what is expected of all."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from tests.benchmarks.measures import Row

WORST = 20


@dataclass(frozen=True)
class Expectation:
    """A quantity and what it should not exceed."""

    of: Callable[[Row], float]
    limit: float
    words: str
    """What is wrong with a pair that exceeds it."""


EXPECTATIONS = (
    Expectation(lambda row: row.folds_source + row.folds_target, 0, "{:.0f} folds at the ends"),
    Expectation(lambda row: row.folded_frames, 0, "{:.0f} frames folded"),
    Expectation(lambda row: 0 if row.repairs else row.end_error, 1e-9, "ends off by {:.1g}"),
    Expectation(lambda row: row.distortion_mean, 2.8, "SD {:.2f}"),
    Expectation(lambda row: len(row.crossing), 0, "{:.0f} frames cross"),
    Expectation(lambda row: row.jolt_ratio, 3, "velocity jumps {:.1f} x plain ARAP's"),
)
"""What a whole sweep is to fulfil; what weighs more comes first."""


def badness(row: Row) -> tuple[float, ...]:
    """Return the key by which pairs are ordered, the worst last.

    Folds and ends that are off come first; what remains is counted in multiples of its limit, or,
    where none is allowed, in numbers.
    """
    folds, frames, ends, *others = (
        expected.of(row) / (expected.limit or 1) for expected in EXPECTATIONS
    )
    return folds + frames + (ends > 1), max(others), sum(others)


def complaints(row: Row) -> str:
    """Return in words all that is wrong with a pair."""
    found = [
        expected.words.format(expected.of(row))
        for expected in EXPECTATIONS
        if expected.of(row) > expected.limit
    ]
    return ", ".join(found) or "nothing"


def worst(rows: Sequence[Row], count: int = WORST) -> list[Row]:
    """Return the worst pairs, the very worst first."""
    return sorted(rows, key=badness, reverse=True)[:count]
