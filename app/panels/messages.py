"""One message at a time over the canvas: what is wrong, and the button that mends it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QRect, Qt, Signal
from PySide6.QtGui import QAccessible, QAccessibleEvent, QKeyEvent
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from app.icons import pixmap, set_icon
from app.style import colours
from core.errors import MorphError

Action = tuple[str, Callable[[], object]]
"""The text of a button and what it does."""

MARGIN = 10
WIDEST = 860


class MessageBar(QFrame):
    """Floats at the foot of its parent, so that nothing moves under the mouse when it appears."""

    closed = Signal()
    """The artist closed the message."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Message"))
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._error = False
        self._actions: tuple[Action, ...] = ()
        self._icon = QLabel()
        self._text = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)
        self._text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self._buttons = (QPushButton(), QPushButton())
        self._buttons[0].clicked.connect(self._do_first)
        self._buttons[1].clicked.connect(self._do_second)
        self._close = QToolButton()
        set_icon(self._close, "close")
        self._close.setAccessibleName(self.tr("Close message"))
        self._close.setToolTip(self.tr("Close message"))
        self._close.clicked.connect(self.dismiss)
        for button in self._buttons:  # a click leaves the keys with what is worked on
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 8, 8, 8)
        row.setSpacing(10)
        for widget in (self._icon, self._text, *self._buttons, self._close):
            row.addWidget(widget, alignment=Qt.AlignmentFlag.AlignVCenter)
        row.setStretch(1, 1)
        parent.installEventFilter(self)
        self.hide()

    @property
    def text(self) -> str:
        """The message on show; empty when there is none."""
        return "" if self.isHidden() else self._text.text()

    def show_error(self, error: MorphError, *actions: Action, about: str = "") -> None:
        """Show what is wrong and how to mend it, with up to two buttons."""
        self._show(f"{about}{error}", True, actions)

    def show_info(self, text: str, *actions: Action) -> None:
        """Show what happened, with up to two buttons."""
        self._show(text, False, actions)

    def clear(self) -> None:
        """Take the message away; the keys go back to what it lay over."""
        focused = QApplication.focusWidget()
        if focused is not None and self.isAncestorOf(focused):
            self.parentWidget().setFocus()
        self.hide()

    def dismiss(self) -> None:
        """Take the message away on the artist's wish."""
        self.clear()
        self.closed.emit()

    def _show(self, text: str, error: bool, actions: tuple[Action, ...]) -> None:
        self._error, self._actions = error, actions
        self._text.setText(text)
        for i, button in enumerate(self._buttons):
            button.setVisible(i < len(actions))
            button.setText(actions[i][0] if i < len(actions) else "")
        self._dress()
        self.show()
        self.raise_()
        self._place()
        self.setAccessibleDescription(text)
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))

    def _do_first(self) -> None:
        self._do(0)

    def _do_second(self) -> None:
        self._do(1)

    def _do(self, index: int) -> None:
        _, callback = self._actions[index]
        callback()

    def _dress(self) -> None:
        """Take the look that the style sheet has for the tone of the message."""
        self.setProperty("tone", "error" if self._error else "note")
        self.style().unpolish(self)
        self.style().polish(self)
        self._show_icon()

    def _show_icon(self) -> None:
        name = "error" if self._error else "info"
        self._icon.setPixmap(pixmap(name, 20, colours().text, self.devicePixelRatioF()))

    def _place(self) -> None:
        """Sit at the foot of the parent, as wide as the text wants and the parent allows."""
        parent = self.parentWidget()
        width = min(WIDEST, parent.width() - 2 * MARGIN)
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        left = (parent.width() - width) // 2
        self.setGeometry(QRect(left, parent.height() - height - MARGIN, width, height))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Close on Escape."""
        if event.key() == Qt.Key.Key_Escape:
            self.dismiss()
        else:
            super().keyPressEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        """Follow the theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and not self.isHidden():
            self._show_icon()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the size of the parent."""
        if event.type() == QEvent.Type.Resize and not self.isHidden():
            self._place()
        return super().eventFilter(watched, event)
