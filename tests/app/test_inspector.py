"""The verdict on a span is right at every moment: it is never older than the span."""

from __future__ import annotations

import threading
from collections.abc import Callable
from itertools import chain

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.canvas.moment import picture_on_screen
from app.jobs import looking
from app.jobs.inspector import PORTION, REMEMBERED, Standing
from app.jobs.looking import Sight, Task
from app.verdict import describe_span, troubled_frames
from app.workspace import Workspace
from core.errors import SolveError
from core.model import Document, Easing, Keyframe, Layer, Outline, Recipe
from core.model.edits import (
    insert_keyframe,
    move_keyframe,
    move_nodes,
    remove_keyframe,
    set_easing,
    update_layer,
)
from core.morph.hanging.run import _joint
from core.morph.scene import Span, solve_span, timed_span_of
from core.morph.soundness import check_span
from core.progress import Progress
from tests.app.eye import Eye

SQUARE = Outline.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])


def document(*frames: int) -> Document:
    keys = (Keyframe(f, SQUARE.transformed(np.eye(2) * (1 + i))) for i, f in enumerate(frames))
    return Document((Layer(1, "layer", tuple(keys)),))


class Nothing:
    """A solution that nobody looks at."""


def solve(span: Span, progress: Progress) -> Nothing:
    """Solve nothing, at once."""
    return Nothing()


@pytest.fixture
def eye() -> Eye:
    return Eye()


@pytest.fixture
def workspace(open_workspace: Callable[..., Workspace], eye: Eye) -> Workspace:
    return open_workspace(document(1, 13, 25), solve, eye)


def stands(workspace: Workspace, standing: Standing, index: int = 0) -> Callable[[], bool]:
    return lambda: workspace.inspector.standing(1, index) is standing


def nudge(workspace: Workspace) -> None:
    workspace.session.apply("Move", move_nodes, 1, 0, 0, [0], (-0.25, 0))


EDITS = {
    "outline": (move_nodes, 1, 0, 0, [0], (-0.25, 0)),
    "timing": (set_easing, 1, 0, Easing(0.42, 0.0, 1.0, 1.0)),
    "frames": (move_keyframe, 1, 1, 9),
    "key inserted": (insert_keyframe, 1, Keyframe(5, SQUARE)),
    "key removed": (remove_keyframe, 1, 1),
}


@pytest.mark.parametrize("edit", EDITS)
def test_any_edit_that_changes_a_span_takes_its_verdict_away_at_once(
    workspace: Workspace, eye: Eye, qtbot: QtBot, edit: str
) -> None:
    qtbot.waitUntil(stands(workspace, Standing.SOUND))
    eye.gate.clear()
    workspace.session.apply("Edit", *EDITS[edit])
    assert workspace.inspector.standing(1, 0) in (Standing.SOLVING, Standing.CHECKING)
    assert workspace.inspector.check(1, 0) is None
    assert workspace.inspector.frame_check(1, 5) is None
    eye.gate.set()
    qtbot.waitUntil(stands(workspace, Standing.SOUND))
    now = timed_span_of(workspace.session.document.layer(1), 0)
    assert now in [span for span, _ in eye.seen]


def test_whoever_listens_never_hears_of_a_verdict_on_what_was_there_before(
    workspace: Workspace, eye: Eye, qtbot: QtBot
) -> None:
    wrong: list[object] = []

    def listen(*_: object) -> None:
        layer, inspector = workspace.session.document.layer(1), workspace.inspector
        for index in range(layer.spans):
            check, span = inspector.check(1, index), timed_span_of(layer, index)
            if check and [f.frame for f in check.frames] != [k for k, _ in span.frames()]:
                wrong.append((index, check))

    for signal in (
        workspace.session.changed,
        workspace.solver.updated,
        workspace.inspector.changed,
        workspace.solver.busy_changed,
    ):
        signal.connect(listen)
    qtbot.waitUntil(stands(workspace, Standing.SOUND, 1))
    for edit in EDITS.values():
        workspace.session.apply("Edit", *edit)
        qtbot.waitUntil(stands(workspace, Standing.SOUND))
        workspace.session.undo()
        workspace.session.redo()
    assert not wrong


def test_a_crossing_is_told_with_its_frames_and_their_places(
    workspace: Workspace, eye: Eye, qtbot: QtBot
) -> None:
    eye.crossing = {4, 5, 6, 9, 12}
    nudge(workspace)
    qtbot.waitUntil(stands(workspace, Standing.UNSOUND))
    qtbot.waitUntil(stands(workspace, Standing.SOUND, 1))
    words = describe_span(workspace.inspector, 1, 0)
    assert words == "Crosses itself at frames 4 to 6, 9, 12."
    inspector = workspace.inspector
    assert inspector.frame_check(1, 5).places.tolist() == [[3, 4]]
    assert inspector.frame_check(1, 7).sound
    assert not inspector.frame_check(1, 6.5).sound  # between frames, the worse neighbour counts
    assert inspector.frame_check(1, 99).frame == 25


def test_frames_near_the_playhead_are_looked_at_first_and_ahead_of_it_while_playing(
    workspace: Workspace, eye: Eye, qtbot: QtBot
) -> None:
    orders: list[list[int]] = []
    eye.listen = lambda task: orders.append([number for number, _ in task.unseen])
    qtbot.waitUntil(stands(workspace, Standing.SOUND, 1))
    orders.clear()
    workspace.playhead.move_to(7)
    nudge(workspace)
    qtbot.waitUntil(stands(workspace, Standing.SOUND))
    assert set(orders[0][:3]) == {6, 7, 8}
    workspace.playhead.play()
    nudge(workspace)
    qtbot.waitUntil(lambda: len(orders) == 2)
    workspace.playhead.stop()
    here = orders[1][0]
    assert orders[1] == [*range(here, 14), *range(1, here)]


def test_of_a_long_span_few_frames_are_handed_over_at_a_time_and_each_once(
    open_workspace: Callable[..., Workspace], eye: Eye, qtbot: QtBot
) -> None:
    tasks: list[Task] = []
    eye.listen = tasks.append
    workspace = open_workspace(document(1, 1001), solve, eye)
    workspace.playhead.move_to(700)
    qtbot.waitUntil(stands(workspace, Standing.SOUND))
    orders = [[number for number, _ in task.unseen] for task in tasks]
    assert max(map(len, orders)) == PORTION
    assert [*chain(*orders)] == sorted(range(1, 1002), key=lambda k: abs(k - 700))
    assert [len(task.seen) for task in tasks if task.seen is not None] == [1000]
    assert [seen.frame for seen in workspace.inspector.check(1, 0).frames] == [*range(1, 1002)]
    workspace.playhead.move_to(950)
    workspace.playhead.play()
    nudge(workspace)
    qtbot.waitUntil(stands(workspace, Standing.SOUND))
    workspace.playhead.stop()
    ahead = [number for number, _ in tasks[len(orders)].unseen]
    here = ahead[0]
    assert set(ahead) == set([*range(here, 1002), *range(1, here)][:PORTION])


def test_a_look_ends_after_a_while_with_what_it_has_and_another_finishes_it(
    open_workspace: Callable[..., Workspace], monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    monkeypatch.setattr(looking, "PIECE", 0.0)
    tasks: list[Task] = []

    def look(task: Task, progress: Progress) -> Sight:
        tasks.append(task)
        return looking.look(task, progress)

    workspace = open_workspace(document(1, 13), solve_span, look)
    qtbot.waitUntil(stands(workspace, Standing.SOUND), timeout=20_000)
    assert [len(task.unseen) for task in tasks] == [*range(13, 0, -1)]
    assert [seen.frame for seen in workspace.inspector.check(1, 0).frames] == [*range(1, 14)]


def test_the_span_under_the_playhead_is_checked_first_and_nothing_while_solving(
    open_workspace: Callable[..., Workspace], eye: Eye, qtbot: QtBot
) -> None:
    gate = threading.Event()

    def slow(span: Span, progress: Progress) -> Nothing:
        assert gate.wait(20)
        return Nothing()

    workspace = open_workspace(document(1, 13, 25), slow, eye)
    workspace.playhead.move_to(20)
    assert not eye.seen
    assert workspace.inspector.standing(1, 0) is Standing.SOLVING
    gate.set()
    qtbot.waitUntil(stands(workspace, Standing.SOUND, 0))
    assert [(span.first, frame) for span, frame in eye.seen] == [(13, 20), (1, 13)]


def test_a_check_ends_when_its_span_changes(workspace: Workspace, eye: Eye, qtbot: QtBot) -> None:
    qtbot.waitUntil(stands(workspace, Standing.SOUND))
    eye.gate.clear()
    workspace.session.apply("Ease", set_easing, 1, 0, Easing(0.5, 0.0, 1.0, 1.0))
    qtbot.waitUntil(lambda: eye.seen[-1][0].easing.x1 == 0.5)
    workspace.session.apply("Ease", set_easing, 1, 0, Easing(0.6, 0.0, 1.0, 1.0))
    qtbot.waitUntil(lambda: eye.seen[-1][0].easing.x1 == 0.6)  # with the gate still closed
    eye.gate.set()
    qtbot.waitUntil(stands(workspace, Standing.SOUND))


def test_a_map_that_is_not_one_to_one_is_told_of_though_every_frame_is_sound(
    workspace: Workspace, eye: Eye, qtbot: QtBot
) -> None:
    eye.one_to_one = False
    nudge(workspace)
    qtbot.waitUntil(stands(workspace, Standing.UNSOUND))
    assert describe_span(workspace.inspector, 1, 0) == "Its map from key to key is not one to one."


def test_undo_shows_a_known_verdict_without_another_look(
    workspace: Workspace, eye: Eye, qtbot: QtBot
) -> None:
    qtbot.waitUntil(stands(workspace, Standing.SOUND, 1))
    nudge(workspace)
    qtbot.waitUntil(stands(workspace, Standing.SOUND))
    count = len(eye.seen)
    workspace.session.undo()
    assert stands(workspace, Standing.SOUND)()
    assert len(eye.seen) == count


def test_colour_and_name_leave_the_verdict_as_it_is(
    workspace: Workspace, eye: Eye, qtbot: QtBot
) -> None:
    qtbot.waitUntil(stands(workspace, Standing.SOUND))
    workspace.session.apply("Rename", update_layer, 1, name="fin")
    assert stands(workspace, Standing.SOUND)()


def test_cancelled_solving_leaves_a_span_stale_and_a_hidden_one_unknown(
    open_workspace: Callable[..., Workspace], eye: Eye, qtbot: QtBot
) -> None:
    gate = threading.Event()
    gate.set()

    def slow(span: Span, progress: Progress) -> Nothing:
        while not gate.wait(0.001):
            progress(0.5, "")
        return Nothing()

    workspace = open_workspace(document(1, 13), slow, eye)
    qtbot.waitUntil(stands(workspace, Standing.SOUND))
    gate.clear()
    nudge(workspace)
    workspace.solver.cancel()
    assert stands(workspace, Standing.STALE)()
    workspace.session.apply("Hide", update_layer, 1, visible=False)
    assert stands(workspace, Standing.NONE)()


def test_what_cannot_be_solved_or_checked_says_why(
    open_workspace: Callable[..., Workspace], eye: Eye, qtbot: QtBot
) -> None:
    def fail(span: Span, progress: Progress) -> object:
        raise SolveError("The outlines do not fit.")

    failing = open_workspace(document(1, 13), fail, eye)
    qtbot.waitUntil(stands(failing, Standing.FAILED))
    assert "do not fit" in describe_span(failing.inspector, 1, 0)
    eye.broken = True
    blind = open_workspace(document(1, 13), solve, eye)
    qtbot.waitUntil(lambda: blind.inspector.error(1, 0) is not None)
    assert stands(blind, Standing.NONE)()
    assert "could not be looked at" in describe_span(blind.inspector, 1, 0)


def test_checks_are_forgotten_in_the_order_of_their_last_use(
    workspace: Workspace, eye: Eye, qtbot: QtBot
) -> None:
    for step in range(REMEMBERED + 10):
        workspace.session.apply("Move", move_keyframe, 1, 2, 30 + step)
        qtbot.waitUntil(stands(workspace, Standing.SOUND, 1))
    count = len(eye.seen)
    for _ in range(REMEMBERED + 10):
        workspace.session.undo()
    qtbot.waitUntil(stands(workspace, Standing.SOUND, 1))
    assert len(eye.seen) > count


def test_a_real_crossing_has_the_verdict_of_the_command_line(
    open_workspace: Callable[..., Workspace], qtbot: QtBot
) -> None:
    """Blades that swap their places by straight paths fold on the way."""
    one = [(0, 0), (100, 0), (100, 20), (20, 20), (20, 100), (0, 100)]
    other = [(0, 0), (-20, 0), (-100, -80), (-80, -100), (-20, -40), (0, -100)]
    keys = (Keyframe(1, Outline.polygon(one)), Keyframe(9, Outline.polygon(other)))
    workspace = open_workspace(Document((Layer(1, "x", keys, recipe=Recipe(method="linear")),)))
    qtbot.waitUntil(stands(workspace, Standing.UNSOUND), timeout=20_000)
    span = timed_span_of(workspace.session.document.layer(1), 0)
    expected = check_span(span.span, solve_span(span.span), span.frames())
    found = workspace.inspector.check(1, 0)
    for ours, theirs in zip(found.frames, expected.frames, strict=True):
        assert (ours.frame, ours.folds, ours.crossings) == (
            theirs.frame,
            theirs.folds,
            theirs.crossings,
        )
    assert troubled_frames(found)


def test_what_hangs_is_joined_to_its_carrier_before_it_is_seen(
    open_workspace: Callable[..., Workspace], qtbot: QtBot
) -> None:
    card = document(1, 13, 25).layers[0]
    hat = Layer(2, "hat", (Keyframe(1, SQUARE), Keyframe(19, SQUARE)), carrier=1)
    still = Layer(3, "pin", (Keyframe(1, SQUARE),), carrier=1)
    workspace = open_workspace(Document((card, hat, still)))
    qtbot.waitUntil(stands(workspace, Standing.SOUND, 1), timeout=20_000)
    qtbot.waitUntil(lambda: not (workspace.inspector.busy or workspace.solver.busy))
    before = _joint.cache_info()
    for frame in (5.5, 15.5, 22.5):
        assert len(picture_on_screen(workspace, frame).shapes) == 3
    after = _joint.cache_info()
    assert after.hits > before.hits
    assert after.misses == before.misses
