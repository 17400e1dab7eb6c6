"""What is open when the window opens, and what the welcome panel leads to."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Signal

import resources
from app.canvas.canvas import Canvas
from app.document.autosave import Autosave
from app.files import dialogs
from app.files.files import Files
from app.panels.welcome import WelcomePanel
from app.reporting import Reporter
from app.window_layout import WindowLayout
from app.workspace import Workspace
from core.errors import MorphError


class Beginning(QObject):
    """Opens recovered work, a file, or a sample; opens and closes the welcome panel."""

    changed = Signal()
    """The welcome panel opened or closed."""

    def __init__(
        self,
        workspace: Workspace,
        canvas: Canvas,
        files: Files,
        welcome: WelcomePanel,
        layout: WindowLayout,
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._workspace, self._canvas, self._files = workspace, canvas, files
        self._welcome, self._layout = welcome, layout
        welcome.hide()
        workspace.session.replaced.connect(self._on_replaced)
        workspace.session.undo_stack.indexChanged.connect(self._on_step)
        welcome.new_asked.connect(self._new)
        welcome.open_asked.connect(self._open)
        welcome.import_asked.connect(self._import)
        welcome.recent_chosen.connect(self._open_recent)
        welcome.sample_chosen.connect(self.play_sample)
        welcome.closed.connect(self.end_welcome)

    def open_first(self, path: Path | None, welcome: bool) -> None:
        """Open a file, or else a sample that is moving, with the welcome panel if wanted."""
        if path is not None:
            self._files.take([path])
            return
        if samples := resources.samples():
            self.play_sample(samples[0])
        if welcome:
            self.toggle_welcome()

    def offer_recovery(self, autosave: Autosave, reporter: Reporter) -> bool:
        """Ask about unsaved work of a crash, the newest first; return whether some was opened."""
        for leftover in autosave.leftovers():
            answer = dialogs.ask_recovery(self._canvas.window(), leftover)
            if answer == "discard":
                autosave.discard(leftover)
            elif answer == "recover":
                try:
                    autosave.recover(leftover)
                except MorphError as error:
                    reporter.show_refusal(error)
                    continue
                return True
        return False

    def play_sample(self, path: Path) -> None:
        """Open a copy of a sample, moving, with the layer in hand that has most to show."""
        if not self._files.open_sample(path):
            return
        if layers := self._workspace.session.document.layers:
            main = max(layers, key=lambda layer: len(layer.labels))
            self._workspace.selection.select_layer(main.id)
        self._workspace.playhead.play()

    # -- the welcome panel ---------------------------------------------------------------------

    @property
    def welcoming(self) -> bool:
        """Whether the welcome panel is open."""
        return not self._welcome.isHidden()

    def toggle_welcome(self) -> None:
        """Open the welcome panel in place of the panels at the side, or close it."""
        if self.welcoming:
            self.end_welcome()
        else:
            self._layout.put_aside()
            self._welcome.show()
            self.changed.emit()

    def end_welcome(self) -> None:
        """Close the welcome panel and bring back what it stood in for."""
        self._welcome.hide()
        self._layout.bring_back()
        self.changed.emit()

    def _on_replaced(self) -> None:
        """Make room for a project of the artist's own; samples are for looking around."""
        session = self._workspace.session
        if self.welcoming and (session.path is not None or not session.document.layers):
            self.end_welcome()

    def _on_step(self, index: int) -> None:
        """Make room for the first edit."""
        if index and self.welcoming:
            self.end_welcome()

    def _new(self) -> None:
        if self._files.new():
            self._canvas.set_tool("pen")

    def _open(self) -> None:
        self._files.open()

    def _open_recent(self, path: Path) -> None:
        self._files.open_path(path)

    def _import(self) -> None:
        """Import into a new project: what is open is a sample, or was saved."""
        if self._files.new():
            self._files.import_shapes()
