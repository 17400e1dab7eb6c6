"""The playhead waits for no frame; and what it comes to see is what is exported."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.canvas.moment import Role, picture_on_screen
from core.model import Document, Keyframe, Layer, Outline, RingPoint
from core.morph.motion.sound import SoundFrames
from core.morph.scene import picture_at, solve_span
from tests.app.canvas.conftest import Hand
from tests.core.morph.motion.test_guard import ragged

IN_BETWEEN = Role.IN_BETWEEN


def held() -> Document:
    """Two ragged stars, marked crosswise: many frames would fold, and are held."""
    outlines = (Outline.polygon(100 * ragged(seed) + 400) for seed in (2, 1002))
    marks = (tuple(RingPoint(0, float((i + shift) % 14)) for i in range(14)) for shift in (0, 1))
    keys = tuple(
        Keyframe(1 + 24 * k, outline, places)
        for k, (outline, places) in enumerate(zip(outlines, marks, strict=True))
    )
    return Document((Layer(1, "star", keys, tuple("abcdefghijklmn")),))


@pytest.fixture
def holders(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[int]]:
    """The threads in which frames were held."""
    threads: list[int] = []
    hold = SoundFrames._held

    def note(self: SoundFrames, *args: object) -> object:
        threads.append(threading.get_ident())
        return hold(self, *args)

    monkeypatch.setattr(SoundFrames, "_held", note)
    return threads


def at_rest(hand: Hand) -> bool:
    workspace = hand.workspace
    return not workspace.solver.busy and not workspace.inspector.busy


def test_no_frame_is_held_in_the_thread_of_the_window_wherever_the_playhead_goes(
    open_canvas: Callable[..., Hand], holders: list[int], qtbot: QtBot
):
    hand = open_canvas(held(), solve=solve_span)
    playhead = hand.workspace.playhead
    playhead.play()
    qtbot.waitUntil(lambda: at_rest(hand), timeout=20_000)
    playhead.stop()
    assert holders
    for frame in np.linspace(1, 25, 60):
        playhead.move_to(frame)
        QApplication.processEvents()
        hand.canvas.grab()
    qtbot.waitUntil(lambda: at_rest(hand), timeout=20_000)
    assert threading.get_ident() not in holders


def test_once_the_frames_are_looked_at_no_more_are_made_to_scrub_and_play(
    open_canvas: Callable[..., Hand], holders: list[int], qtbot: QtBot
):
    hand = open_canvas(held(), solve=solve_span)
    qtbot.waitUntil(lambda: at_rest(hand), timeout=20_000)
    holders.clear()
    for frame in range(1, 26):
        hand.workspace.playhead.move_to(frame)
        QApplication.processEvents()
        assert hand.pane(IN_BETWEEN).state == ""
    assert not holders


def test_what_comes_on_screen_is_what_is_exported(open_canvas: Callable[..., Hand], qtbot: QtBot):
    hand = open_canvas(held(), solve=solve_span)
    workspace = hand.workspace
    for frame in (4, 9, 12.5, 13, 17.25, 22, 30):
        workspace.playhead.move_to(frame)
        QApplication.processEvents()
        qtbot.waitUntil(lambda: hand.pane(IN_BETWEEN).state == "", timeout=20_000)
        seen = picture_on_screen(workspace, frame).shapes[0].rings
        written = picture_at(workspace.session.document, frame, workspace.solver.morph_of)
        for ring, expected in zip(seen, written.shapes[0].rings, strict=True):
            assert np.array_equal(ring, expected)


def test_a_frame_that_is_not_there_yet_is_said_to_be_until_it_comes(
    open_canvas: Callable[..., Hand], monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
):
    hand = open_canvas(held(), solve=solve_span)
    qtbot.waitUntil(lambda: at_rest(hand), timeout=20_000)
    gate, hold = threading.Event(), SoundFrames._held

    def wait(self: SoundFrames, *args: object) -> object:
        assert gate.wait(20)
        return hold(self, *args)

    monkeypatch.setattr(SoundFrames, "_held", wait)
    moments = (frame for frame in np.arange(1.5, 25))
    while hand.pane(IN_BETWEEN).state == "":
        hand.workspace.playhead.move_to(next(moments))
        QApplication.processEvents()
    assert hand.pane(IN_BETWEEN).state == "updating…"
    gate.set()
    qtbot.waitUntil(lambda: hand.pane(IN_BETWEEN).state == "")
