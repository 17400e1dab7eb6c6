"""Colours are picked, typed, or none."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QColorDialog, QLineEdit, QToolButton
from pytestqt.qtbot import QtBot

from app.fields.colour import ColourField, Swatch, parse, written
from app.render.painter import colour

LEFT = Qt.MouseButton.LeftButton
channels = st.integers(0, 255)


@given(channels, channels, channels, channels)
def test_a_colour_written_and_read_is_the_same(r: int, g: int, b: int, a: int) -> None:
    text = f"#{r:02x}{g:02x}{b:02x}{a:02x}"
    value = parse(text)
    assert value is not None
    assert colour(value).getRgb() == (r, g, b, a)
    assert written(colour(value)) == value


@pytest.mark.parametrize(
    ("typed", "value"),
    [
        ("#4A90D9", "#4a90d9"),
        ("4a90d9", "#4a90d9"),
        (" #abc ", "#aabbcc"),
        ("#4a90d980", "#4a90d980"),
        ("#4a90d9ff", "#4a90d9"),
        ("", ""),
        ("none", ""),
        ("#4a90", None),
        ("blue-ish", None),
    ],
)
def test_colours_are_read_as_people_type_them(typed: str, value: str | None) -> None:
    assert parse(typed) == value


@pytest.fixture
def field(qtbot: QtBot) -> ColourField:
    field = ColourField("Fill")
    qtbot.addWidget(field)
    field.show()
    field.told = []
    field.edited.connect(field.told.append)
    field.edited.connect(field.show_value)
    return field


def enter(field: ColourField, text: str) -> None:
    line = field.findChild(QLineEdit)
    line.selectAll()
    QTest.keyClicks(line, text) if text else line.clear()
    QTest.keyClick(line, Qt.Key.Key_Return)


def test_showing_a_colour_edits_nothing(field: ColourField) -> None:
    field.show_value("#123456")
    field.show_value("")
    assert field.told == []


def test_a_typed_colour_is_told_once_and_nonsense_not_at_all(field: ColourField) -> None:
    field.show_value("#123456")
    enter(field, "#4a90d980")
    enter(field, "teapot")
    assert field.told == ["#4a90d980"]
    assert field.findChild(QLineEdit).text() == "#4a90d980"


def test_none_takes_the_colour_away_and_gives_it_back(field: ColourField) -> None:
    field.show_value("#123456")
    button = field.findChild(QToolButton)
    QTest.mouseClick(button, LEFT)
    assert button.isChecked()
    QTest.mouseClick(button, LEFT)
    assert field.told == ["", "#123456"]


def test_the_swatch_shows_none_alpha_and_colour_differently(field: ColourField) -> None:
    swatch = field.findChild(Swatch)
    seen = set()
    for value in ("", "#ffffff", "#ffffff00", "#000000"):
        field.show_value(value)
        seen.add(bytes(swatch.grab().toImage().constBits()))
    assert len(seen) == 4


def test_the_picker_opens_from_the_keyboard(field: ColourField) -> None:
    field.activateWindow()
    swatch = field.findChild(Swatch)
    swatch.setFocus(Qt.FocusReason.TabFocusReason)
    assert swatch.hasFocus()
    QTest.keyClick(swatch, Qt.Key.Key_Space)
    assert field.findChild(QColorDialog).isVisible()
    field.findChild(QColorDialog).reject()
