"""Who gets a key: a control that has the focus comes before the shortcuts of the window."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QTabBar,
    QWidget,
)

Key = Qt.Key
ACROSS = {Key.Key_Left, Key.Key_Right}
ALONG = {Key.Key_Up, Key.Key_Down, Key.Key_PageUp, Key.Key_PageDown}
ENDS = {Key.Key_Home, Key.Key_End}
CONFIRM = {Key.Key_Return, Key.Key_Enter}
WANTED: tuple[tuple[type[QWidget], set[Qt.Key]], ...] = (
    (QAbstractButton, {Key.Key_Space}),
    (QComboBox, {Key.Key_Space, *ALONG, *ENDS, *CONFIRM}),
    (QAbstractSpinBox, {*ALONG, *CONFIRM}),
    (QLineEdit, CONFIRM),
    (QAbstractSlider, {*ACROSS, *ALONG, *ENDS}),
    (QAbstractItemView, {*ALONG, *ENDS}),
    (QTabBar, ACROSS),
)
"""The plain keys without which a control cannot be worked; text fields see to most themselves."""


class KeyManners(QObject):
    """Lets the control that has the focus take its keys, whichever it is."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._focused: QWidget | None = None
        QApplication.instance().focusChanged.connect(self._on_focus)

    def close(self) -> None:
        """Stop watching the focus."""
        QApplication.instance().focusChanged.disconnect(self._on_focus)
        self._on_focus(None, None)

    def _on_focus(self, old: QWidget | None, new: QWidget | None) -> None:
        if old is not None:
            old.removeEventFilter(self)
        if new is not None:
            new.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Accept a shortcut override for a key that the control wants."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            plain = not event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
            wanted = (keys for kind, keys in WANTED if isinstance(watched, kind))
            if plain and any(Key(event.key()) in keys for keys in wanted):
                event.accept()
                return True
        return super().eventFilter(watched, event)
