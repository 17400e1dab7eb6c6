"""The timeline: transport above, names at the left, ruler and tracks at the right."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QHBoxLayout, QScrollArea, QWidget

from app.style import colours
from app.timeline.headers import WIDTH, LayerHeaders
from app.timeline.rows import ROW
from app.timeline.ruler import Ruler
from app.timeline.time_view import TimeView
from app.timeline.tracks import Tracks
from app.timeline.transport import Transport
from app.workspace import Workspace


class Timeline(QWidget):
    """Shows and edits when things happen. Ruler and tracks share one scale."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Timeline"))
        self.view = TimeView(workspace, self)
        self.transport = Transport(workspace)
        self.ruler = Ruler(workspace, self.view)
        self.headers = LayerHeaders(workspace)
        self.tracks = Tracks(workspace, self.view)
        self.setFocusProxy(self.tracks)
        self._workspace = workspace
        workspace.selection.changed.connect(  # queued: the rows are laid out by then
            self._show_current_layer, Qt.ConnectionType.QueuedConnection
        )
        self.transport.fit_asked.connect(self.view.fit)
        self.transport.frame_entered.connect(self.tracks.setFocus)

        body = QWidget()
        rows = QHBoxLayout(body)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(0)
        rows.addWidget(self.headers)
        rows.addWidget(self.tracks, 1)
        self._scroll = QScrollArea(widgetResizable=True, frameShape=QFrame.Shape.NoFrame)
        self._scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._scroll.setWidget(body)

        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setSpacing(0)
        grid.addWidget(self.transport, 0, 0, 1, 2)
        grid.setColumnMinimumWidth(0, WIDTH)
        grid.addWidget(self.ruler, 1, 1)
        grid.addWidget(self._scroll, 2, 0, 1, 2)
        grid.setColumnStretch(1, 1)
        grid.setRowStretch(2, 1)

    def sizeHint(self) -> QSize:
        """Return room for the transport, the ruler and two layers."""
        return QSize(900, 180)

    def _show_current_layer(self) -> None:
        """Scroll to the row of the current layer."""
        layer = self._workspace.selection.layer
        if layer is not None:
            row = self.tracks.rows.layers().index(layer)
            self._scroll.ensureVisible(0, row * ROW + ROW // 2, 0, ROW // 2)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit time into the new width."""
        super().resizeEvent(event)
        self.view.set_width(self.width() - WIDTH)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Fill the corner between names and ruler."""
        with QPainter(self) as painter:
            painter.fillRect(self.rect(), QColor(colours().window))
