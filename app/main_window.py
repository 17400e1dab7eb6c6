"""The window: its parts, and how they are wired together."""

from __future__ import annotations

import os
from functools import partial
from pathlib import Path

from PySide6.QtCore import QPoint, Qt, QTimer, QUrl
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QGuiApplication
from PySide6.QtWidgets import QHBoxLayout, QMainWindow, QWidget

import resources
from app.beginning import Beginning
from app.canvas.canvas import Canvas
from app.clipboard import Clipboard
from app.commands import Commands
from app.document.autosave import Autosave
from app.document.playhead import Playhead
from app.document.selection import Selection
from app.document.session import Session
from app.entries import Desk
from app.files.files import Files
from app.files.recent_menu import RecentMenu
from app.help import show_about, show_shortcuts
from app.icons import retint
from app.jobs.frames import Frames
from app.jobs.inspector import Inspector
from app.jobs.solver import Solver
from app.jobs.suggestions import Suggestions
from app.jobs.worker import strays
from app.keys import KeyManners
from app.menus import CANVAS_MENU, PANELS, RECENT, TOOLS, TOP_BAR, Actions
from app.panels.layers import LayersPanel
from app.panels.messages import MessageBar
from app.panels.properties import PropertiesPanel
from app.panels.status import StatusStrip
from app.panels.suggestion_bar import SuggestionBar
from app.panels.welcome import WelcomePanel
from app.reporting import Reporter
from app.settings import Settings
from app.style import Theme, apply_theme
from app.timeline.timeline import Timeline
from app.window_layout import WindowLayout
from app.workspace import ViewOptions, Workspace


class MainWindow(QMainWindow):
    """One open project."""

    def __init__(self, settings: Settings, recovery: Path | None = None) -> None:
        super().__init__()
        self.settings = settings
        self.workspace = _new_workspace(self)
        settings.load_view(self.workspace.view)
        self.autosave = Autosave(self.workspace.session, recovery, self)
        self._manners = KeyManners(self)
        self._make_parts()
        self._arrange()
        self._make_actions()
        self._wire()
        self.setAcceptDrops(True)
        self.panels.restore(settings)
        self._show_title()

    # -- what it is made of --------------------------------------------------------------------

    def _make_parts(self) -> None:
        self.canvas = Canvas(self.workspace)
        self.timeline = Timeline(self.workspace)
        self.layers = LayersPanel(self.workspace)
        self.properties = PropertiesPanel(self.workspace)
        self.welcome = WelcomePanel(resources.samples(), self.settings)
        self.status = StatusStrip(self.workspace)
        self.suggested = SuggestionBar(self.workspace.suggestions)
        self.status.insertPermanentWidget(1, self.suggested)
        self.messages = MessageBar(self.canvas)
        self.files = Files(self.workspace, self.settings, self)
        self.commands = Commands(self.workspace, self)
        self.clipboard = Clipboard(self.workspace, self.commands, self.files, self)
        self.reporter = Reporter(self.workspace, self.canvas, self.files, self.messages)

    def _arrange(self) -> None:
        centre = QWidget()
        row = QHBoxLayout(centre)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addWidget(self.canvas, 1)
        row.addWidget(self.welcome)
        self.setCentralWidget(centre)
        self.setStatusBar(self.status)
        self.panels = WindowLayout(self)
        self.panels.add_side_panel("layers", self.tr("Layers"), self.layers)
        self.panels.add_side_panel("properties", self.tr("Properties"), self.properties)
        self.panels.add_timeline(self.tr("Timeline"), self.timeline)
        self.beginning = Beginning(
            self.workspace, self.canvas, self.files, self.welcome, self.panels, self
        )

    def _make_actions(self) -> None:
        w = self.workspace
        parts = (w.session, w.selection, w.playhead, w.solver, w.view, w.suggestions)
        self.actions_ = Actions(
            Desk(*parts, self.canvas, self.commands, self.files, self.clipboard, self)
        )
        self.actions_.fill_menu_bar(self.menuBar())
        recent = RecentMenu(self.actions_.menus[RECENT], self.settings)
        recent.chosen.connect(self.files.open_path)
        tools = self.panels.add_bar("tools", self.tr("Tools"), Qt.ToolBarArea.LeftToolBarArea)
        self.actions_.fill_tool_bar(tools, TOOLS)
        main = self.panels.add_bar("main", self.tr("Main"), Qt.ToolBarArea.TopToolBarArea)
        self.actions_.fill_tool_bar(main, TOP_BAR)
        for part in self.panels.parts:
            self.actions_.menus[PANELS].addAction(part.toggleViewAction())

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
            w.suggestions.changed,
            self.canvas.tool_changed,
            self.beginning.changed,
        ):
            signal.connect(self.actions_.refresh)
        w.session.file_changed.connect(self._show_title)
        self.canvas.menu_wanted.connect(self._show_canvas_menu)
        self.canvas.hint_changed.connect(self.status.set_hint)
        self.status.set_hint(self.canvas.hint)
        self.status.cancel_asked.connect(self._cancel_solving)
        self.suggested.accept.clicked.connect(self.commands.accept_suggestions)
        self.suggested.hide_all.clicked.connect(self.commands.hide_suggestions)
        self.commands.noted.connect(self.reporter.note)
        self.clipboard.noted.connect(self.reporter.note)
        self.autosave.failed.connect(self.reporter.show_refusal)
        QGuiApplication.styleHints().colorSchemeChanged.connect(self._on_desktop_theme)

    def begin(self, path: Path | None) -> None:
        """Offer what a crash left behind, or open a file, or else a sample that is moving."""
        self.canvas.setFocus()
        if not self.beginning.offer_recovery(self.autosave, self.reporter):
            self.beginning.open_first(path, self.settings.welcome)

    # -- what actions ask of the window --------------------------------------------------------

    @property
    def theme(self) -> Theme:
        """The theme in use."""
        return self.settings.theme

    def set_theme(self, theme: Theme) -> None:
        """Change the theme of the whole program."""
        self.settings.theme = theme
        apply_theme(theme)
        retint()

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
        self.beginning.end_welcome()
        self.panels.reset()

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

    def _show_canvas_menu(self, at: QPoint) -> None:
        self.actions_.pop_up(CANVAS_MENU, at)

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
        self.panels.save(self.settings)
        self.settings.save_view(self.workspace.view)
        QGuiApplication.styleHints().colorSchemeChanged.disconnect(self._on_desktop_theme)
        self.workspace.playhead.stop()
        self.actions_.close()
        self._manners.close()
        self.autosave.close()
        self.workspace.suggestions.close()
        self.workspace.inspector.close()
        self.workspace.solver.close()
        self.workspace.session.close()
        event.accept()


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
    code = int(app.exec())
    if strays():
        os._exit(code)  # everything is saved by now; to wait for what hangs would be to hang
    return code


def _new_workspace(window: QMainWindow) -> Workspace:
    session = Session(parent=window)
    selection, playhead = Selection(session, window), Playhead(session, window)
    solver = Solver(session, selection, playhead, parent=window)
    frames = Frames(window)
    inspector = Inspector(session, selection, playhead, solver, frames, parent=window)
    view = ViewOptions(window)
    suggestions = Suggestions(session, selection, playhead, solver, view, window)
    return Workspace(session, selection, playhead, solver, frames, inspector, view, suggestions)


def _files(urls: list[QUrl]) -> list[Path]:
    return [Path(url.toLocalFile()) for url in urls if url.isLocalFile()]
