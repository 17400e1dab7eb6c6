"""What a lock keeps, whichever edit comes."""

from __future__ import annotations

from dataclasses import replace

from core.errors import EditError
from core.model.document import Document


def require_locks_kept(before: Document, after: Document) -> None:
    """Raise EditError if a locked layer is gone, or no longer looks and moves as it did.

    Its name, its place among the layers, and whether it is shown or locked are free.
    """
    layers = {layer.id: layer for layer in after.layers}
    for layer in before.layers:
        now = layers.get(layer.id)
        if not layer.locked or now is layer:
            continue
        if now is None or now != replace(
            layer, name=now.name, visible=now.visible, locked=now.locked
        ):
            raise EditError(
                f"Layer “{layer.name}” is locked.",
                hint="Unlock it with the padlock beside its name to change it.",
            )
