"""One of a few values to choose."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QWidget

from app.fields.calm import CalmWheel
from app.style import TARGET_SIZE


class Choice(CalmWheel, QComboBox):
    """A box of (text, value) options; the wheel changes it only while it has the focus."""

    edited = Signal(object)
    """The artist chose this value."""

    def __init__(
        self, name: str, options: Iterable[tuple[str, Any]], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setToolTip(name)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumHeight(TARGET_SIZE)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self._options: list[tuple[str, Any]] = []
        self.offer(options)
        self.activated.connect(self._on_activated)

    def offer(self, options: Iterable[tuple[str, Any]]) -> None:
        """Offer these options from now on; nothing is emitted."""
        options = list(options)
        if options != self._options:
            self._options = options
            self.clear()
            self.addItems([text for text, _ in options])

    def show_value(self, value: Any) -> None:
        """Show a value, or nothing if it is none of the options; nothing is emitted."""
        values = [value for _, value in self._options]
        self.setCurrentIndex(values.index(value) if value in values else -1)

    def _on_activated(self, index: int) -> None:
        self.edited.emit(self._options[index][1])
