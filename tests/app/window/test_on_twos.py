"""Drawings that are held for several frames: on screen as in the files, and in the project."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.canvas.moment import Role
from app.files.export_dialog import DONE, ExportDialog
from app.main_window import MainWindow
from core.io import project
from core.model import Document, Keyframe, Layer, Outline
from tests.app.window.conftest import Artist, InDialog, press

BAR = Outline.polygon([(200, 240), (700, 240), (700, 300), (200, 300)])
UPRIGHT = Outline.polygon([(480, 60), (480, 480), (420, 480), (420, 60)])


@pytest.fixture
def on_twos(window: MainWindow, qtbot: QtBot) -> MainWindow:
    """A bar that turns from frame 1 to 6, and is put on twos by the keyboard."""
    workspace = window.workspace
    keys = (Keyframe(1, BAR), Keyframe(6, UPRIGHT))
    workspace.session.replace(Document((Layer(1, "bar", keys),)))
    field = window.properties.document.hold
    field.setFocus()
    QTest.keyClick(field, Qt.Key.Key_Down)
    assert workspace.session.document.hold == 2
    qtbot.waitUntil(lambda: not workspace.solver.busy and not workspace.inspector.busy)
    return window


def seen(window: MainWindow, frame: float) -> QImage:
    """What the in-between looks like, without what tools paint and the title."""
    window.workspace.playhead.move_to(frame)
    QApplication.processEvents()
    return window.canvas.panes[Role.IN_BETWEEN].view.grab().toImage()


def test_the_screen_holds_each_drawing_and_every_key_is_seen(on_twos: MainWindow) -> None:
    on_twos.workspace.view.update(onion=False)
    first, second, third, fourth, fifth, key = (seen(on_twos, frame) for frame in range(1, 7))
    assert first == second
    assert third == fourth
    for before, after in ((second, third), (fourth, fifth), (fifth, key)):
        assert before != after
    assert seen(on_twos, 3.5) != third
    press(on_twos, "Ctrl+Z")
    assert seen(on_twos, 4) != third


def test_files_hold_what_the_screen_holds(
    on_twos: MainWindow, artist: Artist, tmp_path: Path, qtbot: QtBot
) -> None:
    def export(dialog: ExportDialog) -> None:
        dialog.form.folder.setText(str(tmp_path / "frames"))
        QTest.mouseClick(dialog.go, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(lambda: dialog.faces.currentIndex() == DONE)

    InDialog(on_twos, export)
    press(on_twos, "Ctrl+E")
    files = [path.read_bytes() for path in sorted((tmp_path / "frames").iterdir())]
    assert len(files) == 6
    assert [files.index(file) for file in files] == [0, 0, 2, 2, 4, 5]


def test_a_project_remembers_how_long_drawings_are_held(
    on_twos: MainWindow, artist: Artist, tmp_path: Path
) -> None:
    artist["save"] = tmp_path / "bar.betwixt"
    press(on_twos, "Ctrl+S")
    assert project.load(tmp_path / "bar.betwixt") == on_twos.workspace.session.document
