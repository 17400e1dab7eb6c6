"""How long a pair takes whose marks are given, and how long when one of them has moved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from time import perf_counter

from core.model import Outline, Recipe, RingPoint
from core.morph.pipeline import solve_outlines
from core.morph.report import Report
from tests.benchmarks.pairs import Pair

Marks = list[tuple[RingPoint, RingPoint]]

REPEATS = 3
"""The fastest counts: others use the machine too."""
MOVED = 0.1
"""How far a mark is moved, as a fraction of the way to the next one."""


@dataclass(frozen=True)
class GivenMarks:
    """A pair solved anew with the marks that the automatic run had used."""

    marks: int
    distortion_mean: float
    ms: float
    ms_moved: float
    """After one of them has been moved along the target."""

    def record(self) -> dict[str, object]:
        """Return plain values by name."""
        return {f"marks given: {name}": value for name, value in asdict(self).items()}


def solve_given_marks(pair: Pair, found: Report, recipe: Recipe | None) -> GivenMarks:
    """Measure a pair that has been solved without marks."""
    marks = [(a, b) for a, b, _ in found.proposed]
    ms, report = fastest(pair, marks, recipe)
    ms_moved, _ = fastest(pair, with_one_moved(marks, pair.target), recipe)
    return GivenMarks(len(marks), report.distortion_mean, ms, ms_moved)


def fastest(pair: Pair, marks: Marks, recipe: Recipe | None) -> tuple[float, Report]:
    """Return the milliseconds of the fastest of several solves, and what it says."""
    seconds = []
    for _ in range(REPEATS):
        start = perf_counter()
        morph = solve_outlines(pair.source, pair.target, marks, recipe=recipe)
        seconds.append(perf_counter() - start)
    return 1e3 * min(seconds), morph.report


def with_one_moved(marks: Sequence[tuple[RingPoint, RingPoint]], target: Outline) -> Marks:
    """Return the marks with the first one's place on the target moved towards the next one."""
    (place, image), *others = marks
    nodes = len(target.rings[image.ring])
    gaps = [(b.at - image.at) % nodes for _, b in others if b.ring == image.ring]
    step = MOVED * min([gap for gap in gaps if gap > 0], default=nodes)
    return [(place, RingPoint(image.ring, (image.at + step) % nodes)), *others]
