"""A worker's thread, and what comes back from it."""

from __future__ import annotations

import sys
import threading

from PySide6.QtCore import QCoreApplication, Qt

from app.jobs.worker import Worker


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
