"""The welcome panel makes room as soon as the artist works on something of their own."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt

import resources
from app.canvas.moment import Role
from app.main_window import MainWindow
from core.io import project
from core.model import Document
from tests.app.canvas.conftest import Hand
from tests.app.window.conftest import Artist, press


@pytest.fixture
def window(window: MainWindow) -> MainWindow:
    window.beginning.open_first(None, welcome=True)
    window.workspace.playhead.stop()
    return window


def makes_room(window: MainWindow) -> bool:
    docks = [window.panels.docks[name].isVisible() for name in ("layers", "properties")]
    assert docks == [not window.beginning.welcoming] * 2
    return not window.beginning.welcoming


def test_it_stays_while_samples_are_looked_at(window: MainWindow) -> None:
    for sample in resources.samples()[:2]:
        window.beginning.play_sample(sample)
        press(window, "Space")
        press(window, "Home")
        assert not makes_room(window)


def test_a_new_project_has_the_room(window: MainWindow) -> None:
    press(window, "Ctrl+N")
    assert makes_room(window)


def test_an_opened_project_has_the_room(window: MainWindow, artist: Artist, tmp_path: Path) -> None:
    project.save(Document(), tmp_path / "mine.betwixt")
    artist["open"] = tmp_path / "mine.betwixt"
    press(window, "Ctrl+O")
    assert makes_room(window)


def test_the_first_edit_makes_room(window: MainWindow, hand: Hand) -> None:
    outline = window.workspace.selection.layer.keyframes[0].outline
    hand.click(Role.SOURCE, outline.rings[0].points.mean(axis=0))
    assert not makes_room(window)
    hand.key(Role.SOURCE, Qt.Key.Key_Left)
    assert hand.steps == ["Move outline"]
    assert makes_room(window)
    press(window, "Ctrl+Z")
    assert makes_room(window)
