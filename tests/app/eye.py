"""A check that waits for its gate, and finds crossings in the frames that it is told of."""

from __future__ import annotations

import threading
from collections.abc import Callable

import numpy as np

from app.jobs.looking import Sight, Task
from core.errors import SolveError
from core.morph.scene import TimedSpan
from core.morph.soundness import FrameCheck, SpanCheck
from core.progress import Progress

NOWHERE = np.empty((0, 2))
PLACE = np.array([[3.0, 4.0]])


class Eye:
    """Looks at nothing, and says what the test wants to hear."""

    def __init__(self, *crossing: int) -> None:
        self.seen: list[tuple[TimedSpan, int]] = []
        """Each span that was looked at, and the frame that was the most urgent."""
        self.crossing = set(crossing)
        self.broken = False
        self.one_to_one = True
        self.listen: Callable[[Task], None] = lambda task: None
        self.gate = threading.Event()
        self.gate.set()

    def __call__(self, task: Task, progress: Progress) -> Sight:
        self.seen.append((task.span, task.unseen[0][0]))
        self.listen(task)
        while not self.gate.wait(0.001):
            progress(0.5, "checking")
        if self.broken:
            raise SolveError("The frames could not be looked at.")
        checks = tuple(self._look(k) for k, _ in sorted(task.unseen))
        if task.seen is None:
            return Sight({}, checks, None)
        every = tuple(sorted((*task.seen, *checks), key=lambda check: check.frame))
        return Sight({}, checks, SpanCheck(every, 0.0, 0.0, one_to_one=self.one_to_one))

    def _look(self, frame: int) -> FrameCheck:
        crosses = frame in self.crossing
        return FrameCheck(frame, 0, int(crosses), PLACE if crosses else NOWHERE)
