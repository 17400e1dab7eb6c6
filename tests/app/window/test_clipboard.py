"""Keyframes are copied to other frames, layers and projects; drawings come from elsewhere."""

from __future__ import annotations

from dataclasses import replace

import pytest
from PySide6.QtCore import QMimeData
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QLineEdit

from app.main_window import MainWindow
from core.io import importers
from core.model import Document, Keyframe, Layer, Outline, RingPoint
from core.model.edits import update_layer
from tests.app.window.conftest import Artist, press

SQUARE = Outline.polygon([(100, 100), (300, 100), (300, 300), (100, 300)])
LEANING = Outline.polygon([(200, 100), (400, 100), (300, 300), (100, 300)])
MARKS = (RingPoint(0, 0.0), RingPoint(0, 2.0))


def moving() -> Document:
    keys = (Keyframe(1, SQUARE, MARKS), Keyframe(25, LEANING, MARKS))
    return Document((Layer(1, "Card", keys, ("a", "b")),))


@pytest.fixture
def window(window: MainWindow) -> MainWindow:
    QGuiApplication.clipboard().clear()
    window.workspace.session.replace(moving())
    window.workspace.selection.select_key(1, 0)
    return window


def keys(window: MainWindow, layer: int = 0) -> tuple[Keyframe, ...]:
    return window.workspace.session.document.layers[layer].keyframes


def said(window: MainWindow) -> str:
    return window.messages.text


def test_a_copied_key_is_pasted_where_the_playhead_is_with_its_marks(window: MainWindow) -> None:
    before = window.workspace.session.document
    press(window, "Ctrl+C")
    assert "frame 1 of “Card”" in said(window)
    window.workspace.playhead.move_to(40)
    press(window, "Ctrl+V")
    assert [key.frame for key in keys(window)] == [1, 25, 40]
    assert (keys(window)[2].outline, keys(window)[2].marks) == (SQUARE, MARKS)
    assert window.workspace.selection.key == 2
    press(window, "Ctrl+Z")
    assert window.workspace.session.document is before


def test_pasting_on_a_key_replaces_its_drawing_alone(window: MainWindow) -> None:
    window.workspace.selection.select_key(1, 1)
    press(window, "Ctrl+C")
    window.workspace.playhead.move_to(1)
    press(window, "Ctrl+V")
    assert keys(window) == (replace(keys(window)[1], frame=1), keys(window)[1])


def test_a_cut_key_is_gone_and_can_be_pasted(window: MainWindow) -> None:
    window.workspace.selection.select_key(1, 1)
    window.workspace.playhead.move_to(25)
    press(window, "Ctrl+X")
    assert [key.frame for key in keys(window)] == [1]
    window.workspace.playhead.move_to(12)
    press(window, "Ctrl+V")
    assert [(key.frame, key.outline) for key in keys(window)] == [(1, SQUARE), (12, LEANING)]


def test_the_key_that_was_copied_is_the_one_cut_wherever_the_playhead_is(
    window: MainWindow,
) -> None:
    window.workspace.playhead.move_to(25)
    window.workspace.selection.select_key(1, 0)
    press(window, "Ctrl+X")
    assert [key.outline for key in keys(window)] == [LEANING]
    window.workspace.playhead.move_to(40)
    press(window, "Ctrl+V")
    assert [key.outline for key in keys(window)] == [LEANING, SQUARE]


def test_a_key_is_pasted_into_another_layer_with_marks_proposed(window: MainWindow) -> None:
    document = window.workspace.session.document
    other = Layer(2, "Other", (Keyframe(1, LEANING, MARKS[:1]),), ("a",))
    window.workspace.session.apply("", lambda d: replace(d, layers=(*document.layers, other)))
    press(window, "Ctrl+C")
    window.workspace.selection.select_layer(2)
    window.workspace.playhead.move_to(9)
    press(window, "Ctrl+V")
    assert [key.frame for key in keys(window, 1)] == [1, 9]
    assert keys(window, 1)[1].outline == SQUARE
    assert len(keys(window, 1)[1].marks) == 1


def test_a_key_is_pasted_into_an_empty_project_as_a_layer(
    window: MainWindow, artist: Artist
) -> None:
    press(window, "Ctrl+C")
    press(window, "Ctrl+N")
    press(window, "Ctrl+V")
    (layer,) = window.workspace.session.document.layers
    assert (layer.name, layer.style) == ("Card", moving().layers[0].style)
    assert [key.outline for key in layer.keyframes] == [SQUARE]


def test_a_locked_layer_takes_no_paste(window: MainWindow) -> None:
    press(window, "Ctrl+C")
    window.workspace.session.apply("", update_layer, 1, locked=True)
    window.workspace.playhead.move_to(9)
    press(window, "Ctrl+V")
    assert len(keys(window)) == 2
    assert "locked" in said(window)


def test_other_programs_get_what_was_copied_as_svg(window: MainWindow) -> None:
    press(window, "Ctrl+C")
    data = QGuiApplication.clipboard().mimeData()
    (part,) = importers.parse(data.text().encode(), "x", importers.SVG)
    assert part.outline.bounds() == pytest.approx(SQUARE.bounds())
    assert bytes(data.data("image/svg+xml").data()).decode() == data.text()


def test_a_drawing_that_another_program_copied_is_imported(
    window: MainWindow, artist: Artist
) -> None:
    press(window, "Ctrl+C")  # what was copied since counts
    press(window, "Ctrl+N")
    data = QMimeData()
    data.setText('<svg xmlns="http://www.w3.org/2000/svg"><rect width="500" height="200"/></svg>')
    QGuiApplication.clipboard().setMimeData(data)
    press(window, "Ctrl+V")
    (layer,) = window.workspace.session.document.layers
    assert layer.keyframes[0].outline.bounds() == pytest.approx((0, 0, 500, 200))


@pytest.mark.parametrize(
    "text", ["", "good morning", "<svg", "<svg xmlns='x'><text>hi</text></svg>"]
)
def test_what_is_no_drawing_is_not_pasted_and_it_says_so(window: MainWindow, text: str) -> None:
    before = window.workspace.session.document
    QGuiApplication.clipboard().setText(text)
    press(window, "Ctrl+V")
    assert window.workspace.session.document is before
    assert said(window)


def test_a_field_keeps_copy_and_paste_for_its_text(window: MainWindow) -> None:
    field = window.properties.findChildren(QLineEdit)[0]
    field.setFocus()
    field.selectAll()
    press(window, "Ctrl+C")
    assert QGuiApplication.clipboard().text() == field.text()
    press(window, "Ctrl+V")
    assert len(keys(window)) == 2
