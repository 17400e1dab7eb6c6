"""The title of a panel, with buttons that are large enough to hit."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QDockWidget, QHBoxLayout, QLabel, QToolButton, QWidget

from app.icons import set_icon

ICON = QSize(14, 14)


class DockTitle(QWidget):
    """Drags the panel, as any title does; its buttons let it float, or close it."""

    def __init__(self, dock: QDockWidget) -> None:
        super().__init__(dock)
        self._dock = dock
        self.float = self._button("overlay", self.tr("Float, or dock again"))
        self.float.clicked.connect(self._toggle_floating)
        self.close_ = self._button("close", self.tr("Close; View → Panels brings it back"))
        self.close_.clicked.connect(dock.close)
        title = QLabel(dock.windowTitle())
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 1, 4, 1)
        row.setSpacing(0)
        row.addWidget(title, 1)
        row.addWidget(self.float)
        row.addWidget(self.close_)

    def _button(self, icon: str, tip: str) -> QToolButton:
        button = QToolButton(autoRaise=True, iconSize=ICON)
        set_icon(button, icon)
        button.setToolTip(tip)
        button.setAccessibleName(f"{self._dock.windowTitle()}: {tip}")
        return button

    def _toggle_floating(self) -> None:
        self._dock.setFloating(not self._dock.isFloating())
