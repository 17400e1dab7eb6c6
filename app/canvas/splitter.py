"""Panes side by side that keep their shares of the width, whatever the window does."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QSplitter, QWidget


class PaneSplitter(QSplitter):
    """A splitter that resizes in proportion; the artist's own division stays."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent, childrenCollapsible=False)
        self._shares: list[float] = []
        self.splitterMoved.connect(self._note_shares)

    def add_pane(self, pane: QWidget, share: float) -> None:
        """Add a pane that takes this share of the width, relative to the others."""
        self.addWidget(pane)
        self._shares.append(share)

    def show_panes(self, panes: list[QWidget]) -> None:
        """Show just these panes."""
        for i in range(self.count()):
            self.widget(i).setVisible(self.widget(i) in panes)
        self._share_out()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Divide the new width."""
        super().resizeEvent(event)
        self._share_out()

    def _share_out(self) -> None:
        total = sum(share for i, share in enumerate(self._shares) if self._shown(i))
        room = self.width() - self.handleWidth() * (self.count() - 1)
        self.setSizes([round(room * share / total) for share in self._shares])

    def _note_shares(self) -> None:
        for i, size in enumerate(self.sizes()):
            if self._shown(i):
                self._shares[i] = float(size)

    def _shown(self, index: int) -> bool:
        return not self.widget(index).isHidden()
