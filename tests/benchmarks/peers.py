"""Public peers on our own meshes, side by side: ``python -m tests.benchmarks.peers``.

Untangling: ours and mouette's, from the same harmonic start; ours stops at the first valid map and
leaves distortion to the polish. Polish: ours and libigl's SLIM, from our untangled map. Everything
runs in one thread. A peer that is not installed is left out; ``pip install -e '.[peers]'`` has all.
"""

from __future__ import annotations

import argparse
import csv
import os
from collections.abc import Collection, Iterator
from dataclasses import asdict, dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from tqdm import tqdm

import core
from tests.benchmarks.pairs import OUTLINES, Pair, load_outlines, within_classes
from tests.benchmarks.placing import (
    Placed,
    Solve,
    Task,
    mouette_untangling,
    our_patient_untangling,
    our_polish,
    our_polished_untangling,
    our_untangling,
    placed,
    slim_polish,
)

UNTANGLING: dict[str, Solve] = {
    "ours": our_untangling,
    "ours, patient": our_patient_untangling,
    "  and polished": our_polished_untangling,
    "mouette": mouette_untangling,
}
POLISH: dict[str, Solve] = {"ours": our_polish, "SLIM": slim_polish}
MODULES = {"mouette": "mouette", "SLIM": "igl"}
"""What each peer needs."""
RIVALS = {"mouette": "  and polished", "SLIM": "ours"}
"""What of ours does as much as each peer."""
ABSENT = 2
"""Exit code without the outlines."""


@dataclass(frozen=True)
class Line:
    """One mesh: what every solver made of it."""

    pair: str
    triangles: int
    folds_start: int
    untangled: dict[str, Placed]
    """Empty where the start does not fold."""
    polished: dict[str, Placed]
    """Empty where ours did not untangle the start."""

    def record(self) -> dict[str, object]:
        """Return plain values by name."""
        columns = {"pair": self.pair, "triangles": self.triangles, "folds_start": self.folds_start}
        for stage, results in (("untangling", self.untangled), ("polish", self.polished)):
            for name, result in results.items():
                columns |= {f"{stage}, {name}: {k}": v for k, v in asdict(result).items()}
        return columns


def compare(pair: Pair, triangles: int, absent: Collection[str] = ()) -> Line:
    """Give a pair's mesh to every solver that is not absent."""
    task = Task.of(pair, triangles)
    start = valid = task.start()
    untangled, polished = {}, {}
    if task.folds(start):
        found = {k: solve(task, start) for k, solve in UNTANGLING.items() if k not in absent}
        untangled = {name: placed(task, *result) for name, result in found.items()}
        valid, _ = found["ours, patient"]
    if not task.folds(valid):
        found = {k: solve(task, valid) for k, solve in POLISH.items() if k not in absent}
        polished = {name: placed(task, *result) for name, result in found.items()}
    return Line(pair.name, len(task.mesh.triangles), task.folds(start), untangled, polished)


def summary(lines: list[Line]) -> str:
    """Return what the lines say, with the figures in which a peer is ahead as well."""
    tangled = [line.untangled for line in lines if line.untangled]
    polished = [line.polished for line in lines if line.polished]
    text = [
        f"{len(lines)} meshes of {np.median([line.triangles for line in lines]):.0f} triangles",
        "",
        f"untangling, from {len(tangled)} harmonic maps that fold",
        *_table(tangled),
        "",
        f"polish, from {len(polished)} maps without a fold, ours",
        *_table(polished),
    ]
    return "\n".join(text) + "\n"


def _table(results: list[dict[str, Placed]]) -> Iterator[str]:
    """Compare the solvers, figures of quality where all of them left no fold."""
    yield (
        f"{'':<16}{'no fold':>9}{'ms':>10}{'95 %':>10}{'max':>10}{'SD mean':>10}{'95 %':>8}"
        f"{'SD worst':>10}{'95 %':>10}{'boundary moved':>16}"
    )
    names = list(dict.fromkeys(name for result in results for name in result))
    sound = [result for result in results if not any(each.folds for each in result.values())]
    for name in names:
        ms = np.percentile([result[name].ms for result in results], [50, 95, 100])
        free = sum(result[name].folds == 0 for result in results)
        mean, worst = (
            np.percentile([getattr(r[name], figure) for r in sound] or [np.nan], [50, 95])
            for figure in ("distortion_mean", "distortion_worst")
        )
        moved = max(result[name].moved for result in results)
        yield (
            f"{name:<16}{free:9}{ms[0]:10.1f}{ms[1]:10.1f}{ms[2]:10.1f}"
            f"{mean[0]:10.4f}{mean[1]:8.3f}{worst[0]:10.4g}{worst[1]:10.4g}{moved:16.1e}"
        )
    for peer in RIVALS.keys() & names:
        yield from _ratios(peer, RIVALS[peer], results, sound)


def _ratios(
    peer: str, ours: str, results: list[dict[str, Placed]], sound: list[dict[str, Placed]]
) -> Iterator[str]:
    times = np.array([result[peer].ms / result[ours].ms for result in results])
    above = np.array([r[peer].distortion_mean / r[ours].distortion_mean - 1 for r in sound])
    yield (
        f"{peer} takes {np.median(times):.1f} x our time (5 %: {np.percentile(times, 5):.1f}),"
        f" less than ours on {np.sum(times < 1)}; its SD is over 0.1 % higher on"
        f" {np.sum(above > 1e-3)}, lower on {np.sum(above < -1e-3)}"
    )


def write_table(lines: list[Line], path: Path) -> None:
    """Write a line a mesh."""
    records = [line.record() for line in lines]
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(dict.fromkeys(k for r in records for k in r)), restval="")
        table.writeheader()
        table.writerows(records)


def absent_peers() -> list[str]:
    """Return the peers that are not installed, and say so."""
    absent = [name for name, module in MODULES.items() if find_spec(module) is None]
    for name in absent:
        print(f"Without {name}: {MODULES[name]} is not installed; the extra 'peers' holds it.")
    return absent


def main() -> None:
    """Compare on every N-th pair; write the table and print the summary."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--every", type=int, default=8, metavar="N", help="take each N-th pair")
    parser.add_argument("--triangles", type=int, default=512, help="how many to aim for")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/peers"))
    options = parser.parse_args()
    if not OUTLINES.is_file():
        parser.exit(ABSENT, f"The outlines are not here: {OUTLINES}\n")
    os.environ["OMP_NUM_THREADS"] = "1"
    absent = absent_peers()
    pairs = within_classes(load_outlines(OUTLINES))[:: options.every]
    compare(pairs[0], 64, absent)  # mouette compiles, once
    lines = []
    for pair in tqdm(pairs, unit="pair"):
        try:
            lines.append(compare(pair, options.triangles, absent))
        except core.MorphError as error:
            print(f"{pair.name}: {error}")
    write_table(lines, options.output / "table.csv")
    text = summary(lines)
    (options.output / "summary.txt").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
