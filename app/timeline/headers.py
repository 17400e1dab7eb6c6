"""The names of the layers at the left of their tracks, with the two toggles."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QVBoxLayout, QWidget

from app.document.layers import toggle
from app.icons import set_icon
from app.style import colours
from app.timeline.rows import ROW
from app.workspace import Workspace
from core.model import Document, Layer

WIDTH = 190


class LayerHeaders(QWidget):
    """One header a layer, top layer first."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFixedWidth(WIDTH)
        self._workspace = workspace
        self._headers: list[LayerHeader] = []
        self._rows = QVBoxLayout(self)
        self._rows.setContentsMargins(0, 0, 0, 0)
        self._rows.setSpacing(0)
        self._rows.addStretch(1)
        workspace.session.changed.connect(self._show)
        workspace.selection.changed.connect(self.update)
        self._show(workspace.session.document)

    def _show(self, document: Document) -> None:
        """Show the layers; there are only ever as many headers as layers."""
        while len(self._headers) < len(document.layers):
            header = LayerHeader(self._workspace, self)
            self._rows.insertWidget(len(self._headers), header)
            self._headers.append(header)
        while len(self._headers) > len(document.layers):
            header = self._headers.pop()
            header.hide()
            header.deleteLater()
        for header, layer in zip(self._headers, document.layers[::-1], strict=True):
            header.show_layer(layer)


class LayerHeader(QWidget):
    """The name of one layer, whether it is visible, whether it is locked."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFixedHeight(ROW)
        self._workspace = workspace
        self._layer: Layer | None = None
        self._visible = _toggle(self)
        self._visible.clicked.connect(self._set_visible)
        self._locked = _toggle(self)
        self._locked.clicked.connect(self._set_locked)
        row = QHBoxLayout(self)
        row.setContentsMargins(6, 0, 0, 1)
        row.setSpacing(0)
        row.addWidget(self._visible)
        row.addWidget(self._locked)
        row.addStretch(1)

    def show_layer(self, layer: Layer) -> None:
        """Show a layer as it is."""
        if layer is self._layer:
            return
        self._layer = layer
        set_icon(self._visible, "visible" if layer.visible else "hidden")
        set_icon(self._locked, "locked" if layer.locked else "unlocked")
        hide = self.tr("Hide layer {}") if layer.visible else self.tr("Show layer {}")
        lock = self.tr("Unlock layer {}") if layer.locked else self.tr("Lock layer {}")
        for button, text in ((self._visible, hide), (self._locked, lock)):
            button.setAccessibleName(text.format(layer.name))
            button.setToolTip(text.format(layer.name))
        self.setToolTip(layer.name)
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Choose the layer."""
        if self._layer and event.button() == Qt.MouseButton.LeftButton:
            self._workspace.selection.select_layer(self._layer.id)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the name on the ground of its row."""
        if self._layer is None:
            return
        with QPainter(self) as painter:
            self._paint_ground(painter, chosen=self._workspace.selection.layer is self._layer)
            self._paint_name(painter, self._layer)

    def _paint_ground(self, painter: QPainter, *, chosen: bool) -> None:
        c = colours()
        painter.fillRect(self.rect(), QColor(c.window))
        if chosen:
            tint = QColor(c.accent)
            tint.setAlphaF(0.22)
            painter.fillRect(self.rect(), tint)
            painter.fillRect(0, 0, 3, self.height() - 1, QColor(c.accent))
        painter.setPen(QPen(QColor(c.line), 1))
        painter.drawLine(0, self.height() - 1, self.width(), self.height() - 1)

    def _paint_name(self, painter: QPainter, layer: Layer) -> None:
        room = self.rect().adjusted(self._locked.geometry().right() + 6, 0, -8, -1)
        painter.setPen(QColor(colours().text if layer.visible else colours().muted))
        name = self.fontMetrics().elidedText(layer.name, Qt.TextElideMode.ElideRight, room.width())
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, name)

    def _set_visible(self) -> None:
        if self._layer:
            toggle(self._workspace.session, self._layer, "visible")

    def _set_locked(self) -> None:
        if self._layer:
            toggle(self._workspace.session, self._layer, "locked")


def _toggle(parent: QWidget) -> QToolButton:
    button = QToolButton(parent, autoRaise=True)
    button.setIconSize(QSize(16, 16))
    button.setFixedSize(26, 26)
    return button
