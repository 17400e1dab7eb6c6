"""One long-lived thread that does one piece of work at a time."""

from __future__ import annotations

import logging
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, QThread, QTimer, Signal, Slot

from core.errors import Cancelled, MorphError
from core.progress import Progress

Work = Callable[[Progress], Any]
"""Runs in the thread. It may touch nothing but what it was given, and that must be immutable."""

REPORT_EVERY = 0.03
"""Seconds between two progress reports of the same stage."""
SHARE_EVERY, SHARE = 12, 0.001
"""Milliseconds between the turns that the UI thread gives to the work, and seconds of each."""
SWITCH_SECONDS = 0.0005
"""How often the interpreter lock changes hands meanwhile; the default makes frames stutter."""
STACK = 16 * 2**20
"""Bytes: the mesher recurses deeper than the default stack of a thread allows on some systems."""

PATIENCE_MS = 3000
"""Milliseconds that the end of a thread is waited for."""

log = logging.getLogger(__name__)
_strays: list[tuple[QThread, QObject]] = []
"""Threads that did not end in time, with what lives in them: both must outlast them."""


def strays() -> bool:
    """Return whether a thread goes on after its worker was closed; the process must not wait."""
    return any(thread.isRunning() for thread, _ in _strays)


class Worker(QObject):
    """Runs work off the UI thread. It belongs to the UI thread, and emits only there."""

    done = Signal(int, object)
    """Job number, and what the work returned, or the MorphError or Cancelled that it raised."""
    progressed = Signal(float, str)
    """Fraction and stage of the work under way."""

    _posted = Signal(object)

    def __init__(self, name: str, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._number = 0
        self._job: _Job | None = None
        self._thread = QThread(self, objectName=name)
        self._thread.setStackSize(STACK)
        self._runner: _Runner | None = _Runner()
        self._runner.moveToThread(self._thread)
        self._posted.connect(self._runner.run, Qt.ConnectionType.QueuedConnection)
        self._runner.done.connect(self._on_done, Qt.ConnectionType.QueuedConnection)
        self._runner.progressed.connect(self._on_progressed, Qt.ConnectionType.QueuedConnection)
        self._thread.start()
        self._turns = QTimer(self, interval=SHARE_EVERY)
        self._turns.timeout.connect(_give_way)

    @property
    def busy(self) -> bool:
        """Whether work is under way, cancelled work that has not stopped yet included."""
        return self._job is not None

    @property
    def closed(self) -> bool:
        """Whether ``close`` was called."""
        return self._runner is None

    def start(self, work: Work) -> int:
        """Start work and return its job number; only when not busy."""
        assert not self.busy, "one piece of work at a time"
        self._number += 1
        self._job = _Job(self._number, work)
        self._turns.start()
        _haste.begin()
        self._posted.emit(self._job)
        return self._number

    def cancel(self) -> None:
        """Ask the work under way to stop; ``done`` then brings ``Cancelled``, or its result."""
        if self._job:
            self._job.stop.set()

    def close(self) -> None:
        """Stop the work and end the thread; nothing is emitted any more.

        Work that hears nothing of being stopped is left to itself after a while.
        """
        if self._runner is None:
            return
        self.cancel()
        self._runner.done.disconnect(self._on_done)
        self._runner.progressed.disconnect(self._on_progressed)
        self._thread.quit()
        if not self._thread.wait(PATIENCE_MS):
            log.error("%s does not end", self._thread.objectName())
            self._thread.setParent(None)
            _strays.append((self._thread, self._runner))
        if self._job:
            self._end()
        self._runner = None

    @Slot(int, object)
    def _on_done(self, number: int, outcome: object) -> None:
        if self._job is None or number != self._job.number:
            return  # it was queued before the worker was closed: to disconnect does not recall it
        self._end()
        self.done.emit(number, outcome)

    def _end(self) -> None:
        self._job = None
        self._turns.stop()
        _haste.end()

    @Slot(float, str)
    def _on_progressed(self, fraction: float, stage: str) -> None:
        if self._job and not self._job.stop.is_set():
            self.progressed.emit(fraction, stage)


class _Haste:
    """Makes the interpreter lock change hands more often while any worker is at work."""

    def __init__(self) -> None:
        self._working, self._usual = 0, 0.0

    def begin(self) -> None:
        if self._working == 0:
            self._usual = sys.getswitchinterval()
            sys.setswitchinterval(SWITCH_SECONDS)
        self._working += 1

    def end(self) -> None:
        self._working -= 1
        if self._working == 0:
            sys.setswitchinterval(self._usual)


_haste = _Haste()


def _give_way() -> None:
    """Let go of the interpreter lock: loops that wait in C++ (QTest.qWait is one) may hold it."""
    time.sleep(SHARE)


class _Job:
    def __init__(self, number: int, work: Work) -> None:
        self.number, self.work = number, work
        self.stop = threading.Event()


class _Report:
    """Tells of the progress of work while it lasts; whoever keeps it keeps nothing of Qt's."""

    def __init__(self, stop: threading.Event, tell: Callable[[float, str], object]) -> None:
        self._stop, self._last = stop, (-REPORT_EVERY, "")
        self._tell: Callable[[float, str], object] | None = tell

    def __call__(self, fraction: float, stage: str) -> None:
        if self._stop.is_set():
            raise Cancelled
        now, (then, before) = time.monotonic(), self._last
        if self._tell is not None and (stage != before or now >= then + REPORT_EVERY):
            self._last = now, stage
            self._tell(fraction, stage)

    def end(self) -> None:
        """Tell no more."""
        self._tell = None


class _Runner(QObject):
    """The half that lives in the thread."""

    done = Signal(int, object)
    progressed = Signal(float, str)

    @Slot(object)
    def run(self, job: _Job) -> None:
        """Do the work of a job."""
        report = _Report(job.stop, self.progressed.emit)
        try:
            report(0.0, "")
            outcome = job.work(report)
        except (Cancelled, MorphError) as reason:
            outcome = reason.with_traceback(None)  # which would keep all that the work had in hand
        except Exception as fault:
            log.exception("Work in the background failed")
            outcome = MorphError(
                f"The program failed at this ({type(fault).__name__}: {fault}).",
                hint="Nothing of yours is lost. Undo the last change, or save and report it.",
            )
        report.end()
        self.done.emit(job.number, outcome)
