"""A control that has the focus gets the keys it needs before the window's shortcuts."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QComboBox,
    QDoubleSpinBox,
    QLineEdit,
    QListWidget,
    QPushButton,
    QVBoxLayout,
    QWidget,
)
from pytestqt.qtbot import QtBot

from app.keys import KeyManners

Key = Qt.Key


class Form(QWidget):
    """One control of each kind, and a window action on every key."""

    def __init__(self) -> None:
        super().__init__()
        self.taken: list[str] = []
        self.button, self.line = QPushButton("Go"), QLineEdit()
        self.number, self.box, self.list = QDoubleSpinBox(), QComboBox(), QListWidget()
        self.box.addItems(["a", "b"])
        self.list.addItems(["a", "b"])
        column = QVBoxLayout(self)
        for widget in (self.button, self.line, self.number, self.box, self.list):
            column.addWidget(widget)
        for name in ("Space", "Return", "Down", "F5"):
            action = QAction(name, self, shortcut=QKeySequence(name))
            action.triggered.connect(self._take)
            self.addAction(action)

    def _take(self) -> None:
        self.taken.append(self.sender().text())


@pytest.fixture
def form(qtbot: QtBot) -> Iterator[Form]:
    form = Form()
    manners = KeyManners(form)
    qtbot.addWidget(form)
    form.show()
    qtbot.waitExposed(form)
    form.activateWindow()
    yield form
    manners.close()


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("button", Key.Key_Space),
        ("line", Key.Key_Return),
        ("number", Key.Key_Return),
        ("number", Key.Key_Down),
        ("box", Key.Key_Down),
        ("list", Key.Key_Down),
    ],
)
def test_a_control_gets_the_keys_it_cannot_do_without(form: Form, name: str, key: Qt.Key) -> None:
    control = getattr(form, name)
    control.setFocus()
    QTest.keyClick(control, key)
    assert form.taken == []


@pytest.mark.parametrize(
    ("name", "key", "taken"),
    [
        ("button", Key.Key_Down, "Down"),
        ("list", Key.Key_Space, "Space"),
        ("line", Key.Key_F5, "F5"),
    ],
)
def test_every_other_key_is_the_windows(form: Form, name: str, key: Qt.Key, taken: str) -> None:
    control = getattr(form, name)
    control.setFocus()
    QTest.keyClick(control, key)
    assert form.taken == [taken]
