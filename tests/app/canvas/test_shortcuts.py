from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMainWindow
from pytestqt.qtbot import QtBot

from app.canvas.canvas import Canvas
from app.canvas.moment import Role
from app.workspace import Workspace
from tests.app.canvas.conftest import Hand, fan
from tests.card import SQUARE, a_document

SOURCE = Role.SOURCE
Key = Qt.Key
KEYS = ("Right", "Del", "Space", "Return", "Esc", "Backspace", "Ctrl+Z")


class Window(QMainWindow):
    """A canvas in a window whose actions have the keys that tools want, too."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self.heard: list[str] = []
        self.workspace = workspace
        self.canvas = Canvas(workspace)
        self.setCentralWidget(self.canvas)
        for keys in KEYS:
            action = QAction(keys, self)
            action.setShortcut(keys)
            action.triggered.connect(self._hear)
            self.addAction(action)

    def _hear(self) -> None:
        self.heard.append(self.sender().text())


@pytest.fixture
def window(qtbot: QtBot, open_workspace: Callable[..., Workspace]) -> Window:
    workspace = open_workspace(a_document(), solve=fan)
    window = Window(workspace)
    qtbot.addWidget(window)
    window.resize(1200, 460)
    window.show()
    window.activateWindow()
    qtbot.waitUntil(lambda: QApplication.activeWindow() is window)
    return window


def hand_of(window: Window) -> Hand:
    hand = Hand(window.canvas, window.workspace)
    hand.pane(SOURCE).view.setFocus()
    return hand


def test_without_a_use_for_them_keys_reach_the_windows_shortcuts(window: Window):
    hand = hand_of(window)
    window.canvas.set_tool("nodes")
    for key in (Key.Key_Right, Key.Key_Delete, Key.Key_Return, Key.Key_Backspace):
        hand.key(SOURCE, key)
    assert window.heard == ["Right", "Del", "Return", "Backspace"]
    assert hand.steps == []


def test_keys_that_the_tool_wants_do_not_reach_them(window: Window):
    hand = hand_of(window)
    window.canvas.set_tool("nodes")
    hand.click(SOURCE, SQUARE[2])
    hand.key(SOURCE, Key.Key_Right)
    hand.key(SOURCE, Key.Key_Delete)
    window.canvas.set_tool("pen")
    for place in ((100, 100), (200, 100), (200, 200), (150, 250)):
        hand.click(SOURCE, place)
    hand.key(SOURCE, Key.Key_Backspace)
    hand.key(SOURCE, Key.Key_Return)
    hand.key(SOURCE, Key.Key_Escape)
    assert window.heard == []
    assert hand.steps == ["Move nodes", "Delete nodes", "Draw outline"]
    assert window.canvas.tool == "select"


def test_space_is_the_canvas_s_own_to_tap_or_hold(window: Window):
    view = hand_of(window).pane(SOURCE).view
    QTest.keyPress(view, Key.Key_Space)
    assert not window.workspace.playhead.playing
    QTest.keyRelease(view, Key.Key_Space)
    assert window.workspace.playhead.playing
    assert window.heard == []
    window.workspace.playhead.stop()


def test_escape_stops_playing_before_it_puts_the_tool_away(window: Window):
    hand = hand_of(window)
    window.canvas.set_tool("marks")
    hand.workspace.playhead.play()
    hand.key(SOURCE, Key.Key_Escape)
    hand.workspace.playhead.stop()
    assert window.heard == ["Esc"]
    assert window.canvas.tool == "marks"
