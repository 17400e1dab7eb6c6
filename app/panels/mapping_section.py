"""How the current layer is mapped from key to key."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from app.fields.choice import Choice
from app.fields.number import NumberField
from app.panels.section import Section
from app.workspace import Workspace
from core.model import Document
from core.model.edits import update_layer
from core.model.recipe import LEAST_DENSITY, MOST_DENSITY

SOFTEST, STIFFEST = 0.001, 10_000.0


class MappingSection(Section):
    """The numeric recipe: method, mesh density, and the material that places the inside."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(self.tr("Mapping"), workspace, parent)
        self.method = self._method()
        self.method.edited.connect(self._set_method)
        self.density = NumberField(self.tr("Mesh density"), LEAST_DENSITY, MOST_DENSITY, step=16)
        self.density.setToolTip(
            self.tr("Vertices along the outline to aim for; more follow detail, and take longer")
        )
        self.density.edited.connect(self._set_density)
        self.material = Choice(
            self.tr("Material"),
            [
                (self.tr("Least distortion"), "symmetric-dirichlet"),
                (self.tr("St. Venant–Kirchhoff"), "st-venant-kirchhoff"),
            ],
        )
        self.material.setToolTip(self.tr("What the inside of the shape is made of"))
        self.material.edited.connect(self._set_material)
        self.mu = self._stiffness(self.tr("μ, resistance to strain"), SOFTEST)
        self.mu.edited.connect(self._set_mu)
        self.lam = self._stiffness(self.tr("λ, resistance to a change of area"), 0.0)
        self.lam.edited.connect(self._set_lam)
        self.add_row(self.tr("Method"), self.method)
        self.add_row(self.tr("Density"), self.density)
        self.add_row(self.tr("Material"), self.material)
        self._labels = (self.add_row("μ", self.mu), self.add_row("λ", self.lam))

    def _method(self) -> Choice:
        methods = [
            (
                self.tr("As rigid as possible"),
                "arap",
                self.tr("Turns and stretches evenly; never folds"),
            ),
            (self.tr("Rigid, plain form"), "plain arap", self.tr("As the paper has it; may fold")),
            (self.tr("Straight paths"), "linear", self.tr("To compare with: what turns, shrinks")),
            (
                self.tr("Lengths and angles"),
                "intrinsic",
                self.tr("To compare with: sees the outline alone, edge by edge"),
            ),
        ]
        box = Choice(self.tr("Method"), [(text, value) for text, value, _ in methods])
        for i, (_, _, purpose) in enumerate(methods):
            box.setItemData(i, purpose, Qt.ItemDataRole.ToolTipRole)
        lines = "\n".join(f"{text}: {purpose}" for text, _, purpose in methods)
        box.setToolTip(self.tr("How in-betweens are made") + "\n" + lines)
        return box

    @staticmethod
    def _stiffness(name: str, least: float) -> NumberField:
        field = NumberField(name, least, STIFFEST, decimals=3, step=0.1)
        field.setToolTip(name)
        return field

    def refresh(self) -> None:
        """Show the recipe of the current layer."""
        layer = self.workspace.selection.layer
        self.setVisible(layer is not None)
        if layer is None:
            return
        recipe = layer.recipe
        self.set_locked(layer.locked)
        self.method.show_value(recipe.method)
        self.density.show_value(recipe.density)
        self.material.show_value(recipe.material)
        self.mu.show_value(recipe.mu)
        self.lam.show_value(recipe.lam)
        for widget in (self.mu, self.lam, *self._labels):
            widget.setEnabled(recipe.material == "st-venant-kirchhoff")

    def _set_method(self, value: str) -> None:
        self._change(object(), self.tr("Change method"), method=value)

    def _set_material(self, value: str) -> None:
        self._change(object(), self.tr("Change material"), material=value)

    def _set_density(self, value: float) -> None:
        self._change(self.density.gesture, self.tr("Change mesh density"), density=int(value))

    def _set_mu(self, value: float) -> None:
        self._change(self.mu.gesture, self.tr("Change μ"), mu=value)

    def _set_lam(self, value: float) -> None:
        self._change(self.lam.gesture, self.tr("Change λ"), lam=value)

    def _change(self, gesture: object, text: str, **changes: Any) -> None:
        layer = self.workspace.selection.layer
        if layer is not None:
            session = self.workspace.session
            session.amend((gesture, layer.id), text, remix, layer.id, **changes)


def remix(document: Document, layer_id: int, **changes: Any) -> Document:
    """Change some of a layer's recipe."""
    recipe = replace(document.layer(layer_id).recipe, **changes)
    return update_layer(document, layer_id, recipe=recipe)
