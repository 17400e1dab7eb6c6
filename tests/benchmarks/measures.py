"""What a sweep measures of one pair: its map, its frames, and other motions beside them.

Lengths are in units of √(source area), and one span lasts one unit of time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from time import perf_counter

import numpy as np
import shapely

import core
from core.model import Recipe
from core.model.recipe import Method
from core.morph.motion.motion import Motion
from core.morph.motion.rigid import Rigid
from core.morph.pipeline import solve_outlines
from core.morph.quality import folds, smallest_angle
from tests.benchmarks.corners import allowed_angle
from tests.benchmarks.drift import Drift
from tests.benchmarks.given_marks import GivenMarks
from tests.benchmarks.pairs import Pair, Rings

OWN = "as rigid as possible"
BESIDE: dict[str, Method] = {"straight paths": "linear", "lengths and angles": "intrinsic"}
"""Motions to compare with, on the same mesh."""
UNSEEN = 5e-4
"""How much a vertex's step may change from frame to frame without anybody seeing it: a quarter of a
pixel on a shape 500 pixels across. Where the plain form changes less, ratios would mean little."""
FAIR_ANGLE = 10.0
"""Degrees that no angle of a mesh should be below."""


@dataclass(frozen=True)
class Row:
    """The figures of one pair."""

    pair: str
    triangles: int
    folds_source: int
    folds_target: int
    certified: bool
    """Whether the map is proved to be one to one."""
    end_error: float
    """How far the first and last frame are from what was drawn, relative to its size."""
    end_jump: float
    """How far the motion's own limits are from the first and last frame, relative to the size."""
    distortion_mean: float
    distortion_worst: float
    angle_source: float
    """The smallest, in degrees."""
    angle_target: float
    angle_allowed: float
    """No mesh has a larger one, because of the outlines' corners."""
    repairs: int
    """Changes to the outlines so that they could be used; without any, ends are exact."""
    tried: int
    mirror: bool
    """Whether a mirrored target was offered."""
    route: str
    ms: float
    """From outlines to finished morph."""
    ms_frame: float
    """Median of all frames."""
    ms_frame_worst: float
    frames: int
    folded_frames: int
    folded_frames_linear: int
    jolt: float
    """Largest change of a vertex's velocity between neighbouring frames."""
    jolt_plain: float
    """The same for the paper's plain form on the same mesh."""
    stages: dict[str, float]
    """The milliseconds of each stage; of the correspondence that was taken."""
    limbs_pass: bool
    """Whether no way round was found for limbs: that is why the boundary crosses, if it does."""
    drifts: dict[str, Drift]
    """Our motion and the others, by name."""
    given: GivenMarks | None = None
    distortion_mirrored: float | None = None
    """The mean distortion of the map to the mirrored target, where that was offered."""

    @property
    def distortion_accepted(self) -> float:
        """The mean distortion for an artist who takes the mirror wherever it is offered."""
        mirrored = self.distortion_mirrored
        return self.distortion_mean if mirrored is None else mirrored

    @property
    def crossing(self) -> tuple[float, ...]:
        """Moments at which our boundary crosses itself."""
        return self.drifts[OWN].crossing

    @property
    def angle_share(self) -> float:
        """The smallest angle at either end over what it should be: 10°, if corners allow that."""
        return min(self.angle_source, self.angle_target) / min(FAIR_ANGLE, self.angle_allowed)

    @property
    def jolt_ratio(self) -> float:
        """How much more abrupt the motion is than the plain form's, or than what can be seen."""
        return self.jolt / max(self.jolt_plain, UNSEEN * (self.frames - 1))

    def record(self) -> dict[str, object]:
        """Return the row as columns of plain values."""
        nested = ("stages", "drifts", "given")
        columns = {f.name: getattr(self, f.name) for f in fields(self) if f.name not in nested}
        columns["jolt_ratio"] = self.jolt_ratio
        for name, drift in self.drifts.items():
            columns |= {f"{name}: {figure}": value for figure, value in drift.record().items()}
        if self.given is not None:
            columns |= self.given.record()
        return columns | {f"ms {stage}": ms for stage, ms in self.stages.items()}


def measure(pair: Pair, frames: int, recipe: Recipe | None = None) -> tuple[Row, core.Morph]:
    """Solve a pair without marks and measure it; raises ``MorphError`` where it is refused."""
    start = perf_counter()
    morph = solve_outlines(pair.source, pair.target, recipe=recipe)
    seconds = perf_counter() - start
    report = morph.report
    times = np.linspace(0, 1, frames)
    motion, frame_seconds = _timed_motion(morph.at, times)
    rest, target = (end - morph.origin for end in (morph.rest, morph.target))
    others = {
        name: np.stack([frame(t) for t in times])
        for name, method in (BESIDE | {"plain": "plain arap"}).items()
        for frame in [Motion.of(method, (rest, target), morph.triangles)]
    }
    plain = others.pop("plain")
    drawn = pair.drawn
    row = Row(
        pair=pair.name,
        triangles=report.triangles,
        folds_source=len(report.folds_source),
        folds_target=len(report.folds_target),
        certified=report.certificate.holds,
        end_error=max(
            end_error(rings, outline(motion[k], morph))
            for k, rings in ((0, drawn[0]), (-1, drawn[1]))
        ),
        end_jump=end_jump(morph),
        distortion_mean=report.distortion_mean,
        distortion_worst=report.distortion_worst,
        angle_source=np.degrees(smallest_angle(motion[0], morph.triangles)),
        angle_target=np.degrees(smallest_angle(motion[-1], morph.triangles)),
        angle_allowed=allowed_angle(*(outline(motion[k], morph) for k in (0, -1))),
        repairs=len(report.repairs),
        tried=report.tried,
        mirror=report.mirror,
        route=" + ".join(stage.name for stage in report.stages),
        ms=1e3 * seconds,
        ms_frame=1e3 * float(np.median(frame_seconds)),
        ms_frame_worst=1e3 * max(frame_seconds),
        frames=frames,
        folded_frames=_folded(motion, morph),
        folded_frames_linear=_folded(others["straight paths"], morph),
        jolt=jolt(motion / morph.unit, times),
        jolt_plain=jolt(plain / morph.unit, times),
        stages={stage.name: 1e3 * stage.seconds for stage in report.stages},
        limbs_pass=isinstance(morph.inbetween.shape, Rigid) and morph.inbetween.shape.limbs_pass,
        drifts={
            name: Drift.of([outline(frame, morph) for frame in positions], times)
            for name, positions in ({OWN: motion} | others).items()
        },
    )
    return row, morph


def outline(positions: np.ndarray, morph: core.Morph) -> Rings:
    """Return the boundary of mesh positions (n, 2)."""
    return [positions[ring] for ring in morph.rings]


def end_error(drawn: Rings, found: Rings) -> float:
    """Return how far an end is from the rings that were drawn, relative to their size.

    The larger of: a drawn vertex to the nearest boundary vertex; a boundary vertex to what was
    drawn.
    """
    corners, boundary = (shapely.points(np.concatenate(rings)) for rings in (drawn, found))
    lines = shapely.multilinestrings([shapely.linearrings(ring) for ring in drawn])
    missed = shapely.distance(corners, shapely.multipoints(boundary))
    astray = shapely.distance(boundary, lines)
    return float(max(missed.max(), astray.max()) / np.ptp(drawn[0], axis=0).max())


def end_jump(morph: core.Morph) -> float:
    """Return how far the motion's limits are from what is shown at its ends."""
    jumps = []
    for s, end in ((0.0, morph.rest), (1.0, morph.target)):
        limit = morph.origin + morph.unit * morph.inbetween(s)
        jumps.append(np.abs(limit - end).max() / np.ptp(end, axis=0).max())
    return float(max(jumps))


def jolt(motion: np.ndarray, times: np.ndarray) -> float:
    """Return the largest change of a vertex's velocity between neighbouring frames."""
    velocity = np.diff(motion, axis=0) / np.diff(times)[:, None, None]
    return float(np.linalg.norm(np.diff(velocity, axis=0), axis=2).max())


def _timed_motion(
    frame: Callable[[float], np.ndarray], times: Sequence[float]
) -> tuple[np.ndarray, list[float]]:
    positions, seconds = [], []
    for t in times:
        start = perf_counter()
        positions.append(frame(t))
        seconds.append(perf_counter() - start)
    return np.stack(positions), seconds


def _folded(motion: np.ndarray, morph: core.Morph) -> int:
    return sum(len(folds(frame, morph.triangles)) > 0 for frame in motion)
