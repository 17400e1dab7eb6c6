"""Where the panels of the window are: at first, as the artist put them, and again as at first."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QObject, QSize, Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QToolBar, QWidget

from app.dock_title import DockTitle
from app.settings import Settings

FIRST_SIZE = QSize(1360, 860)
SIDE_WIDTH = 288
LAYERS_HEIGHT, PROPERTIES_HEIGHT = 200, 400
TIMELINE_HEIGHT = 214
ICON = QSize(20, 20)


class WindowLayout(QObject):
    """The docks and toolbars of a window."""

    def __init__(self, window: QMainWindow) -> None:
        super().__init__(window)
        self._window = window
        self.docks: dict[str, QDockWidget] = {}
        self._bars: list[QToolBar] = []
        self._aside: list[QDockWidget] = []
        """Panels that another one stands in for."""
        area = Qt.DockWidgetArea.BottomDockWidgetArea
        window.setCorner(Qt.Corner.BottomRightCorner, area)
        window.setCorner(Qt.Corner.BottomLeftCorner, area)

    def add_side_panel(self, name: str, title: str, panel: QWidget) -> None:
        """Add a panel at the right; ``name`` is what the layout is remembered by."""
        self._add(name, title, panel, Qt.DockWidgetArea.RightDockWidgetArea)
        self.docks[name].setTitleBarWidget(DockTitle(self.docks[name]))

    def add_timeline(self, title: str, timeline: QWidget) -> None:
        """Add the timeline over the full width; its transport is title enough."""
        self._add("timeline", title, timeline, Qt.DockWidgetArea.BottomDockWidgetArea)
        self.docks["timeline"].setTitleBarWidget(QWidget())

    def add_bar(self, name: str, title: str, area: Qt.ToolBarArea) -> QToolBar:
        """Add an empty toolbar."""
        bar = QToolBar(title, self._window)
        bar.setObjectName(name)
        bar.setIconSize(ICON)
        bar.setMovable(False)
        self._window.addToolBar(area, bar)
        self._bars.append(bar)
        return bar

    @property
    def parts(self) -> Iterable[QToolBar | QDockWidget]:
        """Everything that can be shown and hidden."""
        return (*self._bars, *self.docks.values())

    # -- as it was, and as it was at first -----------------------------------------------------

    def restore(self, settings: Settings) -> None:
        """Put everything where the artist had it; called once all parts are there."""
        self._window.resize(FIRST_SIZE.boundedTo(self._window.screen().availableSize()))
        self._first = self._window.saveState()
        if state := settings.window_state():
            self._window.restoreGeometry(state[0])
            self._window.restoreState(state[1])
        else:
            self._size()

    def save(self, settings: Settings) -> None:
        """Remember where everything is."""
        self.bring_back()
        settings.save_window_state(self._window.saveGeometry(), self._window.saveState())

    def reset(self) -> None:
        """Put everything back where it was at first."""
        self._aside.clear()
        self._window.restoreState(self._first)
        for dock in self.docks.values():
            dock.setFloating(False)
            dock.show()
        self._size()

    # -- standing in ---------------------------------------------------------------------------

    def put_aside(self) -> None:
        """Hide the panels at the side, for something else to take their place."""
        self._aside = [
            dock
            for name, dock in self.docks.items()
            if name != "timeline" and not (dock.isHidden() or dock.isFloating())
        ]
        for dock in self._aside:
            dock.hide()

    def bring_back(self) -> None:
        """Show the panels again that were put aside."""
        while self._aside:
            self._aside.pop().show()

    def _add(self, name: str, title: str, panel: QWidget, area: Qt.DockWidgetArea) -> None:
        dock = QDockWidget(title, self._window)
        dock.setObjectName(name)
        dock.setWidget(panel)
        self._window.addDockWidget(area, dock)
        self.docks[name] = dock

    def _size(self) -> None:
        side = [self.docks["layers"], self.docks["properties"]]
        across, down = Qt.Orientation.Horizontal, Qt.Orientation.Vertical
        self._window.resizeDocks(side, [SIDE_WIDTH, SIDE_WIDTH], across)
        self._window.resizeDocks(side, [LAYERS_HEIGHT, PROPERTIES_HEIGHT], down)
        self._window.resizeDocks([self.docks["timeline"]], [TIMELINE_HEIGHT], down)
