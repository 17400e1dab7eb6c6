"""A part of the properties panel: a heading that folds it away, and aligned rows."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QVBoxLayout, QWidget

from app.document.session import Drag
from app.panels.heading import Heading
from app.workspace import Workspace
from core.model import Document

LABEL_WIDTH = 78
"""Pixels: the same in every section, so that all fields are aligned."""


class Section(QWidget):
    """Shows part of what is chosen; subclasses fill it and say how to refresh it."""

    def __init__(self, title: str, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.workspace = workspace
        self._drag: Drag | None = None
        self._heading = Heading()
        self.set_title(title)
        self._body = QWidget()
        self._heading.toggled.connect(self._body.setVisible)
        self._grid = QGridLayout(self._body)
        self._grid.setContentsMargins(12, 8, 10, 12)
        self._grid.setHorizontalSpacing(8)
        self._grid.setVerticalSpacing(5)
        self._grid.setColumnMinimumWidth(0, LABEL_WIDTH)
        self._grid.setColumnStretch(1, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._heading)
        column.addWidget(self._body)

    def refresh(self) -> None:
        """Show what is chosen now; nothing is edited by that."""
        raise NotImplementedError

    def set_title(self, title: str) -> None:
        """Set the heading."""
        self._heading.setText(title)
        self._heading.setAccessibleName(title)

    def add_row(self, text: str, field: QWidget) -> QLabel:
        """Add a field with its label."""
        label = QLabel(text)
        label.setBuddy(field)
        row = self._grid.rowCount()
        lines = isinstance(field, QLabel)
        side = Qt.AlignmentFlag.AlignTop if lines else Qt.AlignmentFlag.AlignVCenter
        self._grid.addWidget(label, row, 0, side)
        self._grid.addWidget(field, row, 1)
        return label

    def add_wide(self, widget: QWidget) -> None:
        """Add a widget over the full width."""
        self._grid.addWidget(widget, self._grid.rowCount(), 0, 1, 2)

    def set_locked(self, locked: bool) -> None:
        """Show whether the layer can be changed."""
        self._body.setEnabled(not locked)

    def begin_drag(self, text: str) -> None:
        """Begin a drag of the session, for a field that tells when it ends."""
        self._drag = self.workspace.session.begin(text)

    def edit(
        self, gesture: object, text: str, edit: Callable[..., Document], *args: Any, **kwargs: Any
    ) -> None:
        """Make an edit within the drag under way, or else one step with others of its gesture."""
        if self._drag is not None and self._drag.open:
            self._drag.apply(edit, *args, **kwargs)
        else:
            self.workspace.session.amend(gesture, text, edit, *args, **kwargs)

    def end_drag(self, keep: bool) -> None:
        """End the drag, unless something else has."""
        if self._drag is not None:
            (self._drag.commit if keep else self._drag.abandon)()
            self._drag = None
