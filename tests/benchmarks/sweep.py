"""Every pair of real outlines, measured and drawn: ``python -m tests.benchmarks.sweep``.

Each pair is solved with automatic marks. The folder gets ``table.csv`` with a line a pair,
``summary.txt``, ``sheet-*.png`` with every pair and ``worst.png`` with the worst ones. On the
sheets, equal hues along both boundaries are places that belong together. Beside ours stand straight
paths, blended lengths and angles, and the JavaScript library flubber where node can run it.
"""

from __future__ import annotations

import argparse
import csv
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from PySide6.QtGui import QImage
from tqdm import tqdm

from core.model import Recipe
from tests.benchmarks.flubber import AbsentError, installed
from tests.benchmarks.glyphs import glyph_pairs
from tests.benchmarks.holes import hole_pairs
from tests.benchmarks.icons import icon_pairs
from tests.benchmarks.measures import Row
from tests.benchmarks.pairs import OUTLINES, Pair, across_classes, load_outlines, within_classes
from tests.benchmarks.sheet import application, draw_row, save, stack
from tests.benchmarks.summary import summary
from tests.benchmarks.survey import Plan, Refused, survey_all
from tests.benchmarks.worst import WORST, badness

PAIRS_A_SHEET = 12
SIDE = 130
ABSENT = 2
"""Exit code without the outlines."""


def sweep(pairs: Iterable[Pair], plan: Plan, folder: Path, jobs: int = 1) -> str:
    """Measure and draw pairs into a folder; return the summary."""
    rows: list[Row] = []
    refused: list[Refused] = []
    worst: list[tuple[Row, QImage]] = []
    sheets = _Sheets(folder)
    for found in survey_all(plan, pairs, jobs):
        if isinstance(found, Refused):
            refused.append(found)
            continue
        rows.append(found.row)
        picture = draw_row(found.panels, SIDE)
        sheets.add(picture)
        worst = sorted([*worst, (found.row, picture)], key=lambda each: badness(each[0]))[-WORST:]
    sheets.close()
    if worst:
        save(stack([picture for _, picture in reversed(worst)]), folder / "worst.png")
    write_table(rows, refused, folder / "table.csv")
    text = summary(rows, refused, timed=jobs == 1)
    (folder / "summary.txt").write_text(text, encoding="utf-8")
    return text


def write_table(rows: Sequence[Row], refused: Sequence[Refused], path: Path) -> None:
    """Write a line a pair; those that were refused have the reason in the last column."""
    records = [row.record() for row in rows]
    columns = dict.fromkeys(["pair", *(name for record in records for name in record), "refused"])
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(columns), restval="")
        table.writeheader()
        table.writerows(records)
        table.writerows({"pair": each.pair, "refused": each.reason} for each in refused)


class _Sheets:
    """Collects rows of pictures and writes a sheet whenever one is full."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._rows, self._written = folder, [], 0

    def add(self, row: QImage) -> None:
        self._rows.append(row)
        if len(self._rows) == PAIRS_A_SHEET:
            self.close()

    def close(self) -> None:
        """Write what has been collected since the last full sheet."""
        if self._rows:
            self._written += 1
            save(stack(self._rows), self._folder / f"sheet-{self._written:02}.png")
            self._rows.clear()


def arguments() -> argparse.ArgumentParser:
    """Return the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--every", type=int, default=1, metavar="N", help="take each N-th of the pairs; 0: none")
    add("--cross-class", type=int, default=0, metavar="N", help="add N pairs of two classes")
    add("--own", action="store_true", help="add letters, icons, and shapes with holes")
    add("--given-marks", action="store_true", help="solve again with the marks that were found")
    add("--density", type=int, default=128, help="of the mesh; 40 gives about 540 triangles")
    add("--frames", type=int, default=33, help="frames a pair, ends included")
    add("--jobs", type=int, default=1, metavar="N", help="processes; only 1 gives timings")
    add("-o", "--output", type=Path, default=Path("out/sweep"), help="folder for table and sheets")
    return parser


def chosen_pairs(options: argparse.Namespace) -> list[Pair]:
    """Return the pairs that the command line asks for; needs a running application."""
    pairs: list[Pair] = []
    if options.every or options.cross_class:
        outlines = load_outlines(OUTLINES)
        pairs += within_classes(outlines)[:: options.every] if options.every else []
        pairs += across_classes(outlines, options.cross_class)
    if options.own:
        pairs += [*glyph_pairs(), *icon_pairs(), *hole_pairs()]
    return pairs


def main() -> None:
    """Sweep over the pairs and print the summary."""
    parser = arguments()
    options = parser.parse_args()
    if (options.every or options.cross_class) and not OUTLINES.is_file():
        parser.exit(ABSENT, f"The outlines are not here: {OUTLINES}\n")
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    app = application()
    try:
        flubber = installed()
    except AbsentError as reason:
        print(f"Without flubber: {reason}.")
        flubber = None
    recipe = Recipe(density=options.density)
    plan = Plan(options.frames, recipe, options.given_marks, flubber)
    pairs = tqdm(chosen_pairs(options), unit="pair")
    print(sweep(pairs, plan, options.output, options.jobs))
    del app


if __name__ == "__main__":
    main()
