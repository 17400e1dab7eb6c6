"""How the current layer is painted."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from PySide6.QtWidgets import QWidget

from app.fields.colour import ColourField
from app.fields.number import NumberField
from app.panels.section import Section
from app.workspace import Workspace
from core.model import Document
from core.model.edits import update_layer

WIDEST = 500.0


class LayerSection(Section):
    """Fill, stroke, and how wide the stroke is."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__("", workspace, parent)
        self.fill = ColourField(self.tr("Fill"))
        self.fill.opened.connect(self._begin_fill)
        self.fill.edited.connect(self._set_fill)
        self.stroke = ColourField(self.tr("Stroke"))
        self.stroke.opened.connect(self._begin_stroke)
        self.stroke.edited.connect(self._set_stroke)
        for field in (self.fill, self.stroke):
            field.closed.connect(self.end_drag)
        self.stroke_width = NumberField(
            self.tr("Stroke width"), 0.0, WIDEST, decimals=2, step=0.5, suffix=" px"
        )
        self.stroke_width.edited.connect(self._set_stroke_width)
        self.add_row(self.tr("Fill"), self.fill)
        self.add_row(self.tr("Stroke"), self.stroke)
        self.add_row(self.tr("Width"), self.stroke_width)

    def refresh(self) -> None:
        """Show the style of the current layer."""
        layer = self.workspace.selection.layer
        self.setVisible(layer is not None)
        if layer is not None:
            self.set_title(self.tr("Layer “{}”").format(layer.name))
            self.fill.show_value(layer.style.fill)
            self.stroke.show_value(layer.style.stroke)
            self.stroke_width.show_value(layer.style.stroke_width)
            self.stroke_width.setEnabled(bool(layer.style.stroke))

    def _begin_fill(self) -> None:
        self.workspace.session.begin(self.tr("Change fill"))

    def _begin_stroke(self) -> None:
        self.workspace.session.begin(self.tr("Change stroke"))

    def _set_fill(self, value: str) -> None:
        self._change(object(), self.tr("Change fill"), fill=value)

    def _set_stroke(self, value: str) -> None:
        self._change(object(), self.tr("Change stroke"), stroke=value)

    def _set_stroke_width(self, value: float) -> None:
        text = self.tr("Change stroke width")
        self._change(self.stroke_width.gesture, text, stroke_width=value)

    def _change(self, gesture: object, text: str, **changes: Any) -> None:
        layer = self.workspace.selection.layer
        if layer is not None:
            session = self.workspace.session
            session.amend((gesture, layer.id), text, restyle, layer.id, **changes)


def restyle(document: Document, layer_id: int, **changes: Any) -> Document:
    """Change some of a layer's style."""
    style = replace(document.layer(layer_id).style, **changes)
    return update_layer(document, layer_id, style=style)
