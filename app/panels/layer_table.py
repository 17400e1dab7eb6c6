"""The layers as a table for item views: shown, locked, name; top layer first."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, lru_cache
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QByteArray,
    QMimeData,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QRectF,
    QSize,
    Qt,
)
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap

from app.document.layers import toggle
from app.document.session import Session
from app.fields.colour import paint_colour
from app.icons import pixmap
from app.style import TARGET_SIZE, colours
from core.model import Layer
from core.model.edits import reorder_layer, update_layer

SHOWN, LOCKED, NAME = range(3)
MIME = "application/x-betwixt-layer"
ICON = 16
Index = QModelIndex | QPersistentModelIndex
Role = Qt.ItemDataRole


class LayerTable(QAbstractTableModel):
    """Reads the session's document and edits it through the session."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._layers = session.document.layers[::-1]
        session.changed.connect(self.sync)

    def layer(self, row: int) -> Layer:
        """Return the layer of a row."""
        return self._layers[row]

    def row_of(self, layer_id: int) -> int:
        """Return the row of a layer."""
        return [layer.id for layer in self._layers].index(layer_id)

    def sync(self) -> None:
        """Show the document as it is; for those who hear of a change before this table."""
        before, self._layers = self._layers, self._session.document.layers[::-1]
        if [layer.id for layer in before] != [layer.id for layer in self._layers]:
            self.beginResetModel()
            self.endResetModel()
        elif before != self._layers:
            self.dataChanged.emit(self.index(0, 0), self.index(len(self._layers) - 1, NAME))

    def toggle(self, index: Index) -> None:
        """Show or hide, lock or unlock, by a click in the first two columns."""
        layer = self._layers[index.row()]
        if index.column() == SHOWN:
            toggle(self._session, layer, "visible")
        elif index.column() == LOCKED:
            toggle(self._session, layer, "locked")

    # -- what views ask ------------------------------------------------------------------------

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008 - Qt's signature
        """Return how many layers there are."""
        return 0 if parent.isValid() else len(self._layers)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Return three."""
        return 0 if parent.isValid() else 3

    def flags(self, index: Index) -> Qt.ItemFlag:
        """Let layers be dragged between others, and names be edited."""
        if not index.isValid():
            return Qt.ItemFlag.ItemIsDropEnabled
        flags = Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable
        flags |= Qt.ItemFlag.ItemIsDragEnabled
        return flags | Qt.ItemFlag.ItemIsEditable if index.column() == NAME else flags

    def data(self, index: Index, role: int = Role.DisplayRole) -> Any:
        """Return what a cell shows and says."""
        layer = self._layers[index.row()]
        if role == Role.SizeHintRole:
            return QSize(TARGET_SIZE, TARGET_SIZE)
        if index.column() == NAME:
            if role == Role.EditRole:
                return layer.name
            if role == Role.DisplayRole:
                return self._title(layer)
            if role == Role.DecorationRole:
                return _swatch(layer.style.fill, colours().disabled)
            if role == Role.ToolTipRole:
                return self.tr("{}\nDouble click to rename, drag to reorder").format(layer.name)
            return None
        name, text = self._toggle_of(layer, index.column())
        if role == Role.DecorationRole:
            c = colours()
            return _icon(name, c.text if layer.visible else c.muted, c.on_accent)
        return text if role in (Role.ToolTipRole, Role.AccessibleTextRole) else None

    def _title(self, layer: Layer) -> str:
        """Return a layer's name, and what it hangs on."""
        carriers = self._session.document.carriers(layer)
        if not carriers:
            return layer.name
        return self.tr("{name} · on {carrier}").format(name=layer.name, carrier=carriers[0].name)

    def setData(self, index: Index, value: Any, role: int = Role.EditRole) -> bool:
        """Rename a layer; an empty name is not taken."""
        name = str(value).strip()
        layer = self._layers[index.row()]
        if role != Role.EditRole or not name:
            return False
        return self._session.apply(self.tr("Rename layer"), update_layer, layer.id, name=name)

    def _toggle_of(self, layer: Layer, column: int) -> tuple[str, str]:
        """Return icon and text of a toggle."""
        if column == SHOWN:
            return ("visible", self.tr("Hide")) if layer.visible else ("hidden", self.tr("Show"))
        return ("locked", self.tr("Unlock")) if layer.locked else ("unlocked", self.tr("Lock"))

    # -- drag and drop -------------------------------------------------------------------------

    def supportedDropActions(self) -> Qt.DropAction:
        """Layers are moved."""
        return Qt.DropAction.MoveAction

    def mimeTypes(self) -> list[str]:
        """Return the type of a dragged layer."""
        return [MIME]

    def mimeData(self, indexes: Sequence[QModelIndex]) -> QMimeData:
        """Return the dragged layer, by its id."""
        mime = QMimeData()
        mime.setData(MIME, QByteArray(str(self._layers[indexes[0].row()].id).encode()))
        return mime

    def dropMimeData(
        self, data: QMimeData, action: Qt.DropAction, row: int, column: int, parent: Index
    ) -> bool:
        """Move a layer to above a row; below all of them if the row is -1."""
        if not data.hasFormat(MIME):
            return False
        layer_id = int(bytes(data.data(MIME).data()))
        ids = [layer.id for layer in self._layers]
        row = len(ids) if row < 0 else row
        above = sum(other != layer_id for other in ids[:row])
        index = len(ids) - 1 - above
        self._session.apply(self.tr("Reorder layers"), reorder_layer, layer_id, index)
        return False  # the row has moved with the document; the view must not remove it


@cache
def _icon(name: str, plain: str, chosen: str) -> QIcon:
    """Return an icon in one colour, and in another on a chosen row."""
    icon = QIcon()
    for size in (ICON, 2 * ICON):
        icon.addPixmap(pixmap(name, size, plain))
        icon.addPixmap(pixmap(name, size, chosen), QIcon.Mode.Selected)
    return icon


@lru_cache(maxsize=256)
def _swatch(fill: str, rim: str) -> QIcon:
    image = QPixmap(2 * ICON, 2 * ICON)
    image.setDevicePixelRatio(2)
    image.fill(Qt.GlobalColor.transparent)
    with QPainter(image) as painter:
        if fill:
            paint_colour(painter, QRectF(1, 1, ICON - 2, ICON - 2), fill)
        painter.setPen(QColor(rim))
        painter.drawRect(QRectF(0.5, 0.5, ICON - 1, ICON - 1))
    icon = QIcon(image)
    icon.addPixmap(image, QIcon.Mode.Selected)
    return icon
