"""Where the panes are: they keep their shares of the room, whatever the window does."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from PySide6.QtCore import QSizeF, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QSplitter, QWidget

from app.canvas.moment import Role
from app.canvas.pane import Pane

KEYS, BETWEEN = 4.0, 5.0
"""Widths of a key's pane and of the in-between's, in parts."""
TITLE = 30
"""Pixels: about what the title of a pane takes."""
CLEARLY = 1.1
"""How much larger the artboard must get for the panes to be arranged anew."""


class PaneSplitter(QSplitter):
    """A splitter that resizes in proportion; the artist's own division stays."""

    def __init__(self, direction: Qt.Orientation, parent: QWidget) -> None:
        super().__init__(direction, parent, childrenCollapsible=False)
        self._shares: dict[QWidget, float] = {}
        self.splitterMoved.connect(self._note_shares)

    def insert(self, index: int, pane: QWidget, share: float) -> None:
        """Put a pane here; it takes this share of the room at first, relative to the others."""
        self._shares.setdefault(pane, share)
        self.insertWidget(index, pane)
        self.share_out()

    def share_out(self) -> None:
        """Divide the room anew."""
        shares = [0.0 if pane.isHidden() else self._shares[pane] for pane in self._inside()]
        across = self.orientation() == Qt.Orientation.Horizontal
        room = self.width() if across else self.height()
        room -= self.handleWidth() * (sum(map(bool, shares)) - 1)
        self.setSizes([round(room * share / (sum(shares) or 1.0)) for share in shares])

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Divide the new room."""
        super().resizeEvent(event)
        self.share_out()

    def _inside(self) -> list[QWidget]:
        return [self.widget(i) for i in range(self.count())]

    def _note_shares(self) -> None:
        for pane, size in zip(self._inside(), self.sizes(), strict=True):
            if not pane.isHidden():
                self._shares[pane] = float(size)


class Panes(PaneSplitter):
    """Source, in-between and target in a row, or the overlay alone.

    Where an artboard is seen larger so, the target is under the source instead.
    """

    def __init__(self, panes: Mapping[Role, Pane], parent: QWidget) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._panes, self._board = panes, (1.0, 1.0)
        self._roles = tuple(panes)
        self._keys = PaneSplitter(Qt.Orientation.Vertical, self)
        self._keys.insert(0, panes[Role.SOURCE], 1.0)
        self.insert(0, self._keys, KEYS)
        self.insert(1, panes[Role.IN_BETWEEN], BETWEEN)
        self.insert(2, panes[Role.TARGET], KEYS)
        self.insert(3, panes[Role.OVERLAY], 1.0)

    @property
    def stacked(self) -> bool:
        """Whether the target is under the source."""
        return self._keys.count() > 1

    @property
    def shown(self) -> list[Pane]:
        """The panes on screen, or about to be."""
        return [self._panes[role] for role in self._roles]

    @property
    def room(self) -> QSizeF:
        """The pixels that every pane on screen has."""
        sizes = [pane.view.size() for pane in self.shown]
        return QSizeF(min(s.width() for s in sizes), min(s.height() for s in sizes))

    def show_panes(self, roles: Collection[Role]) -> None:
        """Show just these panes."""
        self._roles = tuple(roles)
        for role, pane in self._panes.items():
            pane.setVisible(role in roles)
        self._keys.setVisible(Role.SOURCE in roles)
        self.share_out()

    def show_board(self, size: tuple[float, float]) -> None:
        """Arrange the panes for an artboard of this size."""
        if size != self._board:
            self._board = size
            self._arrange()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Arrange the panes for the new room."""
        super().resizeEvent(event)
        self._arrange()

    def _arrange(self) -> None:
        in_row = self._zoom(KEYS / (2 * KEYS + BETWEEN), 1.0)
        in_stack = self._zoom(KEYS / (KEYS + BETWEEN), 0.5)
        stacked = in_stack > CLEARLY * in_row
        if stacked != self.stacked:
            self._put_target(stacked)

    def _zoom(self, wide: float, high: float) -> float:
        """Return how large the artboard is seen in a pane with these parts of width and height."""
        width, height = self._board
        return min(self.width() * wide / width, (self.height() * high - TITLE) / height)

    def _put_target(self, stacked: bool) -> None:
        target = self._panes[Role.TARGET]
        focused = target.view.hasFocus()
        if stacked:
            self._keys.insert(1, target, 1.0)
        else:
            self.insert(2, target, KEYS)
        self.share_out()
        for role, following in ((Role.SOURCE, Role.IN_BETWEEN), (Role.IN_BETWEEN, Role.TARGET)):
            QWidget.setTabOrder(self._panes[role].view, self._panes[following].view)
        if focused:
            target.view.setFocus()
