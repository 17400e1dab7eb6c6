"""What menus, transport and timeline do alike with keyframes: they act on the chosen one."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from app.document.playhead import Playhead
from app.document.selection import Selection
from app.document.session import Session
from core.model.edits import remove_keyframe


def step_key(playhead: Playhead, selection: Selection, direction: int) -> None:
    """Go to the next key of any visible layer, or the last one before; choose it if it can be."""
    playhead.step_key(direction)
    selection.select_key_at(playhead.frame)


def delete_key(session: Session, selection: Selection) -> None:
    """Delete the chosen key."""
    if selection.layer is not None:
        text = QCoreApplication.translate("Keyframes", "Delete keyframe")
        session.apply(text, remove_keyframe, selection.layer.id, selection.key)
