"""What every widget is handed: the document, where the artist is in it, and how it is shown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from PySide6.QtCore import QObject, Signal

from app.style import DARK

if TYPE_CHECKING:
    from app.document.playhead import Playhead
    from app.document.selection import Selection
    from app.document.session import Session
    from app.jobs.frames import Frames
    from app.jobs.inspector import Inspector
    from app.jobs.solver import Solver
    from app.jobs.suggestions import Suggestions

Layout = Literal["side by side", "overlay"]
ShowSuggestions = Literal["with the tool", "always", "never"]
MOST_GHOSTS = 9
"""Keyframes that the onion skin shows at most, before and after."""
SUGGESTIONS: tuple[ShowSuggestions, ...] = ("with the tool", "always", "never")


class ViewOptions(QObject):
    """What the canvas shows; not part of the document."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.mesh = False
        self.onion = True
        self.onion_before = self.onion_after = 1
        """How many keyframes before and after the playhead the onion skin shows."""
        self.tint_before, self.tint_after = DARK.source, DARK.target
        """Their colours."""
        self.marks = True
        self.suggestions: ShowSuggestions = "with the tool"
        """When suggested marks are shown."""
        self.layout: Layout = "side by side"

    def update(self, **changes: object) -> None:
        """Set options by name; ``changed`` is emitted once, if anything did change."""
        changes = {name: value for name, value in changes.items() if getattr(self, name) != value}
        for name, value in changes.items():
            setattr(self, name, value)
        if changes:
            self.changed.emit()


@dataclass(frozen=True)
class Workspace:
    """One open window's state."""

    session: Session
    selection: Selection
    playhead: Playhead
    solver: Solver
    frames: Frames
    inspector: Inspector
    view: ViewOptions
    suggestions: Suggestions
