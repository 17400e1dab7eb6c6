"""What the program remembers between two runs. Nothing of the artist's work is kept here."""

from __future__ import annotations

import re
from pathlib import Path

from PySide6.QtCore import QByteArray, QObject, QSettings, QStandardPaths, Signal

from app.style import THEMES, Theme
from app.workspace import SUGGESTIONS, ViewOptions

RECENT = 10
VIEW_OPTIONS = ("mesh", "onion", "marks")
COUNTS, TINTS = ("onion_before", "onion_after"), ("tint_before", "tint_after")
COUNT = re.compile("[0-9]")
TINT = re.compile("#[0-9a-f]{6}([0-9a-f]{2})?")


class Settings(QObject):
    """Reads and writes at once; a missing or damaged entry is its default."""

    recent_changed = Signal()

    def __init__(self, store: QSettings | None = None, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._store = store or QSettings(
            QSettings.Format.IniFormat, QSettings.Scope.UserScope, "Betwixt", "Betwixt"
        )

    @property
    def theme(self) -> Theme:
        """The theme the artist chose."""
        value = self._store.value("theme")
        return value if value in THEMES else "dark"

    @theme.setter
    def theme(self, theme: Theme) -> None:
        self._store.setValue("theme", theme)

    @property
    def welcome(self) -> bool:
        """Whether the welcome panel opens at the start."""
        return self._flag("welcome", True)

    @welcome.setter
    def welcome(self, shown: bool) -> None:
        self._store.setValue("welcome", shown)

    # -- files ---------------------------------------------------------------------------------

    @property
    def recent(self) -> list[Path]:
        """Files opened or saved last, newest first; some may be gone."""
        values = self._store.value("recent") or []
        return [Path(value) for value in ([values] if isinstance(values, str) else values) if value]

    def add_recent(self, path: Path) -> None:
        """Put a file first among the recent ones."""
        path = path.absolute()
        paths = [path, *(other for other in self.recent if other != path)][:RECENT]
        self._store.setValue("recent", [str(path) for path in paths])
        self.recent_changed.emit()

    def clear_recent(self) -> None:
        """Forget the recent files."""
        self._store.remove("recent")
        self.recent_changed.emit()

    def folder(self, purpose: str) -> Path:
        """Return the folder last used for a purpose: "project", "import" or "export"."""
        value = self._store.value(f"folders/{purpose}")
        if isinstance(value, str) and Path(value).is_dir():
            return Path(value)
        place = QStandardPaths.StandardLocation.DocumentsLocation
        return Path(QStandardPaths.writableLocation(place) or Path.home())

    def set_folder(self, purpose: str, folder: Path) -> None:
        """Remember a folder for a purpose."""
        self._store.setValue(f"folders/{purpose}", str(folder))

    # -- window --------------------------------------------------------------------------------

    def load_view(self, view: ViewOptions) -> None:
        """Show what was shown last."""
        options: dict[str, object] = {
            name: self._flag(f"view/{name}", getattr(view, name)) for name in VIEW_OPTIONS
        }
        for names, form, kind in ((COUNTS, COUNT, int), (TINTS, TINT, str)):
            texts = {name: str(self._store.value(f"view/{name}")) for name in names}
            options |= {name: kind(text) for name, text in texts.items() if form.fullmatch(text)}
        layout = "overlay" if self._store.value("view/layout") == "overlay" else "side by side"
        when = self._store.value("view/suggestions")
        suggestions = when if when in SUGGESTIONS else view.suggestions
        view.update(**options, layout=layout, suggestions=suggestions)

    def save_view(self, view: ViewOptions) -> None:
        """Remember what is shown."""
        for name in (*VIEW_OPTIONS, *COUNTS, *TINTS, "layout", "suggestions"):
            self._store.setValue(f"view/{name}", getattr(view, name))

    def window_state(self) -> tuple[QByteArray, QByteArray] | None:
        """Return the geometry and the docks of the window as they were."""
        geometry, docks = (self._store.value(f"window/{name}") for name in ("geometry", "docks"))
        if isinstance(geometry, QByteArray) and isinstance(docks, QByteArray):
            return geometry, docks
        return None

    def save_window_state(self, geometry: QByteArray, docks: QByteArray) -> None:
        """Remember the geometry and the docks of the window."""
        self._store.setValue("window/geometry", geometry)
        self._store.setValue("window/docks", docks)

    # -- export --------------------------------------------------------------------------------

    def choice(self, name: str, default: str) -> str:
        """Return what was last chosen in a dialog."""
        value = self._store.value(f"choices/{name}")
        return value if isinstance(value, str) else default

    def set_choice(self, name: str, value: str) -> None:
        """Remember what was chosen in a dialog."""
        self._store.setValue(f"choices/{name}", value)

    def _flag(self, key: str, default: bool) -> bool:
        value = self._store.value(key)
        return default if value is None else str(value).lower() == "true"
