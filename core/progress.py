"""How long work speaks to its caller."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float, str], None]
"""Called as ``progress(fraction, stage)``, fraction in [0, 1], between the steps of long work.

It may raise ``Cancelled``: that is how a caller stops the work.
"""


def silent(fraction: float, stage: str) -> None:
    """Ignore progress."""


def part(progress: Progress, index: int, count: int) -> Progress:
    """Return what reports the progress of one of ``count`` equal parts of work."""
    return lambda fraction, stage: progress((index + fraction) / count, stage)


Watch = Callable[[str], None]
"""Called as ``watch(stage)`` before steps whose number is not known; it may raise ``Cancelled``."""


def unwatched(stage: str) -> None:
    """Watch nothing."""
