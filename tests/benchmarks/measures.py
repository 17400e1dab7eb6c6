"""What a sweep measures of one pair: its map, its frames, and straight paths beside them.

Lengths are in units of √(source area), and one span lasts one unit of time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from time import perf_counter

import numpy as np
from scipy.spatial import cKDTree
from shapely import LinearRing, distance
from shapely import points as shapely_points

import core
from core.geometry.polyline import signed_area
from core.morph.motion.motion import Motion
from core.morph.quality import crosses_itself, folds, smallest_angle
from tests.benchmarks.pairs import Pair

STAGES = (
    "outlines",
    "matching",
    "mesh",
    "placement",
    "joint mesh",
    "clean-up",
    "angles",
    "in-between",
)
SLOWEST_PLAIN = 1e-6
"""A change of velocity that nobody sees: below it, ratios would compare rounding."""


@dataclass(frozen=True)
class Row:
    """The figures of one pair."""

    pair: str
    triangles: int
    folds_source: int
    folds_target: int
    end_error: float
    """How far the first and last frame are from what was drawn, relative to its size."""
    end_jump: float
    """How far the motion's own limits are from the first and last frame, relative to the size."""
    distortion_mean: float
    distortion_worst: float
    angle_source: float
    """The smallest, in degrees."""
    angle_target: float
    tried: int
    route: str
    ms: float
    """From outlines to finished morph."""
    ms_stages: tuple[float, ...]
    """The taken correspondence's share of them, by ``STAGES``."""
    ms_frame: float
    """Median of all frames."""
    ms_frame_worst: float
    frames: int
    folded_frames: int
    crossing: tuple[float, ...]
    """Moments at which the boundary crosses itself."""
    area_drift: float
    """Largest relative deviation of a frame's area from a steady change."""
    jolt: float
    """Largest change of a vertex's velocity between neighbouring frames."""
    jolt_plain: float
    """The same for the paper's plain form on the same mesh."""
    linear_folded_frames: int
    linear_crossing_frames: int
    linear_area_drift: float

    @property
    def jolt_ratio(self) -> float:
        """How much more abrupt the motion is than the plain form's."""
        return self.jolt / max(self.jolt_plain, SLOWEST_PLAIN)

    def record(self) -> dict[str, object]:
        """Return the row as columns of plain values."""
        columns = {field.name: getattr(self, field.name) for field in fields(self)}
        del columns["ms_stages"]
        for stage, ms in zip(STAGES, self.ms_stages, strict=True):
            columns["ms_" + stage.replace(" ", "_")] = ms
        columns["crossing_frames"] = len(self.crossing)
        columns["crossing"] = " ".join(f"{t:.3f}" for t in self.crossing)
        columns["jolt_ratio"] = self.jolt_ratio
        return columns


def measure(pair: Pair, frames: int) -> tuple[Row, core.Morph]:
    """Solve a pair without marks and measure it; raises ``MorphError`` where it is refused."""
    start = perf_counter()
    morph = core.solve(pair.source, pair.target)
    seconds = perf_counter() - start
    report = morph.report
    milliseconds = {stage.name: 1e3 * stage.seconds for stage in report.stages}
    rest, target = ((end - morph.origin) / morph.unit for end in (morph.rest, morph.target))
    times = np.linspace(0, 1, frames)
    motion, frame_seconds = _timed_motion(morph.at, times)
    straight, plain = (
        _motion(Motion.of(method, (rest, target), morph.triangles), times)
        for method in ("linear", "plain arap")
    )
    return (
        Row(
            pair=pair.name,
            triangles=report.triangles,
            folds_source=len(report.folds_source),
            folds_target=len(report.folds_target),
            end_error=max(
                end_error(pair.source, motion[0], morph.rings),
                end_error(pair.target, motion[-1], morph.rings),
            ),
            end_jump=max(
                float(np.abs(morph.inbetween(s) - end).max() / np.ptp(end, axis=0).max())
                for s, end in ((0.0, rest), (1.0, target))
            ),
            distortion_mean=report.distortion_mean,
            distortion_worst=report.distortion_worst,
            angle_source=np.degrees(smallest_angle(motion[0], morph.triangles)),
            angle_target=np.degrees(smallest_angle(motion[-1], morph.triangles)),
            tried=report.tried,
            route=" + ".join(stage.name for stage in report.stages),
            ms=1e3 * seconds,
            ms_stages=tuple(milliseconds.get(stage, 0.0) for stage in STAGES),
            ms_frame=1e3 * float(np.median(frame_seconds)),
            ms_frame_worst=1e3 * max(frame_seconds),
            frames=frames,
            folded_frames=_folded(motion, morph),
            crossing=tuple(times[_crossing(motion, morph)].tolist()),
            area_drift=area_drift(motion, times, morph.rings),
            jolt=jolt(motion / morph.unit, times),
            jolt_plain=jolt(plain, times),
            linear_folded_frames=_folded(straight, morph),
            linear_crossing_frames=len(_crossing(straight, morph)),
            linear_area_drift=area_drift(straight, times, morph.rings),
        ),
        morph,
    )


def end_error(drawn: np.ndarray, positions: np.ndarray, rings: Sequence[np.ndarray]) -> float:
    """Return how far an end is from the polygon (n, 2) that was drawn, relative to its size.

    The larger of: a drawn vertex to the nearest boundary vertex; a boundary vertex to the polygon.
    """
    boundary = positions[np.concatenate(rings)]
    missed, _ = cKDTree(boundary).query(drawn)
    astray = distance(LinearRing(drawn), shapely_points(boundary))
    return float(max(missed.max(), astray.max()) / np.ptp(drawn, axis=0).max())


def area_drift(motion: np.ndarray, times: np.ndarray, rings: Sequence[np.ndarray]) -> float:
    """Return the largest relative deviation of the area from a steady change between the ends."""
    areas = np.array([sum(signed_area(frame[ring]) for ring in rings) for frame in motion])
    steady = (1 - times) * areas[0] + times * areas[-1]
    return float(np.abs(areas / steady - 1).max())


def jolt(motion: np.ndarray, times: np.ndarray) -> float:
    """Return the largest change of a vertex's velocity between neighbouring frames."""
    velocity = np.diff(motion, axis=0) / np.diff(times)[:, None, None]
    return float(np.linalg.norm(np.diff(velocity, axis=0), axis=2).max())


def _motion(frame: Callable[[float], np.ndarray], times: np.ndarray) -> np.ndarray:
    return np.stack([frame(t) for t in times])


def _timed_motion(
    frame: Callable[[float], np.ndarray], times: np.ndarray
) -> tuple[np.ndarray, list[float]]:
    seconds = []

    def timed(t: float) -> np.ndarray:
        start = perf_counter()
        positions = frame(t)
        seconds.append(perf_counter() - start)
        return positions

    return _motion(timed, times), seconds


def _folded(motion: np.ndarray, morph: core.Morph) -> int:
    return sum(len(folds(frame, morph.triangles)) > 0 for frame in motion)


def _crossing(motion: np.ndarray, morph: core.Morph) -> list[int]:
    return [
        k for k, frame in enumerate(motion) if crosses_itself([frame[ring] for ring in morph.rings])
    ]
