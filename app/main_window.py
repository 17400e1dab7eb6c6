"""The window: its parts, and how they are wired together."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtCore import QSize, Qt, QTimer, QUrl
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QGuiApplication
from PySide6.QtWidgets import QDockWidget, QHBoxLayout, QMainWindow, QToolBar, QWidget

import resources
from app.actions import Desk
from app.canvas.canvas import Canvas
from app.commands import Commands
from app.document.autosave import Autosave
from app.document.playhead import Playhead
from app.document.selection import Selection
from app.document.session import Session
from app.files import dialogs
from app.files.files import Files
from app.files.recent_menu import RecentMenu
from app.help import show_about, show_shortcuts
from app.icons import retint
from app.jobs.solver import Solver
from app.keys import KeyManners
from app.menus import PANELS, RECENT, TOOLS, TOP_BAR, Actions
from app.panels.layers import LayersPanel
from app.panels.messages import MessageBar
from app.panels.properties import PropertiesPanel
from app.panels.status import StatusStrip
from app.panels.welcome import WelcomePanel
from app.reporting import Reporter
from app.settings import Settings
from app.style import Theme, apply_theme
from app.timeline.timeline import Timeline
from app.workspace import ViewOptions, Workspace
from core.errors import MorphError

FIRST_SIZE = QSize(1360, 860)
SIDE_WIDTH = 288
TIMELINE_HEIGHT = 214
ICON = QSize(20, 20)


class MainWindow(QMainWindow):
    """One open project."""

    def __init__(self, settings: Settings, recovery: Path | None = None) -> None:
        super().__init__()
        self.settings = settings
        self.workspace = _new_workspace(self)
        settings.load_view(self.workspace.view)
        self._autosave = Autosave(self.workspace.session, recovery, self)
        self._manners = KeyManners(self)
        self._make_parts()
        self._make_docks()
        self._make_actions()
        self._wire()
        self.setAcceptDrops(True)
        self.resize(FIRST_SIZE.boundedTo(self.screen().availableSize()))
        self._first_layout = self.saveState()
        self._aside: list[QDockWidget] = []
        """Panels that the welcome panel stands in for."""
        self._restore_layout()
        self._show_title()

    # -- what it is made of --------------------------------------------------------------------

    def _make_parts(self) -> None:
        self.canvas = Canvas(self.workspace)
        self.timeline = Timeline(self.workspace)
        self.layers = LayersPanel(self.workspace)
        self.properties = PropertiesPanel(self.workspace)
        self.welcome = WelcomePanel(resources.samples(), self.settings)
        self.welcome.hide()
        self.status = StatusStrip(self.workspace)
        self.setStatusBar(self.status)
        self.messages = MessageBar(self.canvas)
        self.files = Files(self.workspace, self.settings, self)
        self.commands = Commands(self.workspace, self)
        self.reporter = Reporter(self.workspace, self.canvas, self.files, self.messages)
        centre = QWidget()
        row = QHBoxLayout(centre)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addWidget(self.canvas, 1)
        row.addWidget(self.welcome)
        self.setCentralWidget(centre)

    def _make_docks(self) -> None:
        area = Qt.DockWidgetArea
        self.setCorner(Qt.Corner.BottomRightCorner, area.BottomDockWidgetArea)
        self.setCorner(Qt.Corner.BottomLeftCorner, area.BottomDockWidgetArea)
        self._docks = {
            name: self._add_dock(name, title, widget, where)
            for name, title, widget, where in (
                ("layers", self.tr("Layers"), self.layers, area.RightDockWidgetArea),
                ("properties", self.tr("Properties"), self.properties, area.RightDockWidgetArea),
                ("timeline", self.tr("Timeline"), self.timeline, area.BottomDockWidgetArea),
            )
        }
        self._docks["timeline"].setTitleBarWidget(QWidget())  # its transport is title enough

    def _add_dock(
        self, name: str, title: str, widget: QWidget, area: Qt.DockWidgetArea
    ) -> QDockWidget:
        dock = QDockWidget(title, self)
        dock.setObjectName(name)
        dock.setWidget(widget)
        self.addDockWidget(area, dock)
        return dock

    def _make_actions(self) -> None:
        w = self.workspace
        desk = Desk(
            w.session,
            w.selection,
            w.playhead,
            w.solver,
            w.view,
            self.canvas,
            self.commands,
            self.files,
            self,
        )
        self.actions_ = Actions(desk)
        self.actions_.fill_menu_bar(self.menuBar())
        recent = RecentMenu(self.actions_.menus[RECENT], self.settings)
        recent.chosen.connect(self.files.open_path)
        tools = self._add_bar("tools", self.tr("Tools"), Qt.ToolBarArea.LeftToolBarArea)
        self.actions_.fill_tool_bar(tools, TOOLS)
        main = self._add_bar("main", self.tr("Main"), Qt.ToolBarArea.TopToolBarArea)
        self.actions_.fill_tool_bar(main, TOP_BAR)
        for part in (tools, main, *self._docks.values()):
            self.actions_.menus[PANELS].addAction(part.toggleViewAction())

    def _add_bar(self, name: str, title: str, area: Qt.ToolBarArea) -> QToolBar:
        bar = QToolBar(title, self)
        bar.setObjectName(name)
        bar.setIconSize(ICON)
        bar.setMovable(False)
        self.addToolBar(area, bar)
        return bar

    def _wire(self) -> None:
        w = self.workspace
        for signal in (
            w.session.changed,
            w.session.undo_stack.indexChanged,
            w.selection.changed,
            w.playhead.moved,
            w.playhead.playing_changed,
            w.playhead.loop_changed,
            w.solver.busy_changed,
            w.view.changed,
            self.canvas.tool_changed,
        ):
            signal.connect(self.actions_.refresh)
        w.session.file_changed.connect(self._show_title)
        self.canvas.hint_changed.connect(self.status.set_hint)
        self.status.set_hint(self.canvas.hint)
        self.status.cancel_asked.connect(self._cancel_solving)
        self._autosave.failed.connect(self.reporter.show_refusal)
        self.welcome.new_asked.connect(self._begin_new)
        self.welcome.open_asked.connect(self._begin_open)
        self.welcome.import_asked.connect(self._begin_import)
        self.welcome.recent_chosen.connect(self._begin_recent)
        self.welcome.sample_chosen.connect(self.play_sample)
        self.welcome.closed.connect(self.toggle_welcome)
        QGuiApplication.styleHints().colorSchemeChanged.connect(self._on_desktop_theme)

    # -- beginning -----------------------------------------------------------------------------

    def begin(self, path: Path | None) -> None:
        """Offer what a crash left behind, or open a file, or else a sample that is moving."""
        self.canvas.setFocus()
        if self._offer_recovery():
            return
        if path is not None:
            self.files.open_path(path)
            return
        if samples := resources.samples():
            self.play_sample(samples[0])
        if self.settings.welcome:
            self.toggle_welcome()

    def play_sample(self, path: Path) -> None:
        """Open a copy of a sample, moving, with the layer in hand that has most to show."""
        if self.files.open_sample(path):
            layers = self.workspace.session.document.layers
            if layers:
                main = max(layers, key=lambda layer: len(layer.labels))
                self.workspace.selection.select_layer(main.id)
            self.workspace.playhead.play()

    def _offer_recovery(self) -> bool:
        """Ask about unsaved work of a crash, the newest first; return whether some was opened."""
        for leftover in self._autosave.leftovers():
            answer = dialogs.ask_recovery(self, leftover)
            if answer == "discard":
                self._autosave.discard(leftover)
            elif answer == "recover":
                try:
                    self._autosave.recover(leftover)
                except MorphError as error:
                    self.reporter.show_refusal(error)
                    continue
                return True
        return False

    def _begin_new(self) -> None:
        if self.files.new():
            self._end_welcome()
            self.canvas.set_tool("pen")

    def _begin_open(self) -> None:
        if self.files.open():
            self._end_welcome()

    def _begin_recent(self, path: Path) -> None:
        if self.files.open_path(path):
            self._end_welcome()

    def _begin_import(self) -> None:
        """Import into a new project, unless the one that is open is the artist's."""
        if self.files.new():
            self._end_welcome()
            self.files.import_shapes()

    def _end_welcome(self) -> None:
        if self.welcoming:
            self.toggle_welcome()

    # -- what actions ask of the window --------------------------------------------------------

    @property
    def tool(self) -> str:
        """The name of the tool in hand."""
        return self.canvas.tool

    @property
    def theme(self) -> Theme:
        """The theme in use."""
        return self.settings.theme

    def set_theme(self, theme: Theme) -> None:
        """Change the theme of the whole program."""
        self.settings.theme = theme
        apply_theme(theme)
        retint()

    @property
    def welcoming(self) -> bool:
        """Whether the welcome panel is open."""
        return not self.welcome.isHidden()

    def toggle_welcome(self) -> None:
        """Open the welcome panel in place of the panels at the side, or put those back."""
        self.welcome.setVisible(not self.welcoming)
        if self.welcoming:
            side = [self._docks["layers"], self._docks["properties"]]
            self._aside = [d for d in side if not (d.isHidden() or d.isFloating())]
            for dock in self._aside:
                dock.hide()
        else:
            while self._aside:
                self._aside.pop().show()
        self.actions_.refresh()

    def toggle_full_screen(self) -> None:
        """Fill the screen, or go back to a window."""
        self.setWindowState(self.windowState() ^ Qt.WindowState.WindowFullScreen)

    def escape(self) -> None:
        """Stop playing, or else put the tool away."""
        if self.workspace.playhead.playing:
            self.workspace.playhead.stop()
        else:
            self.canvas.set_tool("select")

    def reset_layout(self) -> None:
        """Put every panel back where it was at first."""
        if self.welcoming:
            self.toggle_welcome()
        self.restoreState(self._first_layout)
        for dock in self._docks.values():
            dock.setFloating(False)
            dock.show()
        self._size_docks()

    def show_shortcuts(self) -> None:
        """List every shortcut."""
        show_shortcuts(self)

    def show_about(self) -> None:
        """Say what this program is, and under which terms it comes."""
        show_about(self)

    # -- following -----------------------------------------------------------------------------

    def _show_title(self) -> None:
        session = self.workspace.session
        self.setWindowTitle(f"{self.files.name}[*] – Betwixt")
        self.setWindowModified(session.dirty)
        self.setWindowFilePath(str(session.path or ""))

    def _cancel_solving(self) -> None:
        self.workspace.solver.cancel()
        text = self.tr("Solving was cancelled; the in-between on screen is out of date.")
        self.reporter.note(text, (self.tr("Solve again"), self._solve_again))

    def _solve_again(self) -> None:
        self.messages.clear()
        self.workspace.solver.resume()

    def _on_desktop_theme(self) -> None:
        if self.theme == "system":
            self.set_theme("system")

    def _restore_layout(self) -> None:
        if state := self.settings.window_state():
            self.restoreGeometry(state[0])
            self.restoreState(state[1])
        else:
            self._size_docks()

    def _size_docks(self) -> None:
        side = [self._docks["layers"], self._docks["properties"]]
        self.resizeDocks(side, [SIDE_WIDTH, SIDE_WIDTH], Qt.Orientation.Horizontal)
        self.resizeDocks(side, [200, 400], Qt.Orientation.Vertical)
        self.resizeDocks([self._docks["timeline"]], [TIMELINE_HEIGHT], Qt.Orientation.Vertical)

    # -- events --------------------------------------------------------------------------------

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take files."""
        if _files(event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open or import dropped files."""
        event.acceptProposedAction()
        self.activateWindow()
        self.files.take(_files(event.mimeData().urls()))

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask about unsaved work; then end everything in good order."""
        if not self.files.may_leave():
            event.ignore()
            return
        if self.welcoming:
            self.toggle_welcome()
        self.settings.save_window_state(self.saveGeometry(), self.saveState())
        self.settings.save_view(self.workspace.view)
        QGuiApplication.styleHints().colorSchemeChanged.disconnect(self._on_desktop_theme)
        self.workspace.playhead.stop()
        self.actions_.close()
        self._manners.close()
        self._autosave.close()
        self.workspace.solver.close()
        self.workspace.session.close()
        event.accept()


def _new_workspace(window: QMainWindow) -> Workspace:
    session = Session(parent=window)
    selection, playhead = Selection(session, window), Playhead(session, window)
    solver = Solver(session, selection, playhead, parent=window)
    return Workspace(session, selection, playhead, solver, ViewOptions(window))


def _files(urls: list[QUrl]) -> list[Path]:
    return [Path(url.toLocalFile()) for url in urls if url.isLocalFile()]


def run(path: Path | None) -> int:
    """Open the application, with a file if one is given; return its exit code."""
    from app.application import make_application, watch_faults

    app = make_application()
    settings = Settings()
    apply_theme(settings.theme)
    window = MainWindow(settings)
    watch_faults(window.reporter.show_fault)
    window.show()
    QTimer.singleShot(0, window, partial(window.begin, path))
    return int(app.exec())
