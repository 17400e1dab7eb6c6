"""One keyframe is chosen, it is plain which, and every command for keyframes acts on it."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.canvas.moment import Role
from app.document.session import Session
from app.main_window import MainWindow
from core.model import Document, Keyframe, Layer, Outline
from tests.app.window.conftest import press

SQUARE = Outline.polygon([(100, 100), (300, 100), (300, 300), (100, 300)])


def three_keys(window: MainWindow) -> Session:
    keys = tuple(Keyframe(frame, SQUARE) for frame in (1, 13, 25))
    window.workspace.session.replace(Document((Layer(1, "card", keys),)))
    return window.workspace.session


def frames(session: Session) -> list[int]:
    return [key.frame for key in session.document.layers[0].keyframes]


@pytest.mark.parametrize("widget", ["canvas", "timeline"])
def test_menu_and_timeline_delete_the_key_that_is_chosen_and_the_menu_names_it(
    window: MainWindow, widget: str
) -> None:
    session, selection = three_keys(window), window.workspace.selection
    getattr(window, widget).setFocus()
    window.workspace.playhead.move_to(20)
    selection.select_key(1, 2)
    assert window.actions_["remove-key"].text() == "&Delete keyframe 25"
    press(window, "Del")
    assert frames(session) == [1, 13]
    press(window, "Ctrl+Z")
    window.workspace.playhead.move_to(13)
    assert window.actions_["delete"].text() == "&Delete keyframe 13"
    press(window, "Del")
    assert frames(session) == [1, 25]


@pytest.mark.parametrize("widget", ["canvas", "timeline"])
def test_stepping_to_a_key_chooses_it_wherever_the_keyboard_is(
    window: MainWindow, widget: str
) -> None:
    three_keys(window)
    getattr(window, widget).setFocus()
    for keys, frame in (("Ctrl+Right", 13), ("Ctrl+Right", 25), ("Ctrl+Left", 13)):
        press(window, keys)
        assert window.workspace.selection.keyframe.frame == frame


def test_the_focus_goes_with_the_key_that_is_stepped_to_or_inserted(
    window: MainWindow, qtbot: QtBot
) -> None:
    three_keys(window)
    qtbot.waitUntil(lambda: not window.workspace.solver.busy)
    panes, selection = window.canvas.panes, window.workspace.selection
    panes[Role.TARGET].view.setFocus()
    assert selection.keyframe.frame == 13
    press(window, "Ctrl+Right")
    assert selection.keyframe.frame == 13
    assert panes[Role.SOURCE].view.hasFocus()
    window.workspace.playhead.move_to(7)
    QApplication.processEvents()
    panes[Role.TARGET].view.setFocus()
    press(window, "F6")
    assert selection.keyframe.frame == 7
    assert panes[Role.SOURCE].view.hasFocus()


def test_nodes_stay_selected_while_the_playhead_passes_other_keys(window: MainWindow) -> None:
    three_keys(window)
    window.workspace.playhead.move_to(20)
    window.workspace.selection.select_key(1, 2)
    window.workspace.selection.select_nodes(frozenset({(0, 1)}))
    for frame in (14, 13, 18):
        window.workspace.playhead.move_to(frame)
        QApplication.processEvents()
    assert window.workspace.selection.nodes == {(0, 1)}
