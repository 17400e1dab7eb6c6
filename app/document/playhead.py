"""Where in time the artist is, and playing. Not undoable."""

from __future__ import annotations

import time
from collections.abc import Callable
from enum import Enum
from math import ceil, floor

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from app.document.session import Session

FIRST_FRAME = 1
"""Time begins here, unless a keyframe lies before it."""
ROUNDING = 1e-6
"""Frames: the clock may fall short of a whole frame by this much."""


class Loop(Enum):
    """What happens at the end of the playback range."""

    ONCE = "once"
    LOOP = "loop"
    PING_PONG = "ping-pong"


class Playhead(QObject):
    """The current frame (a float: the space between frames can be scrubbed) and the player."""

    moved = Signal(float)
    playing_changed = Signal(bool)
    range_changed = Signal()
    loop_changed = Signal()

    def __init__(
        self,
        session: Session,
        parent: QObject | None = None,
        *,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        super().__init__(parent)
        self._session = session
        self._frame = float(session.document.frames[0])
        self._range: tuple[int, int] | None = None
        self._loop = Loop.LOOP
        self._playing = False
        self._now = now
        self._started = 0.0
        self._start = 0.0
        self._pace: tuple[float, tuple[int, int]] = (0.0, (0, 0))
        self._timer = QTimer(self, singleShot=True, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._tick)
        session.changed.connect(self._keep_pace)
        session.replaced.connect(self._reset)

    @property
    def frame(self) -> float:
        """The current frame."""
        return self._frame

    @property
    def playing(self) -> bool:
        """Whether it is playing."""
        return self._playing

    @property
    def loop(self) -> Loop:
        """What happens at the end of the range."""
        return self._loop

    @property
    def range(self) -> tuple[int, int]:
        """First and last frame of playback: the artist's range, or all keyframes."""
        return self._range or self._session.document.frames

    @property
    def limited(self) -> bool:
        """Whether the artist has set a range."""
        return self._range is not None

    @property
    def lowest(self) -> int:
        """The first frame there is."""
        return min(FIRST_FRAME, self._session.document.frames[0])

    def set_range(self, frames: tuple[int, int] | None) -> None:
        """Limit playback to frames (first, last), in either order; None plays everything."""
        if frames is not None:
            frames = (max(min(frames), self.lowest), max(*frames, self.lowest))
        if frames != self._range:
            self._range = frames
            self._keep_pace()
            self.range_changed.emit()

    def set_loop(self, loop: Loop) -> None:
        """Set what happens at the end of the range."""
        if loop is not self._loop:
            self._loop = loop
            self._start_clock(self._frame)
            self.loop_changed.emit()

    # -- moving --------------------------------------------------------------------------------

    def move_to(self, frame: float) -> None:
        """Go to a frame, or the first one there is; playing goes on from there."""
        frame = max(float(frame), float(self.lowest))
        self._start_clock(frame)
        self._set(frame)

    def step(self, frames: int) -> None:
        """Stop, and go so many whole frames on, or back if negative."""
        self.stop()
        self.move_to((floor if frames > 0 else ceil)(self._frame) + frames)

    def step_key(self, direction: int) -> None:
        """Stop, and go to the next keyframe of any visible layer, or the last one before."""
        self.stop()
        frames = {
            key.frame
            for layer in self._session.document.layers
            if layer.visible
            for key in layer.keyframes
        }
        if direction > 0:
            self.move_to(min((f for f in frames if f > self._frame), default=self._frame))
        else:
            self.move_to(max((f for f in frames if f < self._frame), default=self._frame))

    def to_start(self) -> None:
        """Go to the first frame of the range."""
        self.move_to(self.range[0])

    def to_end(self) -> None:
        """Stop, and go to the last frame of the range."""
        self.stop()
        self.move_to(self.range[1])

    # -- playing -------------------------------------------------------------------------------

    def play(self, *, from_start: bool = False) -> None:
        """Start playing."""
        first, last = self.range
        at_end = self._loop is Loop.ONCE and self._frame >= last
        inside = first <= self._frame <= last
        if from_start or at_end or not inside:
            self._set(float(first))
        self._start_clock(self._frame)
        if not self._playing:
            self._playing = True
            self.playing_changed.emit(True)
        self._wait_for_next()

    def stop(self) -> None:
        """Stop playing."""
        if self._playing:
            self._playing = False
            self._timer.stop()
            self.playing_changed.emit(False)

    def toggle(self) -> None:
        """Play or stop."""
        if self._playing:
            self.stop()
        else:
            self.play()

    def _start_clock(self, frame: float) -> None:
        self._start, self._started = frame, self._now()
        self._pace = (self._session.document.fps, self.range)

    def _keep_pace(self) -> None:
        """Go on from the frame that is shown when the frame rate or the range is another one."""
        if self._playing and self._pace != (self._session.document.fps, self.range):
            self._start_clock(self._frame)
            self._wait_for_next()

    def _elapsed(self) -> float:
        """Frames since the clock was started."""
        return (self._now() - self._started) * self._pace[0] + ROUNDING

    def _wait_for_next(self) -> None:
        """Wake when the next frame is due, so that rounded intervals do not add up."""
        elapsed = self._elapsed()
        self._timer.start(max(ceil(1000 * (floor(elapsed) + 1 - elapsed) / self._pace[0]), 0))

    def _tick(self) -> None:
        """Show the frame that is due by the clock, so that a slow paint drops frames, not time."""
        first, last = self.range
        count = last - first + 1
        due = floor(self._start) - first + floor(self._elapsed())
        if self._loop is Loop.ONCE and due >= count - 1:
            self._set(float(last))
            self.stop()
            return
        if self._loop is Loop.PING_PONG and count > 1:
            back = due % (2 * (count - 1))
            due = min(back, 2 * (count - 1) - back)
        self._set(float(first + due % count))
        if self._playing:  # whoever was told of the move may have stopped it
            self._wait_for_next()

    def _set(self, frame: float) -> None:
        if frame != self._frame:
            self._frame = frame
            self.moved.emit(frame)

    def _reset(self) -> None:
        self.stop()
        self.set_range(None)
        self._set(float(self.range[0]))
