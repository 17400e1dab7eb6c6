"""What is to be exported: format, frames, size, background, and where to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QColor, QPixmap
from PySide6.QtWidgets import (
    QColorDialog,
    QComboBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QSpinBox,
    QToolButton,
    QWidget,
)

from app.document.playhead import Playhead
from app.files import dialogs
from app.icons import set_icon
from app.jobs.export import Export
from app.jobs.solver import Solver
from app.render.formats import BY_KEY, FORMATS
from app.settings import Settings
from core.io.exporters import LONGEST_SIDE
from core.model import Document

DOCUMENT, TRANSPARENT, COLOUR = range(3)
NOT_IN_NAMES = set('/\\:*?"<>|')


@dataclass(frozen=True)
class Subject:
    """What is exported."""

    document: Document
    name: str
    playhead: Playhead
    solver: Solver


class ExportForm(QWidget):
    """Shows at once which files the choices make."""

    edited = Signal()

    def __init__(self, subject: Subject, settings: Settings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._subject, self._settings = subject, settings
        self._colour = "#ffffff"
        self._make_fields()
        self._lay_out()
        self._show_defaults()
        self._listen()
        self._on_edited()

    @property
    def ready(self) -> bool:
        """Whether it says enough to start."""
        return bool(self.folder.text().strip()) and self._named()

    def export(self) -> Export:
        """Return what the form says."""
        entry = BY_KEY[self.format.currentData()]
        return Export(
            self._subject.document,
            (self.first.value(), self.last.value()),
            entry,
            Path(self.folder.text()).expanduser(),
            self.stem.text(),
            (self.wide.value(), self.high.value()) if entry.paints else None,
            self._background() if entry.paints else None,
        )

    def remember(self) -> None:
        """Start from these choices next time."""
        self._settings.set_folder("export", Path(self.folder.text()).expanduser())
        self._settings.set_choice("export-format", self.format.currentData())
        self._settings.set_choice("export-background", str(self.background.currentData()))

    # -- what the choices do to each other -----------------------------------------------------

    def _on_edited(self) -> None:
        """Show what the choices mean, and offer what makes sense."""
        paints = BY_KEY[self.format.currentData()].paints
        for widget in (self.wide, self.high, self.linked, self.background):
            widget.setEnabled(paints)
        self.swatch.setVisible(paints and self.background.currentData() == COLOUR)
        self.last.setMinimum(self.first.value())
        self.preview.setText(self._summary())
        self.edited.emit()

    def _summary(self) -> str:
        if not self._named():
            return self.tr("The name cannot be empty or hold {signs}").format(
                signs=" ".join(sorted(NOT_IN_NAMES))
            )
        export = self.export()
        if export.count == 1:
            return export.path(0).name
        return self.tr("{count} files: {first} to {last}").format(
            count=export.count, first=export.path(0).name, last=export.path(export.count - 1).name
        )

    def _named(self) -> bool:
        stem = self.stem.text()
        return bool(stem.strip()) and not set(stem) & NOT_IN_NAMES

    def _background(self) -> str | None:
        choice = self.background.currentData()
        return None if choice == DOCUMENT else "" if choice == TRANSPARENT else self._colour

    def _keep_width(self) -> None:
        width, height = self._subject.document.size
        if self.linked.isChecked():
            with QSignalBlocker(self.wide):
                self.wide.setValue(round(self.high.value() * width / height))

    def _keep_height(self) -> None:
        width, height = self._subject.document.size
        if self.linked.isChecked():
            with QSignalBlocker(self.high):
                self.high.setValue(round(self.wide.value() * height / width))

    def _choose_folder(self) -> None:
        folder = dialogs.ask_folder(self, self.tr("Export to"), Path(self.folder.text()))
        if folder:
            self.folder.setText(str(folder))

    def _choose_colour(self) -> None:
        chosen = QColorDialog.getColor(QColor(self._colour), self, self.tr("Background"))
        if chosen.isValid():
            self._set_colour(chosen.name())

    def _set_colour(self, colour: str) -> None:
        self._colour = colour
        pixmap = QPixmap(20, 20)
        pixmap.fill(QColor(colour))
        self.swatch.setIcon(pixmap)

    # -- making it -----------------------------------------------------------------------------

    def _make_fields(self) -> None:
        self.format = QComboBox(accessibleName=self.tr("Format"))
        for entry in FORMATS:
            self.format.addItem(entry.name, entry.key)
        self.first = QSpinBox(accessibleName=self.tr("First frame"))
        self.last = QSpinBox(accessibleName=self.tr("Last frame"))
        self.wide = QSpinBox(accessibleName=self.tr("Width in pixels"), suffix=" px")
        self.high = QSpinBox(accessibleName=self.tr("Height in pixels"), suffix=" px")
        for box in (self.wide, self.high):
            box.setRange(1, LONGEST_SIDE)
        self.linked = QToolButton(checkable=True, accessibleName=self.tr("Keep the proportions"))
        self.linked.setToolTip(self.tr("Keep the proportions"))
        set_icon(self.linked, "locked")
        self.background = QComboBox(accessibleName=self.tr("Background"))
        self.background.addItem(self.tr("As in the project"), DOCUMENT)
        self.background.addItem(self.tr("Transparent"), TRANSPARENT)
        self.background.addItem(self.tr("Colour"), COLOUR)
        self.swatch = QToolButton(accessibleName=self.tr("Background colour"))
        self.swatch.setToolTip(self.tr("Choose the colour"))
        self.folder = QLineEdit(accessibleName=self.tr("Folder"))
        self.folder.setMinimumWidth(320)
        self.browse = QPushButton(self.tr("&Browse…"))
        self.stem = QLineEdit(accessibleName=self.tr("Name of the files"))
        self.preview = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)

    def _lay_out(self) -> None:
        form = QFormLayout(self)
        form.setContentsMargins(0, 0, 0, 0)
        form.setSpacing(10)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        folder = QHBoxLayout()
        folder.addWidget(self.folder, 1)
        folder.addWidget(self.browse)
        form.addRow(self.tr("Format"), self.format)
        form.addRow(self.tr("Frames"), _row(self.first, QLabel(self.tr("to")), self.last))
        form.addRow(self.tr("Size"), _row(self.wide, QLabel("×"), self.high, self.linked))
        form.addRow(self.tr("Background"), _row(self.background, self.swatch))
        form.addRow(self.tr("Name"), self.stem)
        form.addRow(self.tr("Folder"), folder)
        form.addRow("", self.preview)

    def _show_defaults(self) -> None:
        document = self._subject.document
        first, last = self._subject.playhead.range
        for box, value in ((self.first, first), (self.last, last)):
            box.setRange(min(document.frames[0], first, 1), max(document.frames[1], last))
            box.setValue(value)
        self.wide.setValue(round(document.size[0]))
        self.high.setValue(round(document.size[1]))
        self.linked.setChecked(True)
        self.stem.setText(self._subject.name)
        self.folder.setText(str(self._settings.folder("export")))
        key = self._settings.choice("export-format", FORMATS[0].key)
        self.format.setCurrentIndex(max(self.format.findData(key), 0))
        transparent = self._settings.choice("export-background", "") == str(TRANSPARENT)
        self.background.setCurrentIndex(TRANSPARENT if transparent else DOCUMENT)
        self._set_colour(self._colour)

    def _listen(self) -> None:
        self.format.currentIndexChanged.connect(self._on_edited)
        self.background.currentIndexChanged.connect(self._on_edited)
        self.swatch.clicked.connect(self._choose_colour)
        self.first.valueChanged.connect(self._on_edited)
        self.last.valueChanged.connect(self._on_edited)
        self.wide.valueChanged.connect(self._keep_height)
        self.high.valueChanged.connect(self._keep_width)
        self.stem.textChanged.connect(self._on_edited)
        self.folder.textChanged.connect(self._on_edited)
        self.browse.clicked.connect(self._choose_folder)


def _row(*widgets: QWidget) -> QHBoxLayout:
    row = QHBoxLayout()
    for widget in widgets:
        row.addWidget(widget)
    row.addStretch(1)
    return row
