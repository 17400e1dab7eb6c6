"""How many marks are suggested, and the buttons that take them or put them away."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QWidget

from app.jobs.suggestions import Suggestions


class SuggestionBar(QWidget):
    """Stands in the status bar while marks are placed and there are suggestions."""

    def __init__(self, suggestions: Suggestions, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._suggestions = suggestions
        self.setAccessibleName(self.tr("Suggested marks"))
        self._text = QLabel()
        self.accept = _button(self.tr("Accept all"), self.tr("Make marks of them all (Enter)"))
        self.hide_all = _button(
            self.tr("Hide"), self.tr("Show no suggestions until they are asked for again")
        )
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 12, 0)
        row.setSpacing(6)
        for widget in (self._text, self.accept, self.hide_all):
            row.addWidget(widget)
        suggestions.changed.connect(self._refresh)
        self._refresh()

    @property
    def text(self) -> str:
        """What it says."""
        return self._text.text()

    def _refresh(self) -> None:
        count = len(self._suggestions.shown)
        if count and self._suggestions.used:
            text = self.tr("Solved with suggested marks: {count}")
            tip = self.tr("The frames follow them until a mark is set; then marks alone count")
        else:
            text = self.tr("More marks suggested: {count}")
            tip = self.tr("The frames follow the marks that are set, and these once accepted")
        self._text.setText(text.format(count=count))
        self._text.setToolTip(tip)
        self.accept.setEnabled(count > 0 and self._suggestions.current)
        self.setVisible(self._suggestions.placing and count > 0)


def _button(text: str, tip: str) -> QPushButton:
    button = QPushButton(text)
    button.setToolTip(tip)
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    return button
