"""Frames to files, with progress, Cancel, and the way to what was written."""

from __future__ import annotations

from functools import partial
from html import escape
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from app.files import dialogs
from app.files.export_form import ExportForm, Subject
from app.jobs.worker import Worker
from app.settings import Settings
from core.errors import Cancelled, MorphError

FORM, RUNNING, DONE = range(3)


def export_frames(parent: QWidget, subject: Subject, settings: Settings) -> None:
    """Ask what to export, and do it."""
    dialog = ExportDialog(subject, settings, parent)
    dialog.exec()
    dialog.deleteLater()


class ExportDialog(QDialog):
    """Three faces: the form, the progress, and what was written."""

    def __init__(self, subject: Subject, settings: Settings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._known = subject.solver.solutions()
        self._worker: Worker | None = None
        self._written: list[Path] = []
        self.setWindowTitle(self.tr("Export frames"))
        self.form = ExportForm(subject, settings)
        self._make_widgets()
        self._lay_out()
        self._listen()
        self._show_form()

    # -- doing it ------------------------------------------------------------------------------

    def start(self) -> None:
        """Write the files in the background."""
        export = self.form.export()
        paths = map(export.path, range(export.count))
        existing = [path for path in paths if path.exists()]
        if existing and not dialogs.ask_replace(self, existing):
            return
        self.form.remember()
        self.bar.setValue(0)
        self.stage.setText(self.tr("Starting"))
        self.stop_button.setEnabled(True)
        self._turn_to(RUNNING, self.stop_button)
        self._worker = Worker("export", self)
        self._worker.progressed.connect(self._on_progress)
        self._worker.done.connect(self._on_done)
        self._worker.start(partial(export.run, self._known))

    def stop(self) -> None:
        """Cancel what is under way; nothing is left behind."""
        if self._worker:
            self.stop_button.setEnabled(False)
            self.stage.setText(self.tr("Stopping"))
            self._worker.cancel()

    def show_in_folder(self) -> None:
        """Show what was written."""
        dialogs.show_folder(self._written[0].parent)
        self.accept()

    def _on_progress(self, fraction: float, stage: str) -> None:
        self.bar.setValue(round(1000 * fraction))
        self.stage.setText(stage)

    def _on_done(self, _number: int, outcome: list[Path] | MorphError | Cancelled) -> None:
        self._end()
        if isinstance(outcome, MorphError | Cancelled):
            self._show_form("" if isinstance(outcome, Cancelled) else str(outcome))
            return
        self._written = outcome
        count = len(outcome)
        text = self.tr("{count} files written") if count > 1 else self.tr("One file written")
        self.summary.setText(f"<h3>{text.format(count=count)}</h3>{escape(str(outcome[0].parent))}")
        self._turn_to(DONE, self.reveal)

    def _end(self) -> None:
        if self._worker:
            self._worker.close()
            self._worker.deleteLater()
            self._worker = None

    # -- its faces -----------------------------------------------------------------------------

    def _show_form(self, problem: str = "") -> None:
        self.problem.setText(problem)
        self.problem.setVisible(bool(problem))
        self._turn_to(FORM, self.go)
        self.adjustSize()

    def _turn_to(self, face: int, button: QPushButton) -> None:
        self.faces.setCurrentIndex(face)
        button.setDefault(True)
        button.setFocus()

    def _on_edited(self) -> None:
        """What went wrong was about the choices before."""
        self.problem.hide()
        self.go.setEnabled(self.form.ready)

    def reject(self) -> None:
        """Stop what is under way, or else close."""
        if self._worker:
            self.stop()
        else:
            super().reject()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Leave no thread behind."""
        self._end()
        super().closeEvent(event)

    def _make_widgets(self) -> None:
        self.problem = QLabel(
            wordWrap=True, objectName="problem", textFormat=Qt.TextFormat.PlainText
        )
        self.problem.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.problem.setAccessibleName(self.tr("What went wrong"))
        self.go = QPushButton(self.tr("&Export"))
        self.leave = QPushButton(self.tr("Cancel"))
        self.bar = QProgressBar(maximum=1000, textVisible=False)
        self.bar.setAccessibleName(self.tr("Progress"))
        self.stage = QLabel()
        self.stop_button = QPushButton(self.tr("&Cancel"))
        self.summary = QLabel(wordWrap=True)
        self.summary.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.reveal = QPushButton(self.tr("Show in &folder"))
        self.done_button = QPushButton(self.tr("&Close"))

    def _lay_out(self) -> None:
        self.faces = QStackedWidget()
        self.summary.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.stage.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.faces.addWidget(_face((self.form, self.problem), (self.go, self.leave)))
        self.faces.addWidget(_face((self.stage, self.bar), (self.stop_button,)))
        self.faces.addWidget(_face((self.summary,), (self.reveal, self.done_button)))
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.addWidget(self.faces)

    def _listen(self) -> None:
        self.form.edited.connect(self._on_edited)
        self.go.clicked.connect(self.start)
        self.leave.clicked.connect(self.reject)
        self.stop_button.clicked.connect(self.stop)
        self.reveal.clicked.connect(self.show_in_folder)
        self.done_button.clicked.connect(self.accept)


def _face(content: tuple[QWidget, ...], buttons: tuple[QPushButton, ...]) -> QWidget:
    face = QWidget()
    column = QVBoxLayout(face)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(12)
    column.addStretch(1)
    for widget in content:
        column.addWidget(widget)
    column.addStretch(1)
    row = QHBoxLayout()
    row.addStretch(1)
    for button in buttons:
        row.addWidget(button)
    column.addLayout(row)
    return face
