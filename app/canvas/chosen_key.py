"""Which key is chosen, as the playhead and the focus go from one to another."""

from __future__ import annotations

from PySide6.QtCore import QObject

from app.canvas.moment import keys_in_view, nearest_in_view
from app.canvas.panes import Panes
from app.workspace import Workspace


class ChosenKey(QObject):
    """Keeps the chosen key in sight: that of the pane with the focus, or where the playhead is."""

    def __init__(self, workspace: Workspace, panes: Panes, parent: QObject) -> None:
        super().__init__(parent)
        self._selection, self._playhead = workspace.selection, workspace.playhead
        self._panes = panes
        self._playhead.moved.connect(self._on_moved)

    @property
    def focused(self) -> int | None:
        """Index of the keyframe in the pane that has the focus, if there is one."""
        return next((pane.key for pane in self._panes.shown if pane.view.hasFocus()), None)

    def follow_focus(self) -> None:
        """Choose the key of the pane that is worked in now, for the keys to act on."""
        layer, focused = self._selection.layer, self.focused
        if layer is not None and focused is not None:
            self._selection.select_key(layer.id, focused)

    def keep_in_view(self) -> None:
        """Choose the key that is worked in, or at least one that is seen."""
        layer, frame = self._selection.layer, self._playhead.frame
        if layer is None or self._playhead.playing:
            return
        chosen, focused = self._selection.key, self.focused
        if focused not in (None, chosen) and layer.key_at(frame) == chosen:
            self._focus(chosen)  # the playhead has come to it, in another pane now
        elif focused is not None:
            self._selection.select_key(layer.id, focused)
        elif chosen not in keys_in_view(layer, frame):
            self._selection.select_key(layer.id, nearest_in_view(layer, frame))

    def _on_moved(self, frame: float) -> None:
        """Choose the key that the playhead comes to, unless something else is worked on."""
        at_work = self._selection.nodes or self._selection.mark is not None
        if not self._playhead.playing and not at_work and self.focused is None:
            self._selection.select_key_at(frame)

    def _focus(self, key: int) -> None:
        for pane in self._panes.shown:
            if pane.key == key:
                pane.view.setFocus()
