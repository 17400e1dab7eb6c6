"""Frames at hand: what is kept, what stands in for what is missing, and when that comes."""

from __future__ import annotations

import gc
import threading
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.jobs import frames as module
from app.jobs.frames import WISHES, Frames, Shown
from app.workspace import Workspace
from core.model import Document, Keyframe, Layer, Outline
from core.model.edits import move_nodes
from core.morph.scene import Span, span_of
from core.progress import Progress

SQUARE = Outline.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])


def frame(s: float) -> np.ndarray:
    return np.full((4, 2), s)


@dataclass(frozen=True, eq=False)
class Slow:
    """A solution whose frames must all be held, which takes until its gate is opened."""

    gate: threading.Event = field(default_factory=threading.Event)
    threads: set[int] = field(default_factory=set)
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    rings = (np.arange(4),)
    broken: bool = False

    def plain(self, s: float) -> np.ndarray | None:
        return frame(s) if s in (0, 1) else None

    def at(self, s: float) -> np.ndarray:
        if s not in (0, 1):
            self.threads.add(threading.get_ident())
            assert self.gate.wait(20)
            if self.broken:
                raise ArithmeticError("no such frame")
        return frame(s)


@pytest.fixture
def frames(qapp: object) -> Frames:
    return Frames()


def test_the_nearest_frame_stands_in_for_one_that_is_missing(frames: Frames):
    morph = Slow()
    shown = Shown(morph, frames)
    assert shown.at(0.3)[0, 0] == 0.0
    frames.keep(morph, {0.6: frame(0.6), 0.2: frame(0.2)})
    assert shown.at(0.3)[0, 0] == 0.2
    assert frames.exact(morph, 0.3) is None
    assert shown.at(0.9)[0, 0] == 1.0


def test_what_is_missed_is_told_once_and_so_is_that_it_came(frames: Frames):
    morph, told = Slow(), []
    frames.missed.connect(lambda: told.append("missed"))
    frames.came.connect(lambda: told.append("came"))
    for _ in range(3):
        frames.at(morph, 0.5)
    frames.keep(morph, {0.4: frame(0.4)})  # nobody waits for that
    frames.keep(morph, {0.5: frame(0.5)})
    assert told == ["missed", "came"]
    assert frames.missing is None
    assert frames.at(morph, 0.5)[0, 0] == 0.5


def test_the_frame_missed_last_comes_first_and_old_ones_are_let_go(frames: Frames):
    morph = Slow()
    moments = np.linspace(0.1, 0.9, WISHES + 3).tolist()
    for s in moments:
        frames.at(morph, s)
    order = []
    while (missing := frames.missing) is not None:
        order.append(missing[1])
        frames.give_up(missing)
    assert order == moments[:2:-1]


def test_no_more_is_kept_than_the_budget_the_newest_solution_and_what_is_near(
    frames: Frames, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(module, "BUDGET", 5 * frame(0).nbytes)
    old, new = Slow(), Slow()
    frames.keep(old, {s: frame(s) for s in (0.2, 0.4, 0.6)})
    frames.keep(new, {s: frame(s) for s in (0.1, 0.2)})
    assert len(frames.made(old)) == 3
    frames.keep(new, {s: frame(s) for s in (0.3, 0.9)})
    assert not frames.made(old)
    frames.keep(new, {0.7: frame(0.7)})
    frames.keep(new, {0.8: frame(0.8)})
    assert sorted(frames.made(new)) == [0.2, 0.3, 0.7, 0.8, 0.9]


def test_frames_go_with_their_solution(frames: Frames):
    morph = Slow()
    kept = frame(0.5)
    frames.keep(morph, {0.5: kept})
    frames.at(morph, 0.5)
    del morph
    gc.collect()
    assert gc.get_referrers(kept) == []


def test_a_large_mesh_is_never_made_while_the_artist_looks_on(
    frames: Frames, monkeypatch: pytest.MonkeyPatch
):
    class Quick(Slow):
        def plain(self, s: float) -> np.ndarray:
            return frame(s)

    assert frames.exact(Quick(), 0.5) is not None
    monkeypatch.setattr(module, "AT_ONCE", 1)
    assert frames.exact(Quick(), 0.5) is None


# -- and who makes them ----------------------------------------------------------------------------


def document() -> Document:
    keys = (Keyframe(f, SQUARE.transformed(np.eye(2) * f)) for f in (1, 13))
    return Document((Layer(1, "layer", tuple(keys)),))


def test_what_is_missing_on_screen_is_made_even_while_something_is_solved(
    open_workspace: Callable[..., Workspace], qtbot: QtBot
):
    morphs: list[Slow] = []
    solving = threading.Event()

    def solve(span: Span, progress: Progress) -> Slow:
        while morphs and not solving.wait(0.001):
            progress(0.5, "")
        morphs.append(Slow())
        return morphs[-1]

    workspace = open_workspace(document(), solve)
    qtbot.waitUntil(lambda: not workspace.solver.busy and not workspace.inspector.busy)
    workspace.session.apply("Move", move_nodes, 1, 0, 0, [0], (-0.25, 0))
    assert workspace.solver.busy
    layer = workspace.session.document.layer(1)
    stale = workspace.solver.morph_of(span_of(layer, 0))
    assert workspace.frames.at(stale, 0.5)[0, 0] != 0.5
    stale.gate.set()
    qtbot.waitUntil(lambda: workspace.frames.exact(stale, 0.5) is not None)
    assert workspace.solver.busy
    assert threading.get_ident() not in stale.threads
    solving.set()


def test_a_frame_that_cannot_be_made_is_not_tried_for_ever(
    open_workspace: Callable[..., Workspace], qtbot: QtBot
):
    morph = Slow(broken=True)
    morph.gate.set()
    workspace = open_workspace(document(), lambda span, progress: morph)
    qtbot.waitUntil(lambda: not workspace.solver.busy and not workspace.inspector.busy)
    workspace.frames.at(morph, 0.5)
    qtbot.waitUntil(lambda: not workspace.inspector.busy)
    assert workspace.frames.missing is None


def test_what_was_missing_of_a_replaced_document_is_not_made_any_more(
    open_workspace: Callable[..., Workspace], qtbot: QtBot
):
    morph = Slow()
    workspace = open_workspace(document(), lambda span, progress: morph)
    qtbot.waitUntil(lambda: not workspace.solver.busy and not workspace.inspector.busy)
    for s in (0.5, 0.4, 0.3):
        workspace.frames.at(morph, s)
    workspace.session.replace(Document())
    morph.gate.set()
    qtbot.waitUntil(lambda: not workspace.inspector.busy)
    assert workspace.frames.missing is None
    assert set(workspace.frames.made(morph)) == {0.5}  # which was under way
