"""Suggested marks in the window: status bar, menus, settings, files."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.main_window import MainWindow
from core.io import project
from core.model import Document, Keyframe, Layer, Outline
from tests.app.window.conftest import Artist, press

LEFT = Qt.MouseButton.LeftButton
L = ((300, 80), (420, 80), (420, 320), (600, 320), (600, 420), (300, 420))
TALL = ((300, 60), (380, 60), (380, 380), (640, 380), (640, 440), (300, 440))


@pytest.fixture
def unmarked(window: MainWindow, qtbot: QtBot) -> MainWindow:
    """A window on two letters, with the marks tool in hand and suggestions on the canvas."""
    keys = (Keyframe(1, Outline.polygon(L)), Keyframe(25, Outline.polygon(TALL)))
    window.workspace.session.replace(Document((Layer(1, "L", keys),)))
    press(window, "M")
    qtbot.waitUntil(lambda: window.suggested.isVisible() and window.suggested.accept.isEnabled())
    return window


def test_the_button_accepts_all_in_one_step_and_goes(unmarked: MainWindow, qtbot: QtBot):
    session, shown = unmarked.workspace.session, unmarked.workspace.suggestions.shown
    before = session.document
    QTest.mouseClick(unmarked.suggested.accept, LEFT)
    assert len(session.document.layers[0].labels) == len(shown)
    qtbot.waitUntil(lambda: not unmarked.suggested.isVisible())
    press(unmarked, "Ctrl+Z")
    assert session.document is before


def test_hide_puts_them_away_for_good_and_the_menu_brings_them_back(
    unmarked: MainWindow, open_window: Callable[[], MainWindow], qtbot: QtBot
):
    QTest.mouseClick(unmarked.suggested.hide_all, LEFT)
    assert unmarked.workspace.suggestions.shown == ()
    qtbot.waitUntil(lambda: not unmarked.suggested.isVisible())
    assert unmarked.actions_["suggestions-never"].isChecked()
    assert "Ctrl+Shift+M" in unmarked.messages.text
    unmarked.settings.save_view(unmarked.workspace.view)
    assert open_window().workspace.view.suggestions == "never"
    press(unmarked, "Ctrl+Shift+M")
    qtbot.waitUntil(lambda: bool(unmarked.workspace.suggestions.shown))
    assert unmarked.actions_["suggestions-with the tool"].isChecked()


def test_the_menu_shows_them_always(unmarked: MainWindow):
    unmarked.actions_["suggestions-always"].trigger()
    press(unmarked, "V")
    assert unmarked.workspace.suggestions.shown
    assert not unmarked.suggested.isVisible()  # the buttons belong to the tool


def test_what_is_suggested_is_never_in_the_saved_file(
    unmarked: MainWindow, artist: Artist, tmp_path
):
    artist["save"] = tmp_path / "letters"
    press(unmarked, "Ctrl+S")
    assert project.load(tmp_path / "letters.betwixt").layers[0].labels == ()


def test_the_status_bar_tells_marks_in_use_from_more_that_are_suggested(
    unmarked: MainWindow, qtbot: QtBot
):
    bar, suggestions = unmarked.suggested, unmarked.workspace.suggestions
    assert f"Solved with suggested marks: {len(suggestions.shown)}" in bar.text
    suggestions.accept(suggestions.shown[0])
    qtbot.waitUntil(lambda: "More marks suggested" in bar.text)
