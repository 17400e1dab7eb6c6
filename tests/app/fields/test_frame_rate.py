"""The frame rate is chosen or typed; what is none is put back."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.document.session import Session
from app.fields.frame_rate import FrameRateField
from core.model import Document


@pytest.fixture
def field(qtbot: QtBot) -> FrameRateField:
    session = Session()
    field = FrameRateField(session)
    session.setParent(field)
    qtbot.addWidget(field)
    field.show()
    qtbot.waitExposed(field)
    return field


def enter(field: FrameRateField, text: str) -> float:
    """Type a rate, and return what the document has then."""
    field.activateWindow()
    field.setFocus()
    field.lineEdit().selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)
    return field._session.document.fps


@pytest.mark.parametrize(
    ("text", "fps"), [("6", 6), ("1", 1), ("29.97", 29.97), ("240", 240), ("12", 12)]
)
def test_what_is_typed_is_taken_as_it_is(field: FrameRateField, text: str, fps: float) -> None:
    assert enter(field, text) == fps
    assert field.currentText() == text


def test_looking_at_a_rate_of_many_digits_does_not_round_it(field: FrameRateField) -> None:
    fps = 24000 / 1001
    field._session.replace(Document(fps=fps))
    field.activateWindow()
    field.setFocus()
    assert enter(field, field.currentText()) == fps
    field.clearFocus()
    assert field._session.document.fps == fps
    assert not field._session.dirty


@pytest.mark.parametrize("text", ["0", "-1", "1000", "abc", "", "1e3", "nan"])
def test_what_is_no_frame_rate_is_put_back(field: FrameRateField, text: str) -> None:
    assert enter(field, text) == 24
    assert field.currentText() == "24"
    assert field._session.undo_stack.count() == 0
