"""What menus, panels, timeline and tools do alike with layers."""

from __future__ import annotations

from typing import Literal

from PySide6.QtCore import QCoreApplication

from app.document.session import Session
from core.model import Document, Layer
from core.model.edits import update_layer


def toggle(session: Session, layer: Layer, state: Literal["visible", "locked"]) -> None:
    """Hide or show a layer, lock or unlock it."""
    on = not getattr(layer, state)
    names = {
        ("visible", True): _tr("Show layer"),
        ("visible", False): _tr("Hide layer"),
        ("locked", True): _tr("Lock layer"),
        ("locked", False): _tr("Unlock layer"),
    }
    session.apply(names[state, on], update_layer, layer.id, **{state: on})


def free_name(document: Document) -> str:
    """Return a name for a new layer that no other has."""
    names = {layer.name for layer in document.layers}
    candidates = (_tr("Shape {number}").format(number=n) for n in range(1, len(names) + 2))
    return next(name for name in candidates if name not in names)


def _tr(text: str) -> str:
    return QCoreApplication.translate("Layers", text)
