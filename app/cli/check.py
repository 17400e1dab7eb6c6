"""``betwixt check``: are a project's frames sound?"""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from math import isfinite
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from app.cli.mirrors import MIRROR_NOTE
from app.cli.terminal import OK, UNSOUND, WRONG, progress_bar
from core.progress import Progress, part

if TYPE_CHECKING:
    from core.model import Document, Layer

SUMMARY = "look for folds and crossings in a project's frames"
DESCRIPTION = """\
Solve every span of a project and look at every frame: triangles that folded over,
boundaries that cross themselves, how exactly both ends are what was drawn, and
how long it took.

The exit code is 0 when all frames are sound, 3 when some are not, and 1 when the
file or a shape is at fault.
"""
EXAMPLES = """\
examples:
  betwixt check jump.betwixt
  betwixt check jump.betwixt --json > report.json

In the JSON report, "one_to_one" says whether the map from key to key is proved to be
so, "folds" and "crossings" are counts frame by frame, "places" says where they are in
the frames that have any, "end_errors" are fractions of the outline's size, "mirror"
says whether the target matches far better mirrored, "seconds" are times.
"""

Entry = dict[str, Any]
"""What is known of one span, ready for JSON."""


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a project (.betwixt)")
    parser.add_argument("--json", action="store_true", help="print the report as JSON")


def run(options: Namespace) -> int:
    """Check a project and print the report."""
    from core.io import project

    document = project.load(options.file)
    with progress_bar() as progress:
        entries = _entries(document, progress)
    failed = any("error" in entry for entry in entries)
    sound = all(entry["sound"] for entry in entries)
    if options.json:
        import json

        report = {"file": str(options.file), "sound": sound, "spans": entries}
        print(json.dumps(report, indent=2, ensure_ascii=False))
    else:
        print("\n".join(_lines(options.file, entries, sound)))
    if failed:
        return WRONG
    return OK if sound else UNSOUND


def _entries(document: Document, progress: Progress) -> list[Entry]:
    """Check every span; one that cannot be solved does not keep the others from it."""
    spans = [(layer, index) for layer in document.layers for index in range(layer.spans)]
    return [
        _entry(layer, index, part(progress, done, len(spans)))
        for done, (layer, index) in enumerate(spans)
    ]


def _entry(layer: Layer, index: int, progress: Progress) -> Entry:
    from core.errors import MorphError
    from core.morph.scene import solve_span, timed_span_of
    from core.morph.soundness import check_span

    timed = timed_span_of(layer, index)
    entry: Entry = {"layer": layer.name, "frames": [timed.first, timed.last], "sound": False}
    start = perf_counter()
    try:
        morph = solve_span(timed.span, progress)
    except MorphError as error:
        return entry | {"error": str(error)}
    solved = perf_counter() - start
    found = check_span(timed.span, morph, timed.frames())
    return entry | {
        "sound": found.sound,
        "one_to_one": found.one_to_one,
        "vertices": len(morph.rest),
        "triangles": len(morph.triangles),
        "folds": [check.folds for check in found.frames],
        "crossings": [check.crossings for check in found.frames],
        "places": {check.frame: check.places.tolist() for check in found.frames if not check.sound},
        "end_errors": {"source": found.source_error, "target": found.target_error},
        "distortion": {
            "mean": _finite(morph.report.distortion_mean),
            "worst": _finite(morph.report.distortion_worst),
        },
        "mirror": morph.report.mirror,
        "repairs": list(map(str, morph.report.repairs)),
        "seconds": {
            "solve": solved,
            "stages": {stage.name: stage.seconds for stage in morph.report.stages},
            "frame": found.seconds_per_frame,
        },
    }


def _lines(path: Path, entries: list[Entry], sound: bool) -> list[str]:
    """Write the report for a reader."""
    if not entries:
        return [f"{path}: nothing moves; no layer has two keyframes."]
    lines = []
    for entry in entries:
        first, last = entry["frames"]
        lines.append(f"{entry['layer']}, frames {first} to {last}")
        if "error" in entry:
            lines.append(f"  not solved  {entry['error']}")
            continue
        errors, seconds = entry["end_errors"], entry["seconds"]
        stages = ", ".join(f"{name} {1000 * t:.0f}" for name, t in seconds["stages"].items())
        lines += [
            f"  mesh        {entry['vertices']} vertices, {entry['triangles']} triangles",
            f"  folds       {_by_frame(entry['folds'], first)}",
            f"  crossings   {_by_frame(entry['crossings'], first)}",
            f"  ends        off by {errors['source']:.1e} and {errors['target']:.1e} of the size",
            *([] if entry["one_to_one"] else ["  map         not one to one"]),
            f"  distortion  {_distortion(**entry['distortion'])}",
            f"  time        {1000 * seconds['solve']:.0f} ms to solve ({stages}),"
            f" {1000 * seconds['frame']:.2f} ms a frame",
            *([f"  note        {MIRROR_NOTE}"] if entry["mirror"] else []),
            *(f"  repaired    {repair}" for repair in entry["repairs"]),
        ]
    return [*lines, f"{path}: {'all frames are sound' if sound else 'NOT SOUND, see above'}."]


def _finite(value: float) -> float | None:
    """JSON knows no infinity."""
    return value if isfinite(value) else None


def _distortion(mean: float | None, worst: float | None) -> str:
    if mean is None or worst is None:
        return "without limit, because triangles fold"
    return f"{mean:.3g} on average, where 1 is rigid; {worst:.3g} at worst"


def _by_frame(counts: list[int], first: int) -> str:
    """Summarise counts: where they are not zero."""
    bad = [f"{count} at frame {frame}" for frame, count in enumerate(counts, first) if count]
    if not bad:
        return "none"
    more = f", and {len(bad) - 5} frames more" if len(bad) > 5 else ""
    return f"in {len(bad)} of {len(counts)} frames: {', '.join(bad[:5])}{more}"
