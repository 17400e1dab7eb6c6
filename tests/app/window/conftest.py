"""The real window, driven by keys and mouse; and an artist who answers its questions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QEvent, QKeyCombination, QObject, QSettings, QTimer
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files import dialogs
from app.main_window import MainWindow
from app.settings import Settings
from app.style import apply_theme
from tests.app.canvas.conftest import Hand


class Artist:
    """Answers dialogs with what the test says; a question that was not expected fails."""

    def __init__(self) -> None:
        self.answers: dict[str, Any] = {}
        self.asked: list[str] = []

    def __setitem__(self, question: str, answer: Any) -> None:
        self.answers[question] = answer

    def listen(self, question: str) -> Callable[..., Any]:
        def answer(*_: Any) -> Any:
            assert question in self.answers, f"was asked {question}"
            self.asked.append(question)
            return self.answers[question]

        return answer


@pytest.fixture
def artist(monkeypatch: pytest.MonkeyPatch) -> Artist:
    someone = Artist()
    for question in ("open", "save", "folder", "unsaved", "recovery", "replace"):
        monkeypatch.setattr(dialogs, f"ask_{question}", someone.listen(question))
    monkeypatch.setattr(dialogs, "show_folder", someone.listen("show"))
    monkeypatch.setattr("app.files.files.ask_parts", someone.listen("parts"))
    return someone


@pytest.fixture(scope="module")
def dressed(qapp: QApplication) -> Iterator[None]:
    """Dress the application, and undress it for the tests of others."""
    before = qapp.style().objectName(), qapp.palette(), qapp.styleSheet(), qapp.font()
    apply_theme("dark")
    yield
    qapp.setStyle(before[0])
    qapp.setPalette(before[1])
    qapp.setStyleSheet(before[2])
    qapp.setFont(before[3])


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat))


@pytest.fixture
def open_window(
    dressed: None, artist: Artist, settings: Settings, tmp_path: Path, qtbot: QtBot
) -> Iterator[Callable[[], MainWindow]]:
    """Open a window; each has the same settings and recovery folder, as on one computer."""
    windows: list[MainWindow] = []

    def open_it() -> MainWindow:
        window = MainWindow(settings, tmp_path / "recovery")
        windows.append(window)
        window.resize(1280, 800)
        window.show()
        qtbot.waitExposed(window)
        window.activateWindow()
        window.canvas.setFocus()
        return window

    yield open_it
    artist["unsaved"] = "discard"
    for window in windows:
        window.close()
        window.deleteLater()
        QApplication.sendPostedEvents(window, QEvent.Type.DeferredDelete)


@pytest.fixture
def window(open_window: Callable[[], MainWindow]) -> MainWindow:
    return open_window()


@pytest.fixture
def hand(window: MainWindow) -> Hand:
    return Hand(window.canvas, window.workspace)


class InDialog(QObject):
    """Does something in the next dialog that opens, and then sees to it that it is closed."""

    def __init__(self, parent: QObject, act: Callable[[Any], None]) -> None:
        super().__init__(parent)
        self._act = act
        self._timer = QTimer(self, interval=5)
        self._timer.timeout.connect(self._look)
        self._timer.start()

    def _look(self) -> None:
        dialog = QApplication.activeModalWidget()
        if dialog is not None:
            self._timer.stop()
            try:
                self._act(dialog)
            finally:
                dialog.close()


def press(window: MainWindow, keys: str) -> None:
    """Press a key combination in whatever has the focus."""
    window.activateWindow()  # a window system does that after a dialog
    QApplication.processEvents()
    combination: QKeyCombination = QKeySequence(keys)[0]
    receiver = QApplication.focusWidget() or window
    QTest.keyClick(receiver, combination.key(), combination.keyboardModifiers())
    QApplication.processEvents()
