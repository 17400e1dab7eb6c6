"""The recent files, with those that are gone greyed."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from app.settings import Settings


class RecentMenu(QObject):
    """Fills a menu anew each time it opens, for files come and go."""

    chosen = Signal(object)
    """The Path of a file."""

    def __init__(self, menu: QMenu, settings: Settings) -> None:
        super().__init__(menu)
        self._menu, self._settings = menu, settings
        menu.aboutToShow.connect(self.fill)
        menu.triggered.connect(self._on_triggered)

    def fill(self) -> None:
        """List the files."""
        self._menu.clear()
        for number, path in enumerate(self._settings.recent, 1):
            name = path.name.replace("&", "&&")
            action = self._menu.addAction(f"&{number % 10}  {name}   –   {path.parent}")
            action.setData(path)
            action.setEnabled(path.is_file())
        empty = self._menu.isEmpty()
        self._menu.addSeparator()
        clear = self._menu.addAction(self.tr("No recent files") if empty else self.tr("&Clear"))
        clear.setEnabled(not empty)

    def _on_triggered(self, action: QAction) -> None:
        path = action.data()
        if isinstance(path, Path):
            self.chosen.emit(path)
        else:
            self._settings.clear_recent()
