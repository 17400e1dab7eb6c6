"""Widgets and timers that nothing reaches any more die in the thread of the window."""

from __future__ import annotations

import gc
import threading
import weakref

from pytestqt.qtbot import QtBot

from app.jobs.collector import Collector
from app.jobs.worker import Worker
from core.progress import Progress


def test_what_a_worker_allocates_frees_nothing_in_its_thread(collector: Collector, qtbot: QtBot):
    died: list[threading.Thread] = []

    class Loop:
        def __init__(self) -> None:
            self.me = self

        def __del__(self) -> None:
            died.append(threading.current_thread())

    def allocate(progress: Progress) -> int:
        return len([[k] for k in range(10 * gc.get_threshold()[0])])

    gc.collect()
    worker = Worker("allocating")
    Loop()
    with qtbot.waitSignal(worker.done):
        worker.start(allocate)
    worker.close()
    gc.collect()
    assert died == [threading.main_thread()]


def test_what_keeps_the_progress_of_its_work_keeps_nothing_of_qts(
    collector: Collector, qtbot: QtBot
):
    kept: list[Progress] = []
    worker = Worker("keeping")
    runner = weakref.ref(worker._runner)
    with qtbot.waitSignal(worker.done):
        worker.start(kept.append)
    worker.close()
    gc.collect()
    assert kept
    assert runner() is None


def test_little_garbage_is_left_alone(collector: Collector):
    gc.collect()
    found: list[str] = []
    gc.callbacks.append(lambda phase, info: found.append(phase))
    collector.collect()
    gc.callbacks.pop()
    assert found == []
