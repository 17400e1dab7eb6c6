"""The message bar says what it is told, word for word."""

from __future__ import annotations

import pytest
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from app.panels.messages import MessageBar


@pytest.fixture
def window(qtbot: QtBot) -> QWidget:
    window = QWidget()
    qtbot.addWidget(window)
    window.resize(600, 400)
    window.show()
    qtbot.waitExposed(window)
    return window


@pytest.fixture
def bar(window: QWidget) -> MessageBar:
    return MessageBar(window)


def test_a_name_that_looks_like_html_is_shown_as_it_is(bar: MessageBar) -> None:
    def shown(text: str) -> tuple[int, QImage]:
        bar.show_info(text)
        return bar.height(), bar.grab().toImage()

    plain, _ = shown("Layer “shape” is locked.")
    height, image = shown("Layer “<h1>big</h1>” is locked.")
    assert height == plain
    assert image != shown("Layer “big” is locked.")[1]
