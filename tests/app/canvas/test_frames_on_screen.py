"""The playhead waits for no frame; and what it comes to see is what is exported."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.canvas.moment import Role, moment_of, picture_on_screen
from app.jobs.solver import SpanState
from core.model import Keyframe, Layer, Outline
from core.model.edits import move_nodes
from core.morph.morph import Morph
from core.morph.scene import picture_at, solve_span
from tests.app.canvas.conftest import Hand
from tests.card import a_document

IN_BETWEEN = Role.IN_BETWEEN
FAILED, SOLVED = SpanState.FAILED, SpanState.SOLVED


class Makers:
    """Every frame must be held, and takes until the gate is open; who makes it is noted."""

    def __init__(self) -> None:
        self.threads: list[int] = []
        self.gate = threading.Event()
        self.gate.set()


@pytest.fixture
def makers(monkeypatch: pytest.MonkeyPatch) -> Makers:
    makers, at = Makers(), Morph.at

    def slowly(self: Morph, s: float) -> np.ndarray:
        if s not in (0, 1):
            makers.threads.append(threading.get_ident())
            assert makers.gate.wait(20)
        return at(self, s)

    monkeypatch.setattr(Morph, "at", slowly)
    monkeypatch.setattr(Morph, "plain", lambda self, s: None)
    return makers


@pytest.fixture
def hand(makers: Makers, open_canvas: Callable[..., Hand]) -> Hand:
    return open_canvas(a_document(), solve=solve_span)


def at_rest(hand: Hand) -> Callable[[], bool]:
    return lambda: not hand.workspace.solver.busy and not hand.workspace.inspector.busy


def show(hand: Hand, frame: float) -> None:
    hand.workspace.playhead.move_to(frame)
    QApplication.processEvents()
    hand.canvas.grab()


def up_to_date(hand: Hand) -> Callable[[], bool]:
    return lambda: hand.pane(IN_BETWEEN).state == ""


def test_no_slow_frame_is_made_in_the_thread_of_the_window_wherever_the_playhead_goes(
    hand: Hand, makers: Makers, qtbot: QtBot
):
    hand.workspace.playhead.play()
    qtbot.waitUntil(at_rest(hand), timeout=20_000)
    hand.workspace.playhead.stop()
    for frame in np.linspace(1, 25, 60):
        show(hand, frame)
    qtbot.waitUntil(at_rest(hand), timeout=20_000)
    assert len(makers.threads) > 23
    assert threading.get_ident() not in makers.threads


def test_once_the_frames_are_looked_at_none_is_made_to_scrub_through_them(
    hand: Hand, makers: Makers, qtbot: QtBot
):
    qtbot.waitUntil(at_rest(hand), timeout=20_000)
    makers.threads.clear()
    for frame in range(1, 26):
        show(hand, frame)
        assert up_to_date(hand)()
    assert not makers.threads


def test_a_frame_that_was_missing_on_screen_is_not_made_again_to_be_looked_at(
    hand: Hand, makers: Makers, qtbot: QtBot
):
    qtbot.waitUntil(at_rest(hand), timeout=20_000)
    show(hand, 13)
    makers.threads.clear()
    hand.workspace.session.apply("Move", move_nodes, 1, 0, 0, [0], (-9.0, 0.0))
    qtbot.waitUntil(at_rest(hand), timeout=20_000)
    qtbot.waitUntil(up_to_date(hand))
    assert len(makers.threads) == 23


def test_what_comes_on_screen_is_what_is_exported(hand: Hand, qtbot: QtBot):
    workspace = hand.workspace
    for frame in (4, 9, 12.5, 13, 17.25, 22, 30):
        show(hand, frame)
        qtbot.waitUntil(up_to_date(hand), timeout=20_000)
        seen = picture_on_screen(workspace, frame).shapes[0].rings
        written = picture_at(workspace.session.document, frame, workspace.solver.morph_of)
        for ring, expected in zip(seen, written.shapes[0].rings, strict=True):
            assert np.array_equal(ring, expected)


def test_a_frame_that_is_not_there_yet_is_said_to_be_until_it_comes(
    hand: Hand, makers: Makers, qtbot: QtBot
):
    qtbot.waitUntil(at_rest(hand), timeout=20_000)
    makers.gate.clear()
    show(hand, 7.5)
    assert hand.pane(IN_BETWEEN).state == "updating…"
    show(hand, 8)
    assert up_to_date(hand)()
    show(hand, 9.5)
    makers.gate.set()
    qtbot.waitUntil(up_to_date(hand))


def test_a_frame_that_does_not_come_is_dimmed_after_a_while_and_no_longer_than_that(
    hand: Hand, makers: Makers, qtbot: QtBot
):
    def colour() -> QColor:
        view = hand.pane(IN_BETWEEN).view
        return view.grab().toImage().pixelColor(hand.pixel(IN_BETWEEN, (450, 300)))

    qtbot.waitUntil(at_rest(hand), timeout=20_000)
    show(hand, 7)
    there = colour()
    makers.gate.clear()
    show(hand, 7.5)
    assert colour() == there
    qtbot.waitUntil(lambda: colour() != there)
    makers.gate.set()
    qtbot.waitUntil(lambda: colour() == there)


def test_what_hangs_on_a_frame_that_is_not_there_yet_is_not_there_either(
    makers: Makers, open_canvas: Callable[..., Hand], qtbot: QtBot
):
    document = a_document(marks=False)
    hat = Outline.polygon([(400, 100), (500, 100), (500, 150), (400, 150)])
    hung = Layer(2, "hat", (Keyframe(1, hat),), carrier=1)
    hand = open_canvas(replace(document, layers=(*document.layers, hung)), solve=solve_span)
    hand.workspace.selection.select_layer(1)
    qtbot.waitUntil(at_rest(hand), timeout=20_000)
    makers.gate.clear()
    show(hand, 7.5)
    assert moment_of(hand.workspace).stale == {1, 2}
    makers.gate.set()
    qtbot.waitUntil(up_to_date(hand))
    assert not moment_of(hand.workspace).stale


def test_what_hangs_on_a_layer_is_stale_unless_it_is_solved_all_the_way(
    open_canvas: Callable[..., Hand], qtbot: QtBot
):
    """A hat drawn at frame 1 is not where it belongs at frame 40 while frames 1 to 25 fail."""
    document = a_document(marks=False)
    card, hat = document.layers[0], Outline.polygon([(400, 100), (500, 100), (500, 150)])
    card = replace(card, keyframes=(*card.keyframes, replace(card.keyframes[0], frame=49)))
    hung = Layer(2, "hat", (Keyframe(1, hat),), carrier=1)
    hand = open_canvas(replace(document, layers=(card, hung)), solve=solve_span)
    workspace = hand.workspace
    workspace.playhead.move_to(40)
    assert not moment_of(workspace).stale
    workspace.session.apply("Twist", move_nodes, 1, 0, 0, [0], (400, 100))
    qtbot.waitUntil(lambda: not workspace.solver.busy, timeout=20_000)
    assert [workspace.solver.state(1, span) for span in (0, 1)] == [FAILED, SOLVED]
    assert moment_of(workspace).stale == {2}
    workspace.playhead.move_to(1)  # where it was drawn
    assert not moment_of(workspace).stale
