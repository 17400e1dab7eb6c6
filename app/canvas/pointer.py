"""What a tool is told about the mouse, in the document's coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt

from core.model.outline import Array

if TYPE_CHECKING:
    from app.canvas.pane import Pane

REACH = 9.0
"""Screen pixels within which something is hit."""
DRAG_DISTANCE = 3.0
"""Screen pixels that the mouse may shake within a click."""


@dataclass(frozen=True, eq=False)
class Pointer:
    """One mouse event."""

    pane: Pane
    position: Array
    """(2,) in the document."""
    modifiers: Qt.KeyboardModifier
    pixel: float
    """Document units per screen pixel."""

    @property
    def reach(self) -> float:
        """The distance in the document within which something is hit."""
        return REACH * self.pixel

    @property
    def shift(self) -> bool:
        """Whether Shift is held."""
        return bool(self.modifiers & Qt.KeyboardModifier.ShiftModifier)

    @property
    def alt(self) -> bool:
        """Whether Alt is held, or Ctrl, as some desktops keep Alt with the mouse to themselves."""
        keys = Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.ControlModifier
        return bool(self.modifiers & keys)
