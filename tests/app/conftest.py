"""A workspace to test widgets on, and the rule that no test leaves a thread running."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator

import pytest
from PySide6.QtCore import QObject, QStandardPaths, QThread

from app.document.playhead import Playhead
from app.document.selection import Selection
from app.document.session import Session
from app.jobs import looking
from app.jobs.collector import Collector
from app.jobs.frames import Frames
from app.jobs.inspector import Inspector
from app.jobs.looking import Look
from app.jobs.solver import Solve, Solver
from app.jobs.suggestions import Suggestions
from app.workspace import ViewOptions, Workspace
from core.model import Document
from core.morph.scene import solve_span
from tests.app.eye import Eye

QStandardPaths.setTestModeEnabled(True)


@pytest.fixture(scope="session")
def collector(qapp: QObject) -> Collector:
    """Garbage is collected in the thread of the window, as in the program."""
    return Collector(qapp)


@pytest.fixture(autouse=True)
def no_thread_left_running(collector: Collector) -> Iterator[None]:
    """Fail a test after which a thread is still running."""
    yield
    collector.collect()
    running = [t.objectName() for t in gc.get_objects() if isinstance(t, QThread) and _runs(t)]
    assert not running, f"threads left running: {running}"


def _runs(thread: QThread) -> bool:
    try:
        return thread.isRunning()
    except RuntimeError:  # Qt has deleted it
        return False


@pytest.fixture
def open_workspace(qapp: QObject) -> Iterator[Callable[..., Workspace]]:
    """Open a workspace on a document, with functions to solve and to look of the test's choice."""
    opened: list[Workspace] = []

    def open_it(
        document: Document | None = None, solve: Solve = solve_span, look: Look | None = None
    ) -> Workspace:
        session = Session(document)
        selection, playhead = Selection(session), Playhead(session)
        solver = Solver(session, selection, playhead, solve)
        frames = Frames()
        look = look or (looking.look if solve is solve_span else Eye())
        inspector = Inspector(session, selection, playhead, solver, frames, look)
        view = ViewOptions()
        suggestions = Suggestions(session, selection, playhead, solver, view)
        opened.append(
            Workspace(session, selection, playhead, solver, frames, inspector, view, suggestions)
        )
        return opened[-1]

    yield open_it
    for workspace in opened:
        workspace.suggestions.close()
        workspace.inspector.close()
        workspace.solver.close()
        workspace.session.close()
