"""A check that waits for its gate, and finds crossings in the frames that it is told of."""

from __future__ import annotations

import threading

import numpy as np

from core.errors import SolveError
from core.morph.scene import TimedSpan
from core.morph.soundness import FrameCheck, SpanCheck
from core.progress import Progress

NOWHERE = np.empty((0, 2))
PLACE = np.array([[3.0, 4.0]])


class Eye:
    """Looks at nothing, and says what the test wants to hear."""

    def __init__(self, *crossing: int) -> None:
        self.seen: list[tuple[TimedSpan, float]] = []
        self.crossing = set(crossing)
        self.broken = False
        self.gate = threading.Event()
        self.gate.set()

    def __call__(
        self, span: TimedSpan, morph: object, frame: float, progress: Progress
    ) -> SpanCheck:
        self.seen.append((span, frame))
        while not self.gate.wait(0.001):
            progress(0.5, "checking")
        if self.broken:
            raise SolveError("The frames could not be looked at.")
        return SpanCheck(tuple(self._look(k) for k, _ in span.frames()), 0.0, 0.0, 0.0)

    def _look(self, frame: int) -> FrameCheck:
        crosses = frame in self.crossing
        return FrameCheck(frame, 0, int(crosses), PLACE if crosses else NOWHERE)
