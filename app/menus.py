"""The menus and toolbars, as lists of action ids; and the Qt actions that are built for them."""

from __future__ import annotations

from typing import Union

from PySide6.QtCore import QObject, QPoint, Qt
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMenu, QMenuBar, QToolBar

from app.actions import ENTRIES
from app.entries import Desk, Entry, translated
from app.icons import set_icon
from app.workspace import SUGGESTIONS
from core.errors import MorphError
from core.model.easing import PRESETS

SEPARATOR = "-"
Items = tuple[Union[str, "Menu"], ...]
Menu = tuple[str, Items]
"""The title of a menu and what is in it; one without items is filled by its owner."""

RECENT = "Open &recent"
PANELS = "Pane&ls"
TOOLS = ("tool-select", "tool-nodes", "tool-pen", "tool-freehand", "tool-marks")
# fmt: off
MENUS: tuple[Menu, ...] = (
    ("&File", ("new", "open", (RECENT, ()), "-", "save", "save-as", "-", "import", "export", "-",
               "quit")),
    ("&Edit", ("undo", "redo", "-", "cut", "copy", "paste", "delete", "-", "select-all", "-",
               ("&Tool", TOOLS))),
    ("&View", ("fit", "zoom-drawing", "zoom-100", "flip", "-", "side-by-side", "overlay", "-",
               "onion", "mesh", "marks",
               ("Su&ggested marks", tuple(f"suggestions-{when}" for when in SUGGESTIONS)), "-",
               ("&Theme", ("theme-dark", "theme-light", "theme-system")), (PANELS, ()),
               "reset-layout", "full-screen")),
    ("&Layer", ("add-layer", "duplicate-layer", "remove-layer", "-", "raise-layer", "lower-layer",
                "-", "layer-above", "layer-below", "-", "layer-visible", "layer-locked")),
    ("&Keyframe", ("insert-key", "draw-key", "remove-key", "-", "previous-key", "next-key", "-",
                   ("&Easing of the span", tuple(f"easing-{preset}" for preset in PRESETS)))),
    ("&Mark", ("tool-marks", "suggest-marks", "hide-suggestions", "marks", "-", "remove-mark",
               "remove-marks")),
    ("&Playback", ("play", "play-from-start", "stop", "-", "previous-frame", "next-frame", "first",
                   "last", "-", ("At the &end", ("loop-loop", "loop-ping-pong", "loop-once")),
                   "-", "solve", "cancel")),
    ("&Help", ("welcome", "shortcuts", "-", "about")),
)
# fmt: on
TOP_BAR: Items = (
    *("new", "open", "save", "-", "import", "export", "-", "undo", "redo", "-"),
    *("side-by-side", "overlay", "-", "onion", "mesh", "-", "fit", "flip"),
)
CANVAS_MENU: Items = (
    *("cut", "copy", "paste", "delete", "-", "insert-key", "draw-key", "suggest-marks", "-"),
    *("zoom-drawing", "fit", "-", "onion", "mesh", "marks"),
)


class Actions(QObject):
    """The Qt actions of the table, kept true to how things stand."""

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk.window)
        self._desk: Desk | None = desk
        self._rows: dict[str, tuple[Entry, QAction]] = {}
        self.menus: dict[str, QMenu] = {}
        """By their title in ``MENUS``."""
        groups: dict[str, QActionGroup] = {}
        for entry in ENTRIES:
            group = groups.setdefault(entry.group, QActionGroup(self))
            policy = QActionGroup.ExclusionPolicy
            group.setExclusionPolicy(policy.ExclusiveOptional if entry.group else policy.None_)
            self._rows[entry.id] = entry, self._make(entry, group)
        for group in groups.values():
            group.triggered.connect(self._on_triggered)
        self.refresh()

    def __getitem__(self, entry_id: str) -> QAction:
        return self._rows[entry_id][1]

    def refresh(self) -> None:
        """Set what is enabled, what is on, and what is called how."""
        desk = self._desk
        if desk is None:
            return
        for entry, action in self._rows.values():
            if entry.when:
                action.setEnabled(entry.when(desk))
            if entry.on:
                action.setChecked(entry.on(desk))
            if entry.title:
                action.setText(entry.title(desk).rstrip())

    def close(self) -> None:
        """Let go of everything that actions act on."""
        self._desk = None

    def fill_menu_bar(self, bar: QMenuBar) -> None:
        """Build every menu."""
        for menu in MENUS:
            self._fill(bar, menu)

    def fill_tool_bar(self, bar: QToolBar, items: Items) -> None:
        """Add actions to a toolbar, each with its keys in the tip."""
        for item in items:
            if item == SEPARATOR:
                bar.addSeparator()
            else:
                bar.addAction(self[str(item)])

    def pop_up(self, items: Items, at: QPoint) -> None:
        """Show some actions in a menu at a place on the screen; gone once it is closed."""
        menu = QMenu(self._desk.window)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._add(menu, items)
        menu.popup(at)

    def _fill(self, parent: QMenuBar | QMenu, menu: Menu) -> None:
        title, items = menu
        filled = parent.addMenu(translated(title))
        self.menus[title] = filled
        self._add(filled, items)

    def _add(self, filled: QMenu, items: Items) -> None:
        for item in items:
            if isinstance(item, tuple):
                self._fill(filled, item)
            elif item == SEPARATOR:
                filled.addSeparator()
            else:
                filled.addAction(self[item])

    def _make(self, entry: Entry, group: QActionGroup) -> QAction:
        action = QAction(translated(entry.text), group)
        action.setObjectName(entry.id)
        action.setCheckable(entry.on is not None)
        action.setIconVisibleInMenu(entry.on is None)  # else it would stand where the tick does
        action.setShortcuts([QKeySequence(key) for key in entry.keys])
        plain = translated(entry.text).replace("&", "").rstrip("…")
        keys = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
        action.setToolTip(f"{plain} ({keys})" if keys else plain)
        if entry.icon:
            set_icon(action, entry.icon)
        self._desk.window.addAction(action)  # so that its keys work whatever is shown
        return action

    def _on_triggered(self, action: QAction) -> None:
        desk = self._desk
        if desk is None:
            return
        entry, _ = self._rows[action.objectName()]
        try:
            entry.do(desk)
        except MorphError as error:
            desk.session.failed.emit(error)
        self.refresh()
