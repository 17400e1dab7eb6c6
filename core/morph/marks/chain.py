"""Pairs of places that follow each other in the same cyclic order on two rings."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Iterable

Pair = tuple[float, float]
"""A place on the source and one on the target, as fractions of the perimeters, in [0, 1)."""


class Chain:
    """Pairs in order around both rings, starting at the one that was given first."""

    def __init__(self, first: Pair) -> None:
        self.pairs: list[Pair] = [first]
        self.steps: list[Pair] = [(0.0, 0.0), (1.0, 1.0)]
        """How far each pair, and the first once more, is from the first on either ring."""

    def add(self, pairs: Iterable[Pair], apart: float = 0.0) -> None:
        """Add one after the other those pairs that keep the order, and a distance from the rest."""
        s, t = self.pairs[0]
        for pair in pairs:
            step = (pair[0] - s) % 1.0, (pair[1] - t) % 1.0
            k = min(bisect(self.steps, step), len(self.steps) - 1)  # a hair before 0 gives 1.0
            before, after = self.steps[k - 1], self.steps[k]
            if all(b + apart < x < a - apart for b, x, a in zip(before, step, after, strict=True)):
                self.steps.insert(k, step)
                self.pairs.insert(k, pair)


def in_order(pairs: Iterable[Pair]) -> list[Pair]:
    """Return the pairs that keep the cyclic order of those before them, around the ring."""
    first, *others = pairs
    chain = Chain(first)
    chain.add(others)
    return chain.pairs
