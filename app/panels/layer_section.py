"""How the current layer is painted, and what it hangs on."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from PySide6.QtWidgets import QWidget

from app.fields.choice import Choice
from app.fields.colour import ColourField
from app.fields.number import NumberField
from app.panels.section import Section
from app.workspace import Workspace
from core.model import Document, Layer
from core.model.edits import hang_layer, update_layer

WIDEST = 500.0


class LayerSection(Section):
    """Fill, stroke, how wide the stroke is, and which layer carries this one."""

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
        self.carrier = Choice(self.tr("Hangs on"), [])
        self.carrier.setToolTip(
            self.tr(
                "The layer that carries this one along: where both are joined at the keys,\n"
                "they stay joined between them, and this one turns as seen from there.\n"
                "A layer with a single key goes wherever it is carried."
            )
        )
        self.carrier.edited.connect(self._hang)
        self.add_row(self.tr("Width"), self.stroke_width)
        self.add_row(self.tr("Hangs on"), self.carrier)

    def refresh(self) -> None:
        """Show the style of the current layer."""
        layer = self.workspace.selection.layer
        self.setVisible(layer is not None)
        if layer is not None:
            self.set_title(self.tr("Layer “{}”").format(layer.name))
            self.set_locked(layer.locked)
            self.fill.show_value(layer.style.fill)
            self.stroke.show_value(layer.style.stroke)
            self.stroke_width.show_value(layer.style.stroke_width)
            self.stroke_width.setEnabled(bool(layer.style.stroke))
            self._show_carrier(layer)

    def _show_carrier(self, layer: Layer) -> None:
        """Offer every layer that does not itself hang on this one, the topmost first."""
        document = self.workspace.session.document
        others = [
            (other.name, other.id)
            for other in reversed(document.layers)
            if other is not layer and layer not in document.carriers(other)
        ]
        self.carrier.offer([(self.tr("Nothing"), None), *others])
        self.carrier.show_value(layer.carrier)
        self.carrier.setEnabled(bool(others))

    def _hang(self, carrier: int | None) -> None:
        layer = self.workspace.selection.layer
        if layer is not None:
            text = self.tr("Hang layer") if carrier is not None else self.tr("Take layer off")
            self.workspace.session.apply(text, hang_layer, layer.id, carrier)

    def _begin_fill(self) -> None:
        self.begin_drag(self.tr("Change fill"))

    def _begin_stroke(self) -> None:
        self.begin_drag(self.tr("Change stroke"))

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
            self.edit((gesture, layer.id), text, restyle, layer.id, **changes)


def restyle(document: Document, layer_id: int, **changes: Any) -> Document:
    """Change some of a layer's style."""
    style = replace(document.layer(layer_id).style, **changes)
    return update_layer(document, layer_id, style=style)
