"""A document with something in every field, whose spans are solved as the test says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from app.workspace import Workspace
from core.errors import SolveError
from core.model import Document, Keyframe, Layer, Outline, RingPoint, Style
from core.model.easing import EASE_IN
from core.morph.certificate import Certificate
from core.morph.report import Report, Stage
from core.morph.scene import Span
from core.progress import Progress

SQUARE = Outline.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])
BROKEN = 3.0
"""A keyframe of this scale makes its span unsolvable."""


@dataclass(frozen=True)
class Solution:
    report: Report
    angle: float


REPORT = Report(
    vertices=1234,
    triangles=2345,
    certificate=Certificate(folds=((), (7, 8)), simple=(True, True), bordered=True),
    distortion_mean=1.0625,
    distortion_worst=float("inf"),
    smallest_angle=0.3,
    iterations=(),
    stages=(
        Stage("matching", 0.001, "no rivals tried"),
        Stage("mesh", 0.0115, "3 chords split"),
    ),
    tried=1,
    mirror=False,
    repairs=("Removed 2 repeated points.",),
)


def solve(span: Span, progress: Progress) -> Solution:
    """Solve nothing, at once."""
    if span.target.rings[0].points.max() == 10 * BROKEN:
        raise SolveError("The outlines do not fit.", hint="Draw them anew.")
    return Solution(REPORT, span.turning.angle(0.5))


def a_layer(layer_id: int, *frames: int) -> Layer:
    def key(index: int, frame: int) -> Keyframe:
        outline = SQUARE.transformed(np.eye(2) * (1 + index))
        return Keyframe(frame, outline, (RingPoint(0, 0.5),), EASE_IN)

    keys = tuple(key(i, frame) for i, frame in enumerate(frames))
    return Layer(layer_id, f"layer {layer_id}", keys, ("a",), Style("#aa0000", "#00bb0080", 1.25))


@pytest.fixture
def workspace(open_workspace: Callable[..., Workspace]) -> Workspace:
    layers = (a_layer(1, 1, 13, 25), a_layer(2, 1, 9), a_layer(3, 4))
    return open_workspace(Document(layers, background="#ffeedd"), solve)
