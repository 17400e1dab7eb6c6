"""Where in time the artist is, and playing. Not undoable."""

from __future__ import annotations

from enum import Enum

from PySide6.QtCore import QElapsedTimer, QObject, Qt, QTimer, Signal

from app.document.session import Session


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

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._frame = float(session.document.frames[0])
        self._range: tuple[int, int] | None = None
        self._start = 0.0
        self._clock = QElapsedTimer()
        self._timer = QTimer(self, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._tick)
        self.loop = Loop.LOOP
        session.replaced.connect(self._reset)

    @property
    def frame(self) -> float:
        """The current frame."""
        return self._frame

    @property
    def playing(self) -> bool:
        """Whether it is playing."""
        return self._timer.isActive()

    @property
    def range(self) -> tuple[int, int]:
        """First and last frame of playback: the artist's range, or all keyframes."""
        return self._range or self._session.document.frames

    def set_range(self, frames: tuple[int, int] | None) -> None:
        """Limit playback to frames (first, last); None plays everything."""
        if frames != self._range:
            self._range = frames
            self.range_changed.emit()

    def move_to(self, frame: float) -> None:
        """Go to a frame; playing goes on from there."""
        self._start_clock(frame)
        self._set(frame)

    def play(self, *, from_start: bool = False) -> None:
        """Start playing."""
        first, last = self.range
        at_end = self.loop is Loop.ONCE and self._frame >= last
        inside = first <= self._frame <= last
        self._start_clock(first if from_start or at_end or not inside else self._frame)
        if not self.playing:
            self._timer.start(round(1000 / self._session.document.fps))
            self.playing_changed.emit(True)

    def stop(self) -> None:
        """Stop playing."""
        if self.playing:
            self._timer.stop()
            self.playing_changed.emit(False)

    def toggle(self) -> None:
        """Play or stop."""
        if self.playing:
            self.stop()
        else:
            self.play()

    def _start_clock(self, frame: float) -> None:
        self._start = frame
        self._clock.start()

    def _tick(self) -> None:
        """Show the frame that is due by the clock, so that a slow paint drops frames, not time."""
        fps = self._session.document.fps
        self._timer.setInterval(round(1000 / fps))
        first, last = self.range
        due = self._start - first + int(self._clock.elapsed() * fps / 1000)
        count = last - first + 1
        if self.loop is Loop.ONCE and due >= count - 1:
            self._set(float(last))
            self.stop()
        elif self.loop is Loop.PING_PONG and count > 1:
            back = int(due) % (2 * (count - 1))
            self._set(float(first + min(back, 2 * (count - 1) - back)))
        else:
            self._set(float(first + int(due) % count))

    def _set(self, frame: float) -> None:
        if frame != self._frame:
            self._frame = frame
            self.moved.emit(frame)

    def _reset(self) -> None:
        self.stop()
        self._range = None
        self._set(float(self.range[0]))
