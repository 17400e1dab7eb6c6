"""The layers panel: the stack of layers, top first, and what can be done with it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QModelIndex, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFrame,
    QHBoxLayout,
    QHeaderView,
    QToolButton,
    QTreeView,
    QVBoxLayout,
    QWidget,
)

from app.document.layers import free_name
from app.icons import set_icon
from app.panels.layer_table import LOCKED, NAME, SHOWN, LayerTable
from app.style import TARGET_SIZE
from app.workspace import Workspace
from core.model import Outline, Ring
from core.model.edits import add_layer, duplicate_layer, remove_layer, reorder_layer

NEW_SIZE = 0.2
"""Radius of a new layer's circle, by the smaller side of the artboard."""


class LayersPanel(QWidget):
    """A list in step with the document and the selection, and a row of buttons."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self.table = LayerTable(workspace.session, self)
        self.list = LayerList()
        self.list.setModel(self.table)
        for column in (SHOWN, LOCKED):
            self.list.setColumnWidth(column, TARGET_SIZE)
        self.list.clicked.connect(self.table.toggle)
        self.list.delete_asked.connect(self.remove)
        self.list.selectionModel().currentRowChanged.connect(self._on_current_changed)
        self._buttons = self._make_buttons()
        row = QHBoxLayout()
        row.setContentsMargins(6, 4, 6, 4)
        row.setSpacing(2)
        for button in self._buttons:
            row.addWidget(button)
        row.insertStretch(2, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.list, 1)
        column.addLayout(row)
        workspace.session.changed.connect(self._refresh)
        workspace.selection.changed.connect(self._refresh)
        self._refresh()

    def sizeHint(self) -> QSize:
        """Return room for a handful of layers."""
        return QSize(260, 180)

    # -- what the buttons do -------------------------------------------------------------------

    def add(self) -> None:
        """Add a layer with a circle at the current frame, to be edited or drawn anew."""
        session = self._workspace.session
        width, height = session.document.size
        radius = NEW_SIZE * min(width, height)
        outline = Outline((Ring.ellipse((width / 2, height / 2), (radius, radius)),))
        frame = round(self._workspace.playhead.frame)
        name = free_name(session.document)
        if session.apply(self.tr("Add layer"), add_layer, name, frame, outline):
            self._workspace.selection.select_layer(session.document.layers[-1].id)

    def duplicate(self) -> None:
        """Add a copy of the current layer above it."""
        session, layer = self._workspace.session, self._workspace.selection.layer
        if layer is not None:
            index = session.document.layers.index(layer)
            name = self.tr("{name} copy").format(name=layer.name)
            session.apply(self.tr("Duplicate layer"), duplicate_layer, layer.id, name)
            self._workspace.selection.select_layer(session.document.layers[index + 1].id)

    def remove(self) -> None:
        """Remove the current layer."""
        session, layer = self._workspace.session, self._workspace.selection.layer
        if layer is not None:
            session.apply(self.tr("Delete layer"), remove_layer, layer.id)

    def raise_layer(self) -> None:
        """Move the current layer up."""
        self._move(1, self.tr("Raise layer"))

    def lower_layer(self) -> None:
        """Move the current layer down."""
        self._move(-1, self.tr("Lower layer"))

    def _move(self, by: int, text: str) -> None:
        session, layer = self._workspace.session, self._workspace.selection.layer
        if layer is not None:
            index = session.document.layers.index(layer) + by
            if index < len(session.document.layers):
                session.apply(text, reorder_layer, layer.id, index)

    def _make_buttons(self) -> tuple[QToolButton, ...]:
        buttons = []
        for icon, text, clicked in (
            ("add", self.tr("Add a layer"), self.add),
            ("duplicate", self.tr("Duplicate the layer (Ctrl+D)"), self.duplicate),
            ("up", self.tr("Raise the layer (Ctrl+])"), self.raise_layer),
            ("down", self.tr("Lower the layer (Ctrl+[)"), self.lower_layer),
            ("delete", self.tr("Delete the layer"), self.remove),
        ):
            button = QToolButton(autoRaise=True)
            set_icon(button, icon)
            button.setAccessibleName(text)
            button.setToolTip(text)
            button.clicked.connect(clicked)
            buttons.append(button)
        return tuple(buttons)

    # -- keeping in step -----------------------------------------------------------------------

    def _refresh(self) -> None:
        self.table.sync()
        layers, layer = self._workspace.session.document.layers, self._workspace.selection.layer
        _, duplicate, up, down, delete = self._buttons
        for button in (duplicate, delete):
            button.setEnabled(layer is not None)
        up.setEnabled(layer is not None and layer is not layers[-1])
        down.setEnabled(layer is not None and layer is not layers[0])
        if layer is not None:
            row = self.table.row_of(layer.id)
            if self.list.currentIndex().row() != row:
                self.list.setCurrentIndex(self.table.index(row, NAME))

    def _on_current_changed(self, current: QModelIndex) -> None:
        if current.isValid():
            self._workspace.selection.select_layer(self.table.layer(current.row()).id)


class LayerList(QTreeView):
    """The list; Delete asks for the layer to be deleted, F2 renames it."""

    delete_asked = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Layers"))
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHeaderHidden(True)
        self.setRootIsDecorated(False)
        self.setAllColumnsShowFocus(True)
        self.setUniformRowHeights(True)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setDragDropMode(QAbstractItemView.DragDropMode.InternalMove)
        self.setDropIndicatorShown(True)
        self.setEditTriggers(
            QAbstractItemView.EditTrigger.DoubleClicked
            | QAbstractItemView.EditTrigger.EditKeyPressed
        )
        self.header().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.header().setMinimumSectionSize(TARGET_SIZE)
        self.header().setStretchLastSection(True)

    def event(self, event: QEvent) -> bool:
        """Keep Delete and F2 from the window, where they mean keyframes and a tool."""
        override = event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent)
        if override and event.key() in (Qt.Key.Key_Delete, Qt.Key.Key_F2):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Ask for the layer to be deleted."""
        if event.key() == Qt.Key.Key_Delete:
            self.delete_asked.emit()
        else:
            super().keyPressEvent(event)
