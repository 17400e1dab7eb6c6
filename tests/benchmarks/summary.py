"""A sweep in words: medians, extremes, counts, and the worst pairs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np

from tests.benchmarks.measures import Row
from tests.benchmarks.survey import Refused
from tests.benchmarks.worst import complaints, worst

EXACT, ABRUPT = 1e-9, 3.0

Quantity = Callable[[Row], float]

LARGE: dict[str, Quantity] = {
    "triangles": lambda row: row.triangles,
    "end error": lambda row: row.end_error,
    "jump at the ends": lambda row: row.end_jump,
    "SD mean": lambda row: row.distortion_mean,
    "  with mirrors offered": lambda row: row.distortion_accepted,
    "SD worst triangle": lambda row: row.distortion_worst,
    "correspondences tried": lambda row: row.tried,
    "change of velocity": lambda row: row.jolt,
    "  over plain ARAP's": lambda row: row.jolt_ratio,
}
"""Quantities that are better the smaller they are."""
SMALL: dict[str, Quantity] = {
    "smallest angle, source": lambda row: row.angle_source,
    "smallest angle, target": lambda row: row.angle_target,
    "  that corners allow": lambda row: row.angle_allowed,
    "  over 10° or the allowed": lambda row: row.angle_share,
}
"""Quantities that are better the larger they are."""
MILLISECONDS: dict[str, Quantity] = {
    "ms to the morph": lambda row: row.ms,
    "ms a frame": lambda row: row.ms_frame,
    "ms of the worst frame": lambda row: row.ms_frame_worst,
}
GIVEN: dict[str, Quantity] = {
    "marks given": lambda row: row.given.marks,
    "  SD mean": lambda row: row.given.distortion_mean,
    "  ms to the morph": lambda row: row.given.ms,
    "  ms, one mark moved": lambda row: row.given.ms_moved,
}


def summary(rows: Sequence[Row], refused: Sequence[Refused], *, timed: bool = True) -> str:
    """Return the report on measured rows and on pairs that were refused, with the reason."""
    lines = [f"{len(rows) + len(refused)} pairs, {len(refused)} refused"]
    lines += [f"  {each.pair}: {each.reason}" for each in refused]
    if rows:
        lines += ["", *_quantities(rows, timed=timed), "", *_counts(rows), "", *_motions(rows)]
        lines += ["", *_routes(rows), "", *_crossings(rows), *_worst(rows)]
    return "\n".join(lines) + "\n"


def _quantities(rows: Sequence[Row], *, timed: bool) -> Iterator[str]:
    given = [row for row in rows if row.given is not None]
    yield f"{'':<26}{'median':>12}{'95 %':>12}{'max':>12}  worst pair"
    for name, quantity in LARGE.items():
        yield _line(name, rows, quantity, 95, np.argmax)
    for name, quantity in (MILLISECONDS | _stages(rows)).items() if timed else ():
        yield _line(name, rows, quantity, 95, np.argmax)
    for name, quantity in GIVEN.items() if timed and given else ():
        yield _line(name, given, quantity, 95, np.argmax)
    yield f"{'':<26}{'median':>12}{'5 %':>12}{'min':>12}"
    for name, quantity in SMALL.items():
        yield _line(name, rows, quantity, 5, np.argmin)


def _stages(rows: Sequence[Row]) -> dict[str, Quantity]:
    stages = dict.fromkeys(stage for row in rows for stage in row.stages)
    return {f"  {name}": lambda row, name=name: row.stages.get(name, 0.0) for name in stages}


def _line(
    name: str,
    rows: Sequence[Row],
    quantity: Quantity,
    tail: float,
    extreme: Callable[[np.ndarray], np.intp],
) -> str:
    values = np.array([quantity(row) for row in rows])
    at = extreme(values)
    figures = (np.median(values), np.percentile(values, tail), values[at])
    return f"{name:<26}" + "".join(f"{figure:12.4g}" for figure in figures) + f"  {rows[at].pair}"


def _counts(rows: Sequence[Row]) -> Iterator[str]:
    frames = sum(row.frames for row in rows)
    yield _count("pairs with a fold at an end", (_folds(row) for row in rows))
    yield _count("pairs without a certificate", (not row.certified for row in rows))
    yield _count("pairs whose outlines were repaired", (row.repairs for row in rows))
    inexact = (row.end_error > EXACT for row in rows if not row.repairs)
    yield _count("  others with an end off by over 1e-9", inexact)
    yield _count("pairs with a fold in a frame", (row.folded_frames for row in rows))
    yield _count("pairs with a crossing frame", (len(row.crossing) for row in rows))
    yield _count("pairs over 3 x plain's jolt", (row.jolt_ratio > ABRUPT for row in rows))
    yield _count("pairs whose mirror was offered", (row.mirror for row in rows))
    for name, count in {
        "folded frames": sum(row.folded_frames for row in rows),
        "  on straight paths": sum(row.folded_frames_linear for row in rows),
    }.items():
        yield f"{name:<38}{count:6} of {frames} ({count / frames:.2%})"


def _motions(rows: Sequence[Row]) -> Iterator[str]:
    """Compare the motions, one line each."""
    yield (
        f"{'':<22}{'pairs':>7}{'crossing frames':>24}{'in pairs':>10}"
        f"{'area drift':>14}{'95 %':>8}{'perimeter':>12}{'95 %':>8}"
    )
    for name in dict.fromkeys(name for row in rows for name in row.drifts):
        having = [row for row in rows if name in row.drifts]
        drifts = [row.drifts[name] for row in having]
        frames, crossing = sum(row.frames for row in having), [len(d.crossing) for d in drifts]
        share = f"{sum(crossing)} of {frames} = {sum(crossing) / frames:.2%}"
        area = np.percentile([d.area for d in drifts], [50, 95])
        perimeter = np.percentile([d.perimeter for d in drifts], [50, 95])
        yield (
            f"{name:<22}{len(having):7}{share:>24}{sum(map(bool, crossing)):10}"
            f"{area[0]:14.1%}{area[1]:8.1%}{perimeter[0]:12.1%}{perimeter[1]:8.1%}"
        )


def _folds(row: Row) -> int:
    return row.folds_source + row.folds_target


def _count(name: str, hits: Iterable[float]) -> str:
    return f"{name:<38}{sum(map(bool, hits)):6}"


def _routes(rows: Sequence[Row]) -> Iterator[str]:
    for route, count in Counter(row.route for row in rows).most_common():
        yield f"{count:6} by {route}"


def _crossings(rows: Sequence[Row]) -> Iterator[str]:
    crossing = sorted((row for row in rows if row.crossing), key=lambda row: -len(row.crossing))
    if crossing:
        yield "Where the boundary crosses itself:"
        for row in crossing:
            span = f"t {row.crossing[0]:.2f} to {row.crossing[-1]:.2f}"
            linear = len(row.drifts["straight paths"].crossing)
            cause = "no way round was found" if row.limbs_pass else "not kept apart"
            count = f"{len(row.crossing):3} frames"
            yield f"  {row.pair:<36}{count}, {span}: {cause}; straight paths {linear}"
        yield ""


def _worst(rows: Sequence[Row]) -> Iterator[str]:
    yield f"{'The worst pairs':<36}{'SD mean':>9}{'SD worst':>10}{'angle':>8}  what is wrong"
    for row in worst(rows):
        angle = min(row.angle_source, row.angle_target)
        yield (
            f"{row.pair:<36}{row.distortion_mean:9.3f}{row.distortion_worst:10.4g}{angle:7.2f}°"
            f"  {complaints(row)}; {row.tried} tried{', mirror offered' if row.mirror else ''}"
        )
