"""What came of work, kept as long as it may be asked for again."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Collection, Hashable, Iterator
from typing import Generic, TypeVar

K = TypeVar("K", bound=Hashable)
V = TypeVar("V")


class Remembered(Generic[K, V]):
    """Outcomes by what they were made from: all that are in use, and a number of others."""

    def __init__(self, others: int) -> None:
        self._others = others
        self._outcomes: OrderedDict[K, V] = OrderedDict()

    def __contains__(self, key: K) -> bool:
        return key in self._outcomes

    def __len__(self) -> int:
        return len(self._outcomes)

    def items(self) -> Iterator[tuple[K, V]]:
        """Yield all, the one used last at the end."""
        yield from self._outcomes.items()

    def get(self, key: K) -> V | None:
        """Return what came of it, if that is known."""
        return self._outcomes.get(key)

    def use(self, key: K) -> V | None:
        """Return what came of it; that is now the outcome used last."""
        if key in self._outcomes:
            self._outcomes.move_to_end(key)
        return self._outcomes.get(key)

    def put(self, key: K, outcome: V, in_use: Collection[K]) -> None:
        """Note what came of it; of those not in use, the ones used longest ago are forgotten."""
        self._outcomes[key] = outcome
        others = [old for old in self._outcomes if old not in in_use]
        for old in others[: max(len(others) - self._others, 0)]:
            del self._outcomes[old]

    def forget(self, key: K) -> None:
        """Forget what came of it."""
        self._outcomes.pop(key, None)
