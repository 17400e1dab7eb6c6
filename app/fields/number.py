"""A number to type, step or spin."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QDoubleSpinBox, QWidget

from app.fields.calm import CalmWheel
from app.style import TARGET_SIZE


class NumberField(CalmWheel, QDoubleSpinBox):
    """A spin box that tells what the artist did apart from what it was told to show.

    The wheel changes it only while it has the focus, so that a panel can be scrolled over it.
    """

    edited = Signal(float)
    """The artist changed the value."""

    def __init__(
        self,
        name: str,
        least: float,
        most: float,
        *,
        decimals: int = 0,
        step: float = 1.0,
        suffix: str = "",
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(
            parent, decimals=decimals, minimum=least, maximum=most, singleStep=step, suffix=suffix
        )
        self.setAccessibleName(name)
        self.setToolTip(name)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumHeight(TARGET_SIZE)
        self.setCorrectionMode(QDoubleSpinBox.CorrectionMode.CorrectToNearestValue)
        self._gesture = object()
        self._limits = least, most
        self.valueChanged.connect(self.edited)
        self.lineEdit().returnPressed.connect(self._end_gesture)

    @property
    def gesture(self) -> object:
        """What the edits of one visit have in common: from focus, or Return, to the next."""
        return self._gesture

    def show_value(self, value: float) -> None:
        """Show a value; nothing is emitted, and text being typed is left alone if it says so.

        What may not be typed is shown as it is, too: a file may hold it.
        """
        least, most = self._limits
        with QSignalBlocker(self):
            self._set_range(min(least, value), max(most, value))
            if self.value() != round(value, self.decimals()):
                self.setValue(value)

    def limit(self, least: float, most: float) -> None:
        """Set what may be typed; nothing is emitted, whatever value is shown."""
        self._limits = least, most
        with QSignalBlocker(self):
            self._set_range(least, most)

    def textFromValue(self, value: float) -> str:
        """Write a number without needless zeros."""
        text = super().textFromValue(value)
        point = self.locale().decimalPoint()
        return text.rstrip("0").removesuffix(point) if point in text else text

    def event(self, event: QEvent) -> bool:
        """Leave undo and redo to the document, where every change of the value already is."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            history = (QKeySequence.StandardKey.Undo, QKeySequence.StandardKey.Redo)
            if any(event.matches(key) for key in history):
                event.ignore()
                return False
        return super().event(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Begin a gesture."""
        self._end_gesture()
        super().focusInEvent(event)

    def _set_range(self, least: float, most: float) -> None:
        if (self.minimum(), self.maximum()) != (least, most):  # else a held arrow would stop
            self.setRange(least, most)

    def _end_gesture(self) -> None:
        self._gesture = object()
