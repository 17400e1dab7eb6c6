"""Every pair of real outlines, measured and drawn: ``python -m tests.benchmarks.sweep``.

Each pair is solved with automatic marks. The folder gets ``table.csv`` with a line a pair,
``summary.txt``, ``sheet-*.png`` with every pair and ``worst.png`` with the worst ones. On the
sheets, equal hues along both boundaries are places that belong together.
"""

from __future__ import annotations

import argparse
import csv
import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
from PySide6.QtGui import QImage
from tqdm import tqdm

import core
from core.morph.quality import crosses_itself, folds
from tests.benchmarks.measures import Row, measure
from tests.benchmarks.pairs import OUTLINES, Pair, across_classes, load_outlines, within_classes
from tests.benchmarks.sheet import Panel, application, draw_row, save, stack
from tests.benchmarks.summary import WORST, badness, summary

STRIP = np.arange(1, 6) / 6
"""Moments of the in-betweens that are drawn."""
PAIRS_A_SHEET = 12
SIDE = 130
ABSENT = 2
"""Exit code without the outlines."""


def sweep(pairs: Iterable[Pair], frames: int, folder: Path) -> str:
    """Measure and draw pairs into a folder; return the summary."""
    rows: list[Row] = []
    refused: list[tuple[str, str]] = []
    worst: list[tuple[Row, QImage]] = []
    sheets = _Sheets(folder)
    for pair in pairs:
        try:
            row, morph = measure(pair, frames)
        except core.MorphError as error:
            refused.append((pair.name, str(error)))
            continue
        rows.append(row)
        picture = draw_row(list(panels(row, morph)), SIDE)
        sheets.add(picture)
        worst = sorted([*worst, (row, picture)], key=lambda each: badness(each[0]))[-WORST:]
    sheets.close()
    if worst:
        save(stack([picture for _, picture in reversed(worst)]), folder / "worst.png")
    write_table(rows, refused, folder / "table.csv")
    text = summary(rows, refused)
    (folder / "summary.txt").write_text(text, encoding="utf-8")
    return text


def panels(row: Row, morph: core.Morph) -> Iterator[Panel]:
    """Yield the source, its mesh, the target's mesh, the target, and five in-betweens."""
    source, target = row.pair.split(" → ")
    rest, goal, rings, triangles = morph.rest, morph.target, morph.rings, morph.triangles
    turned = folds(goal, triangles)
    yield Panel(source, rest, rings, rainbow=True)
    yield Panel(f"{row.triangles} triangles", rest, rings, triangles)
    yield Panel(f"SD {row.distortion_mean:.2f}", goal, rings, triangles, turned)
    yield Panel(target, goal, rings, rainbow=True)
    for t in STRIP:
        frame = morph.at(t)
        crosses = crosses_itself([frame[ring] for ring in rings])
        title = f"{t:.2f} crosses" if crosses else f"{t:.2f}"
        yield Panel(title, frame, rings)


def write_table(rows: Sequence[Row], refused: Sequence[tuple[str, str]], path: Path) -> None:
    """Write a line a pair; those that were refused have the reason in the last column."""
    records = [row.record() for row in rows]
    columns = list(records[0]) if records else ["pair"]
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, [*columns, "refused"], restval="")
        table.writeheader()
        table.writerows(records)
        table.writerows({"pair": pair, "refused": reason} for pair, reason in refused)


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


def main() -> None:
    """Sweep over the pairs and print the summary."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--every", type=int, default=1, metavar="N", help="take each N-th pair")
    parser.add_argument("--cross", type=int, default=0, metavar="N", help="add N of two classes")
    parser.add_argument("--frames", type=int, default=33, help="frames a pair, ends included")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/sweep"))
    options = parser.parse_args()
    if not OUTLINES.is_file():
        parser.exit(ABSENT, f"The outlines are not here: {OUTLINES}\n")
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    app = application()
    outlines = load_outlines()
    pairs = within_classes(outlines)[:: options.every] + across_classes(outlines, options.cross)
    print(sweep(tqdm(pairs, unit="pair"), options.frames, options.output))
    del app


if __name__ == "__main__":
    main()
