"""Themes, the welcome panel, and where panels are."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton
from pytestqt.qtbot import QtBot

import resources
from app.main_window import MainWindow
from app.panels.welcome import _Card
from app.style import DARK, LIGHT, Colours, colours
from core.io import project
from tests.app.window.conftest import Artist, press

LEFT = Qt.MouseButton.LeftButton


def contrast(one: str, other: str) -> float:
    """The contrast ratio that the WCAG define."""

    def luminance(name: str) -> float:
        parts = QColor(name).getRgbF()[:3]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("theme", [DARK, LIGHT])
def test_text_is_readable_on_every_ground(theme: Colours) -> None:
    grounds = (theme.window, theme.base, theme.raised, theme.error_ground, theme.note_ground)
    for ground, text in product(grounds, (theme.text,)):
        assert contrast(ground, text) >= 7
    for ground in (theme.window, theme.base):
        assert contrast(ground, theme.muted) >= 4.5
    assert contrast(theme.accent, theme.on_accent) >= 4
    assert contrast(theme.mark, theme.on_mark) >= 7


def brightness(window: MainWindow) -> float:
    image = window.menuBar().grab().toImage()
    return image.pixelColor(image.width() - 5, 5).lightnessF()


def test_the_theme_changes_everything_at_once_and_is_remembered(window: MainWindow) -> None:
    assert brightness(window) < 0.3
    window.messages.show_info("A message is on show meanwhile.")
    window.beginning.toggle_welcome()
    window.actions_["theme-light"].trigger()
    assert brightness(window) > 0.8
    assert colours() is LIGHT
    assert window.settings.theme == "light"
    icon = window.actions_["save"].icon().pixmap(20, 20).toImage()
    tints = [icon.pixelColor(x, y) for x in range(20) for y in range(20)]
    assert max(tints, key=QColor.alpha).lightnessF() < 0.3
    window.actions_["theme-dark"].trigger()
    assert brightness(window) < 0.3


def test_at_the_first_start_a_sample_is_open_and_moving_beside_the_welcome(
    window: MainWindow, qtbot: QtBot
) -> None:
    window.begin(None)
    assert window.workspace.session.document == project.load(resources.samples()[0])
    assert window.workspace.playhead.playing
    assert window.welcome.isVisible()
    assert not window.welcome.geometry().intersects(window.canvas.geometry())
    frame = window.workspace.playhead.frame
    qtbot.waitUntil(lambda: window.workspace.playhead.frame != frame)
    assert not window.isWindowModified()


def test_every_sample_opens_from_the_welcome_panel(window: MainWindow, qtbot: QtBot) -> None:
    window.begin(None)
    cards = window.welcome.findChildren(_Card)
    assert len(cards) == len(resources.samples())
    for card, path in zip(cards, resources.samples(), strict=True):
        QTest.mouseClick(card, LEFT)
        assert window.workspace.session.document == project.load(path)
        assert window.workspace.session.path is None
    assert not window.messages.text


def test_the_welcome_panel_leaves_and_comes_back_and_the_side_panels_with_it(
    window: MainWindow,
) -> None:
    assert window.layers.isVisible()
    window.begin(None)
    assert not window.layers.isVisible()
    QTest.mouseClick(window.welcome.close_button, LEFT)
    assert not window.welcome.isVisible()
    assert window.layers.isVisible()
    assert window.properties.isVisible()
    window.actions_["welcome"].trigger()
    assert window.welcome.isVisible()


def test_new_from_the_welcome_panel_starts_empty_with_the_pen(window: MainWindow) -> None:
    window.begin(None)
    QTest.mouseClick(window.welcome.new, LEFT)
    assert window.workspace.session.document.layers == ()
    assert window.canvas.tool == "pen"
    assert not window.welcome.isVisible()


def test_the_welcome_panel_can_be_told_to_stay_away(
    window: MainWindow, open_window: Callable[[], MainWindow]
) -> None:
    window.begin(None)
    window.welcome.at_start.click()
    window.close()
    again = open_window()
    again.begin(None)
    assert not again.welcome.isVisible()
    assert again.workspace.playhead.playing


def test_panels_stay_where_they_were_put_until_the_layout_is_reset(
    window: MainWindow, open_window: Callable[[], MainWindow], artist: Artist
) -> None:
    window.panels.docks["layers"].hide()
    window.addDockWidget(Qt.DockWidgetArea.LeftDockWidgetArea, window.panels.docks["properties"])
    window.beginning.toggle_welcome()
    window.close()
    again = open_window()
    docks = again.panels.docks
    assert not docks["layers"].isVisible()
    assert again.dockWidgetArea(docks["properties"]) == Qt.DockWidgetArea.LeftDockWidgetArea
    again.actions_["reset-layout"].trigger()
    QApplication.processEvents()
    assert docks["layers"].isVisible()
    assert again.dockWidgetArea(docks["properties"]) == Qt.DockWidgetArea.RightDockWidgetArea


@pytest.mark.parametrize("action", ["shortcuts", "about"])
def test_help_opens_and_closes(window: MainWindow, action: str) -> None:
    from tests.app.window.conftest import InDialog

    seen = []
    InDialog(window, lambda dialog: seen.append(dialog.windowTitle()))
    window.actions_[action].trigger()
    assert len(seen) == 1


def test_tool_tips_name_the_keys(window: MainWindow) -> None:
    tips = {b.defaultAction().objectName(): b.toolTip() for b in window.findChildren(QToolButton)
            if b.defaultAction()}  # fmt: skip
    assert tips["tool-pen"].endswith("(P)")
    assert tips["save"].endswith("(Ctrl+S)")


def test_full_screen_toggles(window: MainWindow) -> None:
    press(window, "F11")
    assert window.isFullScreen()
    press(window, "F11")
    assert not window.isFullScreen()
