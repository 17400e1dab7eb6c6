"""A sweep in words: medians, extremes, counts, and the worst pairs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np

from tests.benchmarks.measures import STAGES, Row

WORST = 20
EXACT = 1e-9
ABRUPT = 3.0

Quantity = Callable[[Row], float]

LARGE: dict[str, Quantity] = {
    "triangles": lambda row: row.triangles,
    "end error": lambda row: row.end_error,
    "jump at the ends": lambda row: row.end_jump,
    "SD mean": lambda row: row.distortion_mean,
    "SD worst triangle": lambda row: row.distortion_worst,
    "correspondences tried": lambda row: row.tried,
    "area drift": lambda row: row.area_drift,
    "  of straight paths": lambda row: row.linear_area_drift,
    "change of velocity": lambda row: row.jolt,
    "  over plain ARAP's": lambda row: row.jolt_ratio,
    "ms a frame": lambda row: row.ms_frame,
    "ms of the worst frame": lambda row: row.ms_frame_worst,
    "ms to the morph": lambda row: row.ms,
}
"""Quantities that are better the smaller they are."""
SMALL: dict[str, Quantity] = {
    "smallest angle, source": lambda row: row.angle_source,
    "smallest angle, target": lambda row: row.angle_target,
}
"""Quantities that are better the larger they are."""


def badness(row: Row) -> tuple[int, float]:
    """Return the key by which pairs are ordered, the worst last: folds, then distortion."""
    return row.folds_source + row.folds_target + row.folded_frames, row.distortion_mean


def summary(rows: Sequence[Row], refused: Sequence[tuple[str, str]]) -> str:
    """Return the report on measured rows and on pairs that were refused, with the reason."""
    lines = [f"{len(rows) + len(refused)} pairs, {len(refused)} refused"]
    lines += [f"  {pair}: {reason}" for pair, reason in refused]
    if rows:
        lines += ["", *_quantities(rows), "", *_counts(rows), "", *_routes(rows)]
        lines += ["", *_crossings(rows), *_worst(rows)]
    return "\n".join(lines) + "\n"


def _quantities(rows: Sequence[Row]) -> Iterator[str]:
    yield f"{'':<26}{'median':>12}{'95 %':>12}{'max':>12}  worst pair"
    for name, quantity in LARGE.items():
        yield _line(name, rows, quantity, 95, np.argmax)
    for k, stage in enumerate(STAGES):
        yield _line(f"  {stage}", rows, lambda row, k=k: row.ms_stages[k], 95, np.argmax)
    yield f"{'':<26}{'median':>12}{'5 %':>12}{'min':>12}"
    for name, quantity in SMALL.items():
        yield _line(name, rows, quantity, 5, np.argmin)


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
    yield _count("pairs with an end off by over 1e-9", (row.end_error > EXACT for row in rows))
    yield _count("pairs with a fold in a frame", (row.folded_frames for row in rows))
    yield _count("pairs with a crossing frame", (len(row.crossing) for row in rows))
    yield _count("pairs over 3 x plain's jolt", (row.jolt_ratio > ABRUPT for row in rows))
    yield f"of {frames} frames, ends included:"
    for name, count in {
        "folded": sum(row.folded_frames for row in rows),
        "crossing": sum(len(row.crossing) for row in rows),
        "folded on straight paths": sum(row.linear_folded_frames for row in rows),
        "crossing on straight paths": sum(row.linear_crossing_frames for row in rows),
    }.items():
        yield f"  {name:<34}{count:6} ({count / frames:.2%})"


def _folds(row: Row) -> int:
    return row.folds_source + row.folds_target


def _count(name: str, hits: Iterable[float]) -> str:
    return f"{name:<36}{sum(map(bool, hits)):6}"


def _routes(rows: Sequence[Row]) -> Iterator[str]:
    for route, count in Counter(row.route for row in rows).most_common():
        yield f"{count:6} by {route}"


def _crossings(rows: Sequence[Row]) -> Iterator[str]:
    crossing = sorted((row for row in rows if row.crossing), key=lambda row: -len(row.crossing))
    if crossing:
        yield "Where the boundary crosses itself:"
        for row in crossing:
            span = f"t {row.crossing[0]:.2f} to {row.crossing[-1]:.2f}"
            linear = f"straight paths {row.linear_crossing_frames}"
            yield f"  {row.pair:<36}{len(row.crossing):3} frames, {span}; {linear}"
        yield ""


def _worst(rows: Sequence[Row]) -> Iterator[str]:
    yield f"{'The worst pairs':<36}{'folds':>6}{'SD mean':>9}{'SD worst':>10}{'angle':>8}  route"
    for row in sorted(rows, key=badness, reverse=True)[:WORST]:
        angle = min(row.angle_source, row.angle_target)
        yield (
            f"{row.pair:<36}{_folds(row):6}{row.distortion_mean:9.3f}"
            f"{row.distortion_worst:10.4g}{angle:7.2f}°  {row.route}, {row.tried} tried"
        )
