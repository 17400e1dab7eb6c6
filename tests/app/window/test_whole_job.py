"""From an empty window to frames on the disk, by mouse and keys alone."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.canvas.moment import Role
from app.files.export_dialog import DONE, ExportDialog
from app.jobs.solver import SpanState
from app.main_window import MainWindow
from app.render.painter import render_image
from core.io import project
from core.morph.scene import picture_at
from tests.app.canvas.conftest import Hand
from tests.app.window.conftest import Artist, InDialog, press

BAR = [(200, 240), (700, 240), (700, 300), (200, 300)]
UPRIGHT = [(480, 60), (480, 480), (420, 480), (420, 60)]


def draw(hand: Hand, role: Role, corners: list[tuple[float, float]]) -> None:
    for corner in corners:
        hand.click(role, corner)
    press(hand.canvas.window(), "Return")


def solved(window: MainWindow) -> Callable[[], bool]:
    def is_solved() -> bool:
        layer = window.workspace.selection.layer
        return layer is not None and window.workspace.solver.state(layer.id, 0) is SpanState.SOLVED

    return is_solved


def test_draw_mark_solve_scrub_export_save_and_open_again(
    window: MainWindow, hand: Hand, artist: Artist, tmp_path: Path, qtbot: QtBot
) -> None:
    document = lambda: window.workspace.session.document  # noqa: E731

    press(window, "P")
    draw(hand, Role.SOURCE, BAR)
    draw(hand, Role.TARGET, UPRIGHT)
    (layer,) = document().layers
    assert [key.frame for key in layer.keyframes] == [1, 25]
    qtbot.waitUntil(solved(window))

    press(window, "M")
    for corner in BAR[:2]:
        hand.click(Role.SOURCE, hand.place(Role.SOURCE, corner))
    qtbot.waitUntil(lambda: document().layers[0].labels == ("a", "b"))
    qtbot.waitUntil(solved(window))
    qtbot.waitUntil(lambda: "sound" in window.status.badge.text())

    seen = []
    for frame in (1, 7, 13, 19, 25):
        window.workspace.playhead.move_to(frame)
        QApplication.processEvents()
        seen.append(window.canvas.panes[Role.IN_BETWEEN].grab().toImage())
    assert all(before != after for before, after in pairwise(seen))

    def export(dialog: ExportDialog) -> None:
        dialog.form.folder.setText(str(tmp_path / "frames"))
        QTest.mouseClick(dialog.go, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(lambda: dialog.faces.currentIndex() == DONE)
        artist["show"] = None
        QTest.mouseClick(dialog.reveal, Qt.MouseButton.LeftButton)

    InDialog(window, export)
    press(window, "Ctrl+E")
    assert artist.asked == ["show"]
    frames = sorted((tmp_path / "frames").iterdir())
    assert [frame.name for frame in frames] == [f"Untitled-{i:04d}.png" for i in range(1, 26)]
    on_screen = render_image(picture_at(document(), 13, window.workspace.solver.morph_of))
    assert QImage(str(frames[12])).convertToFormat(on_screen.format()) == on_screen

    artist["save"] = tmp_path / "bar"
    press(window, "Ctrl+S")
    assert window.windowTitle() == "bar[*] – Betwixt"
    assert not window.isWindowModified()
    saved = document()
    press(window, "Ctrl+N")
    assert document().layers == ()
    artist["open"] = tmp_path / "bar.betwixt"
    press(window, "Ctrl+O")
    assert document() == saved == project.load(tmp_path / "bar.betwixt")


def test_undo_back_to_the_start_and_redo_to_the_end_restore_the_identical_documents(
    window: MainWindow, hand: Hand, qtbot: QtBot
) -> None:
    session = window.workspace.session
    versions = [session.document]
    session.changed.connect(lambda document: versions.append(document))
    press(window, "P")
    draw(hand, Role.SOURCE, BAR)
    draw(hand, Role.TARGET, UPRIGHT)
    press(window, "M")
    hand.click(Role.SOURCE, hand.place(Role.SOURCE, BAR[0]))
    qtbot.waitUntil(lambda: session.document.layers[0].labels == ("a",))
    made = versions[:]
    for expected in made[-2::-1]:
        press(window, "Ctrl+Z")
        assert session.document is expected
    assert not window.isWindowModified()
    for expected in made[1:]:
        press(window, "Ctrl+Shift+Z")
        assert session.document is expected


def test_what_moves_on_screen_follows_a_drag_before_the_button_is_released(
    window: MainWindow, hand: Hand, qtbot: QtBot
) -> None:
    press(window, "P")
    draw(hand, Role.SOURCE, BAR)
    draw(hand, Role.TARGET, UPRIGHT)
    qtbot.waitUntil(solved(window))
    press(window, "N")
    window.workspace.playhead.move_to(13)
    solver = window.workspace.solver
    shown: list[np.ndarray] = []

    def look() -> None:
        rings = picture_at(window.workspace.session.document, 13, solver.morph_of).shapes[0].rings
        shown.append(rings[0])

    solver.updated.connect(look)
    start, end = BAR[1], (760, 200)
    hand.press(Role.SOURCE, start)
    for u in (0.3, 0.6, 1.0):
        place = [(1 - u) * a + u * b for a, b in zip(start, end, strict=True)]
        hand.move(Role.SOURCE, place, held=Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: bool(shown) and solved(window)())
    assert window.workspace.session.dragging
    hand.release(Role.SOURCE, end)
    assert window.workspace.session.undo_stack.undoText() == "Move nodes"
