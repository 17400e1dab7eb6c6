"""A worker's thread, and what comes back from it."""

from __future__ import annotations

import sys
import threading

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt

from app.jobs.worker import Worker, _strays, strays
from core.progress import Progress


def test_what_was_done_but_not_heard_of_when_a_worker_is_closed_is_never_told(qapp: object):
    usual, told, heard = sys.getswitchinterval(), threading.Event(), []
    worker = Worker("late")
    worker.done.connect(lambda *outcome: heard.append(outcome))
    worker._runner.done.connect(lambda *_: told.set(), Qt.ConnectionType.DirectConnection)
    worker.start(lambda progress: None)
    assert told.wait(20)
    worker.close()
    QCoreApplication.processEvents()
    assert heard == []
    assert not worker.busy
    another = Worker("after it")
    another.start(lambda progress: None)
    assert sys.getswitchinterval() < usual
    another.close()
    assert sys.getswitchinterval() == usual


def test_closing_does_not_wait_for_work_that_hears_nothing(monkeypatch: pytest.MonkeyPatch, qapp):
    monkeypatch.setattr("app.jobs.worker.PATIENCE_MS", 20)
    begun, end = threading.Event(), threading.Event()

    def deaf(progress: Progress) -> None:
        begun.set()
        end.wait(20)

    worker = Worker("deaf")
    worker.start(deaf)
    assert begun.wait(20)
    worker.close()
    assert not worker.busy
    assert strays()
    worker.deleteLater()
    QCoreApplication.sendPostedEvents(worker, QEvent.Type.DeferredDelete)
    end.set()
    for thread, _ in _strays:
        assert thread.wait(20_000)
    assert not strays()
