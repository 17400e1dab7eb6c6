"""The questions about files, as they are really asked."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

import pytest
from PySide6.QtCore import QLockFile, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMessageBox, QWidget
from pytestqt.qtbot import QtBot

from app.document.autosave import Leftover
from app.files import dialogs
from tests.app.window.conftest import InDialog

Question = Callable[[QWidget], object]


def unsaved(parent: QWidget) -> object:
    return dialogs.ask_unsaved(parent, "fish")


def recovery(parent: QWidget) -> object:
    leftover = Leftover(Path("a"), Path("fish.betwixt"), datetime(2024, 1, 1), QLockFile("a"))
    return dialogs.ask_recovery(parent, leftover)


def replacing(parent: QWidget) -> object:
    return dialogs.ask_replace(parent, [Path("fish") / f"{i}.png" for i in range(3)])


def answered(question: Question, qtbot: QtBot, act: Callable[[QMessageBox], None]) -> object:
    window = QWidget()
    qtbot.addWidget(window)
    texts: list[str] = []

    def answer(box: QMessageBox) -> None:
        texts.append(box.text() + box.informativeText())
        act(box)

    InDialog(window, answer)
    result = question(window)
    assert "fish" in texts[0]
    return result


@pytest.mark.parametrize(
    ("question", "text", "answer"),
    [
        (unsaved, "&Save", "save"),
        (unsaved, "&Discard", "discard"),
        (unsaved, "&Cancel", "cancel"),
        (recovery, "&Recover", "recover"),
        (recovery, "&Discard", "discard"),
        (recovery, "&Later", "later"),
        (replacing, "&Replace", True),
        (replacing, "&Cancel", False),
    ],
)
def test_every_answer_is_understood(
    question: Question, text: str, answer: object, qtbot: QtBot
) -> None:
    def click(box: QMessageBox) -> None:
        (button,) = (button for button in box.buttons() if button.text() == text)
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)

    assert answered(question, qtbot, click) == answer


@pytest.mark.parametrize(
    ("question", "key", "answer"),
    [
        (unsaved, Qt.Key.Key_Escape, "cancel"),
        (unsaved, Qt.Key.Key_Return, "save"),
        (recovery, Qt.Key.Key_Escape, "later"),
        (recovery, Qt.Key.Key_Return, "recover"),
        (replacing, Qt.Key.Key_Escape, False),
        (replacing, Qt.Key.Key_Return, False),
    ],
)
def test_escape_loses_nothing_and_return_does_what_is_safe(
    question: Question, key: Qt.Key, answer: object, qtbot: QtBot
) -> None:
    assert answered(question, qtbot, lambda box: QTest.keyClick(box, key)) == answer
