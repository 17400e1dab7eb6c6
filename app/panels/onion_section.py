"""The onion skin: how many keyframes it shows, and in which colours."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from app.fields.colour import ColourField
from app.fields.number import NumberField
from app.panels.section import Section
from app.workspace import MOST_GHOSTS, Workspace


class OnionSection(Section):
    """What is seen through the in-between; it is remembered, but not part of the document."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(self.tr("Onion skin"), workspace, parent)
        self.before = NumberField(self.tr("Keyframes seen before the playhead"), 0, MOST_GHOSTS)
        self.after = NumberField(self.tr("Keyframes seen after the playhead"), 0, MOST_GHOSTS)
        self.tint_before = ColourField(self.tr("Tint before"), optional=False)
        self.tint_after = ColourField(self.tr("Tint after"), optional=False)
        self._kept = workspace.view.tint_before, workspace.view.tint_after
        self.before.edited.connect(self._set_before)
        self.after.edited.connect(self._set_after)
        self.tint_before.edited.connect(self._set_tint_before)
        self.tint_after.edited.connect(self._set_tint_after)
        for count in (self.before, self.after):
            count.setToolTip(count.accessibleName())
        for tint in (self.tint_before, self.tint_after):
            tint.opened.connect(self._keep)
            tint.closed.connect(self._end)
        self.add_row(self.tr("Keys before"), self.before)
        self.add_row(self.tr("Tint"), self.tint_before)
        self.add_row(self.tr("Keys after"), self.after)
        self.add_row(self.tr("Tint"), self.tint_after)
        workspace.view.changed.connect(self.refresh)

    def refresh(self) -> None:
        """Show what is set; while nothing is drawn there is nothing to set."""
        view = self.workspace.view
        self.setVisible(self.workspace.selection.layer is not None)
        self.before.show_value(view.onion_before)
        self.after.show_value(view.onion_after)
        self.tint_before.show_value(view.tint_before)
        self.tint_after.show_value(view.tint_after)

    def _set_before(self, count: float) -> None:
        self.workspace.view.update(onion=True, onion_before=int(count))

    def _set_after(self, count: float) -> None:
        self.workspace.view.update(onion=True, onion_after=int(count))

    def _set_tint_before(self, tint: str) -> None:
        self.workspace.view.update(onion=True, tint_before=tint)

    def _set_tint_after(self, tint: str) -> None:
        self.workspace.view.update(onion=True, tint_after=tint)

    def _keep(self) -> None:
        self._kept = self.workspace.view.tint_before, self.workspace.view.tint_after

    def _end(self, keep: bool) -> None:
        """Put the tints back, unless the one that was picked is to be kept."""
        if not keep:
            before, after = self._kept
            self.workspace.view.update(tint_before=before, tint_after=after)
