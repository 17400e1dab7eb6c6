"""The artboard, the frame rate, and how long drawings are held."""

from __future__ import annotations

from typing import Any

from PySide6.QtWidgets import QWidget

from app.fields.choice import Choice
from app.fields.colour import ColourField
from app.fields.frame_rate import FrameRateField
from app.fields.number import NumberField
from app.panels.section import Section
from app.workspace import Workspace
from core.model.edits import update_document

SMALLEST, LARGEST = 16, 8192


class DocumentSection(Section):
    """What holds for all layers."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(self.tr("Document"), workspace, parent)
        self.width_ = NumberField(
            self.tr("Artboard width"), SMALLEST, LARGEST, decimals=2, suffix=" px"
        )
        self.height_ = NumberField(
            self.tr("Artboard height"), SMALLEST, LARGEST, decimals=2, suffix=" px"
        )
        self.width_.edited.connect(self._set_width)
        self.height_.edited.connect(self._set_height)
        self.background = ColourField(self.tr("Background"))
        self.background.opened.connect(self._begin_background)
        self.background.edited.connect(self._set_background)
        self.background.closed.connect(self.end_drag)
        self.frame_rate = FrameRateField(workspace.session)
        self.hold = Choice(
            self.tr("How long a drawing is held"),
            [
                (self.tr("On ones"), 1),
                (self.tr("On twos"), 2),
                (self.tr("On threes"), 3),
                (self.tr("On fours"), 4),
            ],
        )
        self.hold.setToolTip(
            self.tr(
                "On twos, each drawing is seen for two frames, here and in what is exported.\n"
                "Keys are seen at their own frames in any case."
            )
        )
        self.hold.edited.connect(self._set_hold)
        self.add_row(self.tr("Width"), self.width_)
        self.add_row(self.tr("Height"), self.height_)
        self.add_row(self.tr("Background"), self.background)
        self.add_row(self.tr("Frame rate"), self.frame_rate)
        self.add_row(self.tr("Drawings"), self.hold)

    def refresh(self) -> None:
        """Show the document; the frame rate shows itself."""
        document = self.workspace.session.document
        self.width_.show_value(document.size[0])
        self.height_.show_value(document.size[1])
        self.background.show_value(document.background)
        self.hold.show_value(document.hold)

    def _set_width(self, value: float) -> None:
        _, height = self.workspace.session.document.size
        self._change(self.width_.gesture, self.tr("Change artboard"), size=(value, height))

    def _set_height(self, value: float) -> None:
        width, _ = self.workspace.session.document.size
        self._change(self.height_.gesture, self.tr("Change artboard"), size=(width, value))

    def _begin_background(self) -> None:
        self.begin_drag(self.tr("Change background"))

    def _set_background(self, value: str) -> None:
        self._change(object(), self.tr("Change background"), background=value)

    def _set_hold(self, frames: int) -> None:
        self._change(object(), self.tr("Hold drawings"), hold=frames)

    def _change(self, gesture: object, text: str, **changes: Any) -> None:
        self.edit(gesture, text, update_document, **changes)
