"""Which shapes of a file are wanted, and what they become."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QRadioButton,
    QVBoxLayout,
    QWidget,
)

from app.files.placing import Place, likely, misplaced
from app.thumbnails import outline_thumbnail
from core.io.importers import Part
from core.model import Document, Layer, Style

THUMBNAIL = QSize(96, 96)


@dataclass(frozen=True)
class Choice:
    """What the artist chose."""

    parts: tuple[Part, ...]
    """In the order they were chosen."""
    place: Place
    fit: bool


def ask_parts(
    parent: QWidget, files: Sequence[Sequence[Part]], document: Document, layer: Layer | None
) -> Choice | None:
    """Ask which parts of files to import, and as what; None when the artist changed their mind."""
    dialog = ImportDialog(files, document, layer, parent)
    accepted = dialog.exec() == QDialog.DialogCode.Accepted
    choice = dialog.choice() if accepted else None
    dialog.deleteLater()
    return choice


class ImportDialog(QDialog):
    """Shows every part; offers only what can be done with those chosen."""

    def __init__(
        self,
        files: Sequence[Sequence[Part]],
        document: Document,
        layer: Layer | None,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._parts, self._layer = [part for parts in files for part in parts], layer
        self._chosen: list[int] = []
        self.setWindowTitle(self.tr("Import"))
        self.list = self._list()
        self._radios = {place: QRadioButton() for place in Place}
        self.fit = QCheckBox(self.tr("&Fit to the artboard"))
        self.fit.setChecked(misplaced(self._parts, document.size))
        self.fit.setToolTip(self.tr("Scale and move all parts together to the middle"))
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self._import = self.buttons.addButton(
            self.tr("&Import"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self._import.setDefault(True)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        self._lay_out()
        self._choose_first(document, likely(files))

    def choice(self) -> Choice:
        """Return what is chosen now."""
        place = next(place for place, radio in self._radios.items() if radio.isChecked())
        parts = tuple(self._parts[i] for i in self._chosen)
        return Choice(parts, place, self.fit.isChecked())

    def _list(self) -> QListWidget:
        shapes = QListWidget()
        shapes.setAccessibleName(self.tr("Shapes in the file"))
        shapes.setViewMode(QListWidget.ViewMode.IconMode)
        shapes.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        shapes.setResizeMode(QListWidget.ResizeMode.Adjust)
        shapes.setMovement(QListWidget.Movement.Static)
        shapes.setIconSize(THUMBNAIL)
        shapes.setGridSize(THUMBNAIL + QSize(24, 40))
        shapes.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        shapes.setWordWrap(True)
        for part in self._parts:
            picture = outline_thumbnail(
                part.outline, part.style or Style(), THUMBNAIL, self.devicePixelRatioF()
            )
            item = QListWidgetItem(picture, part.name)
            item.setToolTip(part.name)
            shapes.addItem(item)
        shapes.itemSelectionChanged.connect(self._on_selected)
        return shapes

    def _lay_out(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(6)
        text = self.tr("Which shapes do you want? Ctrl+click chooses several, Ctrl+A all.")
        question = QLabel(text)
        question.setVisible(len(self._parts) > 1)
        column.addWidget(question)
        column.addWidget(self.list, 1)
        for radio in self._radios.values():
            column.addWidget(radio)
        column.addSpacing(6)
        column.addWidget(self.fit)
        column.addSpacing(6)
        column.addWidget(self.buttons)
        columns = min(max(len(self._parts), 3), 5)
        rows = min(-(-len(self._parts) // columns), 3)
        grid = self.list.gridSize()
        self.list.setMinimumSize(columns * grid.width() + 28, rows * grid.height() + 8)

    def _choose_first(self, document: Document, wanted: Sequence[int]) -> None:
        """Start with what is most likely meant."""
        for i in wanted:
            self.list.item(i).setSelected(True)
        place = Place.LAYERS
        if self._layer is not None and not self._layer.spans and len(wanted) == 1:
            place = Place.TARGET
        elif not document.layers and len(wanted) > 1:
            place = Place.POSES
        self._radios[place].setChecked(True)
        self._on_selected()

    def _on_selected(self) -> None:
        """Keep the order in which parts were chosen, and offer what fits their number."""
        now = {self.list.row(item) for item in self.list.selectedItems()}
        self._chosen = [i for i in self._chosen if i in now]
        self._chosen += sorted(now - set(self._chosen))
        count = len(self._chosen)
        name = _plain(self._layer.name) if self._layer else ""
        one = count == 1 and self._layer is not None
        offers = {
            Place.LAYERS: (self._layers_text(count), count > 0),
            Place.POSES: (self._poses_text(), count > 1),
            Place.SOURCE: (self.tr("The &source of “{name}”").format(name=name), one),
            Place.TARGET: (self.tr("The &target of “{name}”").format(name=name), one),
        }
        for place, (text, possible) in offers.items():
            self._radios[place].setText(text)
            self._radios[place].setEnabled(possible)
            self._radios[place].setVisible(self._ever(place))
        if not any(radio.isChecked() and radio.isEnabled() for radio in self._radios.values()):
            self._radios[Place.LAYERS].setChecked(True)
        self._import.setEnabled(count > 0)

    def _ever(self, place: Place) -> bool:
        """Return whether a place can come up at all."""
        if place is Place.POSES:
            return len(self._parts) > 1
        return place is Place.LAYERS or self._layer is not None

    def _layers_text(self, count: int) -> str:
        if count <= 1:
            return self.tr("A new &layer")
        return self.tr("{count} new &layers").format(count=count)

    def _poses_text(self) -> str:
        count = len(self._chosen)
        if count < 2:
            return self.tr("One layer that turns one shape into the other (choose two or more)")
        if count > 2:
            text = self.tr("&One layer with {count} keyframes, in the order they were chosen")
            return text.format(count=count)
        first, second = (_plain(self._parts[i].name) for i in self._chosen)
        text = self.tr("&One layer that turns “{first}” into “{second}”")
        return text.format(first=first, second=second)


def _plain(name: str) -> str:
    """Keep an ampersand in a name from being taken for a shortcut."""
    return name.replace("&", "&&")
