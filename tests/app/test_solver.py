"""The solver keeps up with the artist: newest wins, nothing stale passes for exact."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QThread
from pytestqt.qtbot import QtBot

from app.jobs.solver import REMEMBERED, SpanState
from app.workspace import Workspace
from core.errors import SolveError
from core.model import Document, Keyframe, Layer, Outline
from core.model.edits import insert_keyframe, move_nodes, remove_keyframe, update_layer
from core.morph.scene import Span, span_of
from core.progress import Progress

SQUARE = Outline.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])


class Bench:
    """A solve function that finishes when the test lets it."""

    def __init__(self) -> None:
        self.started: list[Span] = []
        self.threads: set[int] = set()
        self.gate = threading.Event()
        self.passed: set[Span] = set()
        self.broken: set[Span] = set()
        self.gate.set()

    def __call__(self, span: Span, progress: Progress) -> object:
        self.threads.add(threading.get_ident())
        self.started.append(span)
        while not (self.gate.wait(0.001) or span in self.passed):
            progress(0.5, "Placing")
        if span in self.broken:
            raise SolveError("This cannot be solved.")
        return Solution(span)


class Solution:
    def __init__(self, span: Span) -> None:
        self.span = span


def document(*layers: tuple[int, int]) -> Document:
    """A document with one layer for each (id, number of keyframes)."""

    def keyframe(layer: int, index: int) -> Keyframe:
        return Keyframe(1 + 12 * index, SQUARE.transformed(np.eye(2) * (1 + index), (layer, 0)))

    return Document(
        tuple(
            Layer(layer, f"layer {layer}", tuple(keyframe(layer, i) for i in range(keys)))
            for layer, keys in layers
        )
    )


def span(workspace: Workspace, layer: int = 1, index: int = 0) -> Span:
    return span_of(workspace.session.document.layer(layer), index)


def nudge(workspace: Workspace, layer: int = 1, key: int = 1) -> None:
    workspace.session.apply("Move", move_nodes, layer, key, 0, [0], (-0.25, 0))


@pytest.fixture
def bench() -> Bench:
    return Bench()


@pytest.fixture
def workspace(open_workspace: Callable[..., Workspace], bench: Bench) -> Workspace:
    return open_workspace(document((1, 2)), bench)


@pytest.fixture
def held(open_workspace: Callable[..., Workspace], bench: Bench) -> Workspace:
    """A workspace whose first job waits for the gate."""
    bench.gate.clear()
    return open_workspace(document((1, 2)), bench)


def solved(workspace: Workspace, layer: int = 1, index: int = 0) -> Callable[[], bool]:
    return lambda: workspace.solver.state(layer, index) is SpanState.SOLVED


def test_an_edit_is_solved_in_one_other_thread_and_shown_when_done(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(solved(workspace))
    nudge(workspace)
    assert workspace.solver.state(1, 0) is SpanState.SOLVING
    with qtbot.waitSignal(workspace.solver.updated):
        pass
    assert workspace.solver.morph_of(span(workspace)).span == span(workspace)
    assert workspace.solver.state(1, 0) is SpanState.SOLVED
    assert len(bench.threads) == 1
    assert threading.get_ident() not in bench.threads


def test_the_last_good_solution_stays_until_the_new_one_is_there(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(solved(workspace))
    before = span(workspace)
    bench.gate.clear()
    nudge(workspace)
    assert workspace.solver.morph_of(span(workspace)).span == before
    bench.gate.set()
    qtbot.waitUntil(solved(workspace))
    assert workspace.solver.morph_of(span(workspace)).span == span(workspace)


def test_the_newest_edit_wins_and_those_in_between_are_never_solved(
    held: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: len(bench.started) == 1)
    for _ in range(20):
        nudge(held)
    bench.gate.set()
    qtbot.waitUntil(solved(held))
    assert bench.started[-1] == span(held)
    assert len(bench.started) <= 2


def test_something_moves_while_dragging_though_every_job_comes_too_late(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(solved(workspace))
    bench.gate.clear()
    nudge(workspace)
    late = span(workspace)
    nudge(workspace)
    bench.passed.add(late)
    qtbot.waitUntil(lambda: workspace.solver.morph_of(span(workspace)).span == late)
    assert workspace.solver.state(1, 0) is SpanState.SOLVING


def test_an_obsolete_job_is_cancelled_when_the_artist_pauses(
    held: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: len(bench.started) == 1)
    nudge(held)
    bench.passed.add(span(held))
    qtbot.waitUntil(solved(held))
    assert len(bench.started) == 2


def test_undo_and_redo_show_known_solutions_without_solving(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(solved(workspace))
    nudge(workspace)
    qtbot.waitUntil(solved(workspace))
    count = len(bench.started)
    for step in (workspace.session.undo, workspace.session.redo):
        step()
        assert workspace.solver.state(1, 0) is SpanState.SOLVED
        assert workspace.solver.morph_of(span(workspace)).span == span(workspace)
        assert not workspace.solver.busy
    assert len(bench.started) == count


def test_a_change_of_colour_or_name_solves_nothing(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(solved(workspace))
    workspace.session.apply("Rename", update_layer, 1, name="fin")
    assert workspace.solver.state(1, 0) is SpanState.SOLVED
    assert len(bench.started) == 1


def test_the_span_under_the_playhead_comes_first_then_its_layer_then_the_others(
    open_workspace: Callable[..., Workspace], bench: Bench, qtbot: QtBot
) -> None:
    bench.gate.clear()
    workspace = open_workspace(document((1, 2), (2, 4)), bench)
    workspace.playhead.move_to(30)
    nudge(workspace, 2, 1)  # changes spans 0 and 1, so that span 0 is not started with
    bench.gate.set()
    qtbot.waitUntil(lambda: not workspace.solver.busy)
    order = [(2, 2), (2, 0), (2, 1), (1, 0)]
    assert bench.started[-4:] == [span(workspace, *key) for key in order]


def test_hidden_layers_are_not_solved_and_shown_ones_are(
    open_workspace: Callable[..., Workspace], bench: Bench, qtbot: QtBot
) -> None:
    workspace = open_workspace(document((1, 2), (2, 2)), bench)
    workspace.session.apply("Hide", update_layer, 1, visible=False)
    qtbot.waitUntil(lambda: not workspace.solver.busy)
    assert span(workspace, 1) not in bench.started
    assert workspace.solver.state(1, 0) is SpanState.NONE
    workspace.session.apply("Show", update_layer, 1, visible=True)
    qtbot.waitUntil(solved(workspace, 1))


def test_an_error_is_told_once_kept_by_span_and_cleared_when_solved(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(solved(workspace))
    good = span(workspace)
    told: list[object] = []
    workspace.solver.failed.connect(told.append)
    bench.gate.clear()
    nudge(workspace)
    bench.broken.add(span(workspace))
    bench.gate.set()
    qtbot.waitUntil(lambda: workspace.solver.state(1, 0) is SpanState.FAILED)
    assert told == [workspace.solver.errors[1, 0]]
    assert workspace.solver.morph_of(span(workspace)).span == good
    bench.gate.clear()
    nudge(workspace)
    assert workspace.solver.errors  # until the new one is known to be sound
    bench.gate.set()
    qtbot.waitUntil(solved(workspace))
    assert not workspace.solver.errors


def test_a_fault_in_the_solver_is_told_as_an_error_and_the_next_edit_is_solved(
    open_workspace: Callable[..., Workspace], qtbot: QtBot
) -> None:
    faults = iter([ZeroDivisionError("a fault of ours")])

    def solve(span: Span, progress: Progress) -> object:
        for fault in faults:
            raise fault
        return Solution(span)

    workspace = open_workspace(document((1, 2)), solve)
    with qtbot.waitSignal(workspace.solver.failed) as failed:
        pass
    assert "a fault of ours" in failed.args[0].what
    nudge(workspace)
    qtbot.waitUntil(solved(workspace))


def test_cancel_stops_until_the_next_edit_or_until_asked(
    held: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: len(bench.started) == 1)
    held.solver.cancel()
    qtbot.waitUntil(lambda: not held.solver.busy)
    assert held.solver.state(1, 0) is SpanState.NONE
    held.solver.resume()
    assert held.solver.state(1, 0) is SpanState.SOLVING
    bench.gate.set()
    qtbot.waitUntil(solved(held))


def test_what_failed_can_be_tried_again(workspace: Workspace, bench: Bench, qtbot: QtBot) -> None:
    bench.gate.clear()
    nudge(workspace)
    bench.broken.add(span(workspace))
    bench.gate.set()
    qtbot.waitUntil(lambda: workspace.solver.state(1, 0) is SpanState.FAILED)
    bench.broken.clear()
    workspace.solver.resume()
    qtbot.waitUntil(solved(workspace))
    assert not workspace.solver.errors


def test_progress_names_the_stage(workspace: Workspace, bench: Bench, qtbot: QtBot) -> None:
    bench.gate.clear()
    with qtbot.waitSignal(
        workspace.solver.progress, check_params_cb=lambda done, stage: stage == "Placing"
    ) as progress:
        nudge(workspace)
    assert progress.args == [0.5, "Placing"]


def test_busy_is_told_once_for_a_run_of_jobs(
    open_workspace: Callable[..., Workspace], bench: Bench, qtbot: QtBot
) -> None:
    bench.gate.clear()
    workspace = open_workspace(document((1, 4), (2, 4)), bench)
    told: list[bool] = []
    workspace.solver.busy_changed.connect(told.append)
    bench.gate.set()
    qtbot.waitUntil(lambda: not workspace.solver.busy)
    assert told == [False]


def test_another_document_never_shows_solutions_of_the_last_one(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(solved(workspace))
    bench.gate.clear()
    nudge(workspace)
    late = span(workspace)
    qtbot.waitUntil(lambda: late in bench.started)
    workspace.session.replace(move_nodes(document((1, 3)), 1, 1, 0, [0, 1], (1, 0)))
    assert workspace.solver.morph_of(span(workspace)) is None
    bench.passed.add(late)
    qtbot.waitUntil(lambda: bench.started[-1] == span(workspace))
    assert workspace.solver.morph_of(span(workspace)) is None


def test_places_change_hands_when_a_key_is_inserted_so_no_last_solution_stays_in_them(
    open_workspace: Callable[..., Workspace], bench: Bench, qtbot: QtBot
) -> None:
    workspace = open_workspace(document((1, 3)), bench)
    qtbot.waitUntil(lambda: not workspace.solver.busy)
    bench.gate.clear()
    between = Keyframe(7, SQUARE.transformed(np.eye(2) * 1.5))
    workspace.session.apply("Insert", insert_keyframe, 1, between)
    for index in (0, 1):  # else span 1 would show what was solved for the one that is span 2 now
        assert workspace.solver.morph_of(span(workspace, 1, index)) is None
    assert workspace.solver.state(1, 2) is SpanState.SOLVED
    qtbot.waitUntil(lambda: bench.started[-1] == span(workspace))
    late = bench.started[-1]
    workspace.session.apply("Delete", remove_keyframe, 1, 0)
    bench.passed.add(late)
    qtbot.waitUntil(lambda: bench.started[-1] == span(workspace))
    assert workspace.solver.morph_of(span(workspace)) is None


def test_errors_leave_with_the_keys_that_they_were_about(
    open_workspace: Callable[..., Workspace], bench: Bench, qtbot: QtBot
) -> None:
    made = document((1, 3))
    bench.broken.add(span_of(made.layer(1), 1))
    workspace = open_workspace(made, bench)
    qtbot.waitUntil(lambda: not workspace.solver.busy)
    workspace.session.apply("Delete", remove_keyframe, 1, 0)
    assert list(workspace.solver.errors) == [(1, 0)]
    workspace.session.apply("Delete", remove_keyframe, 1, 1)
    assert not workspace.solver.errors


def test_no_more_solutions_are_kept_than_spans_and_those_that_undo_may_show(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    for _ in range(REMEMBERED + 20):
        nudge(workspace)
        qtbot.waitUntil(solved(workspace))
    assert len(workspace.solver.solutions()) == 1 + REMEMBERED
    assert len(bench.started) >= REMEMBERED + 20


def test_more_spans_than_are_remembered_are_all_solved_once(
    open_workspace: Callable[..., Workspace], bench: Bench, qtbot: QtBot
) -> None:
    workspace = open_workspace(document((1, REMEMBERED + 10)), bench)
    qtbot.waitUntil(lambda: not workspace.solver.busy)
    assert len(bench.started) == REMEMBERED + 9


def test_old_solutions_are_forgotten_in_the_order_of_their_last_use(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(solved(workspace))
    for _ in range(REMEMBERED + 3):
        nudge(workspace)
        qtbot.waitUntil(solved(workspace))
    count = len(bench.started)
    for _ in range(REMEMBERED):
        workspace.session.undo()
        assert solved(workspace)()
    for _ in range(3):
        workspace.session.undo()
    qtbot.waitUntil(solved(workspace))
    assert len(bench.started) > count


def test_closing_while_solving_ends_the_thread_and_restores_the_interpreter(
    open_workspace: Callable[..., Workspace], bench: Bench, qtbot: QtBot
) -> None:
    before = sys.getswitchinterval()
    bench.gate.clear()
    workspace = open_workspace(document((1, 2)), bench)
    qtbot.waitUntil(lambda: len(bench.started) == 1)
    thread = workspace.solver.findChild(QThread)
    assert thread.isRunning()
    workspace.solver.close()
    assert thread.isFinished()
    assert sys.getswitchinterval() == before


def test_a_new_layer_never_shows_what_was_being_solved_for_a_deleted_one(
    workspace: Workspace, bench: Bench, qtbot: QtBot
) -> None:
    qtbot.waitUntil(solved(workspace))
    bench.gate.clear()
    nudge(workspace)
    late = span(workspace)
    qtbot.waitUntil(lambda: late in bench.started)
    session = workspace.session
    session.apply("Delete", lambda before: replace(before, layers=()))
    new = move_nodes(document((1, 2)), 1, 0, 0, [2], (-1, 0))  # ids are given again
    session.apply("Import", lambda _: new)
    bench.passed.add(late)
    qtbot.waitUntil(lambda: bench.started[-1] == span(workspace))
    assert workspace.solver.morph_of(span(workspace)) is None
