"""A number field tells edits from what it is told to show."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QAction, QKeySequence, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QHBoxLayout, QLineEdit, QWidget
from pytestqt.qtbot import QtBot

from app.fields.number import NumberField

Key = Qt.Key


class Form(QWidget):
    """A number field beside another field."""

    def __init__(self) -> None:
        super().__init__()
        self.number = NumberField("Density", 8, 512, decimals=2)
        self.other = QLineEdit()
        row = QHBoxLayout(self)
        row.addWidget(self.other)
        row.addWidget(self.number)
        self.told: list[float] = []
        self.number.edited.connect(self.told.append)


@pytest.fixture
def form(qtbot: QtBot) -> Form:
    form = Form()
    qtbot.addWidget(form)
    form.show()
    qtbot.waitExposed(form)
    form.activateWindow()
    form.other.setFocus()
    return form


def turn_wheel(field: QWidget) -> bool:
    place = QPointF(5, 5)
    event = QWheelEvent(
        place,
        field.mapToGlobal(place),
        QPoint(),
        QPoint(0, 120),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    return QApplication.sendEvent(field, event) and event.isAccepted()


def test_showing_a_value_or_a_limit_edits_nothing(form: Form) -> None:
    form.number.show_value(100)
    form.number.limit(8, 50)
    form.number.limit(60, 512)
    form.number.show_value(1 / 3)
    assert form.told == []


def test_a_value_shown_rounded_is_not_edited_by_looking_at_it(form: Form) -> None:
    form.number.show_value(100 / 3)
    form.number.setFocus()
    form.other.setFocus()
    assert form.number.text() == "33.33"
    assert form.told == []


def test_the_wheel_changes_it_only_with_the_focus(form: Form) -> None:
    form.number.show_value(100)
    assert not turn_wheel(form.number)
    assert form.told == []
    form.number.setFocus()
    turn_wheel(form.number)
    assert form.told == [101]


def test_typing_is_told_as_it_goes_where_it_is_in_range(form: Form) -> None:
    form.number.setFocus()
    form.number.selectAll()
    QTest.keyClicks(form.number, "128")
    assert form.told == [12, 128]


def test_needless_zeros_are_not_written(form: Form) -> None:
    for value, text in ((100, "100"), (12.5, "12.5"), (12.25, "12.25")):
        form.number.show_value(value)
        assert form.number.text() == text


def test_what_is_being_typed_is_left_alone_while_it_says_the_same(form: Form) -> None:
    form.number.setFocus()
    form.number.selectAll()
    QTest.keyClicks(form.number, "12.")
    form.number.show_value(12)
    assert form.number.text() == "12."


def test_one_visit_is_one_gesture_and_return_or_leaving_begins_another(form: Form) -> None:
    form.number.setFocus()
    first = form.number.gesture
    QTest.keyClick(form.number, Key.Key_Up)
    QTest.keyClick(form.number, Key.Key_Up)
    assert form.number.gesture is first
    QTest.keyClick(form.number, Key.Key_Return)
    second = form.number.gesture
    assert second is not first
    form.other.setFocus()
    form.number.setFocus()
    assert form.number.gesture is not second


def test_undo_in_the_field_is_that_of_the_document(form: Form, qtbot: QtBot) -> None:
    action = QAction(form, shortcut=QKeySequence("Ctrl+Z"))
    form.addAction(action)
    form.number.setFocus()
    QTest.keyClicks(form.number, "12")
    with qtbot.waitSignal(action.triggered):
        QTest.keyClick(form.number, Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
