"""Where a newly drawn outline goes: a new layer, a new key, or in place of a key's outline."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from app.canvas.moment import Role
from app.canvas.pointer import Pointer
from app.canvas.tools.tool import Tool
from app.document.layers import free_name
from app.workspace import Workspace
from core.model import Outline, Ring, edits
from core.morph import edits as composed
from core.morph.edits import TARGET_AFTER

if TYPE_CHECKING:
    from app.canvas.pane import Pane


class DrawingTool(Tool):
    """What the pen and freehand share: they end with a ring, and it finds its place."""

    def __init__(self, workspace: Workspace, parent: QObject) -> None:
        super().__init__(workspace, parent)
        self._pane: Pane | None = None
        """The pane under the mouse, or the one that is drawn in."""
        self._hole = False

    def begin(self, pointer: Pointer) -> bool:
        """Begin to draw, or say why that is not possible; with Alt it will be a hole."""
        if not self._makes_layer(pointer.pane) and not self.unlocked():
            return False
        self._pane = pointer.pane
        self._hole = pointer.alt and pointer.pane.key is not None
        return True

    @property
    def refuses(self) -> bool:
        """Whether the next click changes nothing; a new layer can be drawn in any case."""
        return super().refuses and not (self._pane and self._makes_layer(self._pane))

    def finish(self, ring: Ring, pane: Pane) -> None:
        """Put a drawn ring where the pane says, as one undo step."""
        outline, layer = Outline((ring,)), self.selection.layer
        frame = self.new_frame(pane)
        if layer is not None and self._hole:
            self.session.apply(self.tr("Cut hole"), composed.cut_hole, layer.id, pane.key, ring)
            return
        if layer is None or self._makes_layer(pane):
            self._add_layer(outline, frame)
            return
        if (key := layer.key_at(frame)) is not None:
            text = self.tr("Draw outline")
            self.session.apply(text, composed.redraw_key, layer.id, key, outline)
        else:
            text = self.tr("Draw keyframe")
            self.session.apply(text, composed.draw_key, layer.id, frame, outline)
        self.selection.select_key_at(frame)

    def new_frame(self, pane: Pane) -> int:
        """Return the frame of the key that a drawing in a pane makes or changes."""
        layer, keyframe = self.selection.layer, pane.keyframe
        now = max(round(self.workspace.playhead.frame), 1)
        if layer is None or pane.role in (Role.IN_BETWEEN, Role.OVERLAY):
            return now
        return keyframe.frame if keyframe else layer.keyframes[-1].frame + TARGET_AFTER

    def outcome(self, pane: Pane) -> str:
        """Say what a drawing in a pane will become."""
        layer, frame = self.selection.layer, self.new_frame(pane)
        if layer is None or self._makes_layer(pane):
            return self.tr("a new layer")
        if layer.key_at(frame) is not None:
            text = self.tr("a new outline for frame {frame} of “{name}”, or with Alt a hole in it")
        else:
            text = self.tr("a new key at frame {frame} of “{name}”")
        return text.format(frame=frame, name=layer.name)

    def _makes_layer(self, pane: Pane) -> bool:
        return self.selection.layer is None or pane.role is Role.IN_BETWEEN

    def _add_layer(self, outline: Outline, frame: int) -> None:
        text, name = self.tr("Draw layer"), free_name(self.session.document)
        if self.session.apply(text, edits.add_layer, name, frame, outline):
            self.selection.select_layer(self.session.document.layers[-1].id)
