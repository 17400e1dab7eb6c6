"""What the menus do to the document, where it takes more than one call."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from PySide6.QtCore import QObject, Signal

from app.document.keyframes import delete_key, step_key
from app.document.layers import toggle
from app.workspace import Workspace
from core.errors import EditError
from core.model import Layer
from core.model.easing import PRESETS
from core.model.edits import (
    insert_keyframe,
    remove_marks,
    set_easing,
)
from core.morph.edits import delete_nodes
from core.morph.scene import Span, keyframe_at

if TYPE_CHECKING:
    from core.morph.morph import Morph


class Commands(QObject):
    """Acts on what is selected and where the playhead is; every edit is one undo step."""

    noted = Signal(str)
    """What came of it, where that is not plain to see."""

    def __init__(self, workspace: Workspace, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._selection = workspace.session, workspace.selection
        self._playhead, self._solver = workspace.playhead, workspace.solver
        self._view, self._suggestions = workspace.view, workspace.suggestions

    # -- edit ----------------------------------------------------------------------------------

    def delete(self) -> None:
        """Delete the selected nodes, or else the selected mark, or else the chosen keyframe."""
        if self._selection.nodes:
            self.delete_nodes()
        elif self._selection.mark is not None:
            self.remove_mark()
        else:
            self.remove_keyframe()

    def delete_nodes(self) -> None:
        """Delete the selected nodes, whichever rings they are on."""
        self._session.apply(
            self.tr("Delete nodes"),
            delete_nodes,
            self.unlocked().id,
            self._selection.key,
            self._selection.nodes,
        )

    def select_all_nodes(self) -> None:
        """Select every node of the current keyframe."""
        if keyframe := self._selection.keyframe:
            self._selection.select_nodes(
                frozenset(
                    (ring, node)
                    for ring, nodes in enumerate(keyframe.outline.rings)
                    for node in range(len(nodes))
                )
            )

    # -- layers --------------------------------------------------------------------------------

    def select_layer(self, by: int) -> None:
        """Make the next layer up current, or the next one down if negative."""
        layers = self._session.document.layers
        index = self._index(self._layer()) + by
        if 0 <= index < len(layers):
            self._selection.select_layer(layers[index].id)

    def toggle_layer(self, state: Literal["visible", "locked"]) -> None:
        """Hide or show, lock or unlock the current layer."""
        toggle(self._session, self._layer(), state)

    # -- keyframes -----------------------------------------------------------------------------

    def insert_keyframe(self) -> None:
        """Make the in-between at the playhead a keyframe; EditError while it is not solved."""
        layer, frame = self.unlocked(), round(self._playhead.frame)
        key, turning = keyframe_at(self._session.document, layer, frame, self._solution)
        text = self.tr("Insert keyframe")
        if self._session.apply(text, insert_keyframe, layer.id, key, turning):
            self._selection.select_key_at(frame)

    def remove_keyframe(self) -> None:
        """Delete the chosen keyframe."""
        self.unlocked()
        delete_key(self._session, self._selection)

    def step_key(self, direction: int) -> None:
        """Go to the next keyframe, or the last one before, and choose it."""
        step_key(self._playhead, self._selection, direction)

    def set_easing(self, preset: str) -> None:
        """Set the timing of the span under the playhead."""
        layer = self.unlocked()
        key, _ = layer.span_at(self._playhead.frame)
        self._session.apply(self.tr("Change easing"), set_easing, layer.id, key, PRESETS[preset])

    # -- marks ---------------------------------------------------------------------------------

    def show_suggestions(self) -> None:
        """Show the marks that the span under the playhead is better off with."""
        self.unlocked()
        self._view.update(marks=True)
        if self._view.suggestions == "never":
            self._view.update(suggestions="with the tool")
        if self._suggestions.visible and self._suggestions.current and not self._suggestions.shown:
            self.noted.emit(self.tr("These two outlines need no more marks."))

    def accept_suggestions(self) -> None:
        """Make marks of all suggestions."""
        self.unlocked()
        self._suggestions.accept_all()

    def hide_suggestions(self) -> None:
        """Show no suggestions until they are asked for."""
        self._view.update(suggestions="never")
        self.noted.emit(self.tr("Suggested marks are hidden. Ctrl+Shift+M shows them again."))

    def remove_mark(self) -> None:
        """Remove the selected mark."""
        layer, mark = self.unlocked(), self._selection.mark
        if mark is not None:
            text = self.tr("Delete mark {letter}").format(letter=layer.labels[mark])
            self._session.apply(text, remove_marks, layer.id, [mark])

    def remove_all_marks(self) -> None:
        """Remove every mark of the current layer."""
        layer = self.unlocked()
        marks = range(len(layer.labels))
        self._session.apply(self.tr("Delete all marks"), remove_marks, layer.id, marks)

    # -- shared --------------------------------------------------------------------------------

    def _layer(self) -> Layer:
        layer = self._selection.layer
        if layer is None:
            raise EditError("There is no layer yet.", hint="Draw an outline, or import one.")
        return layer

    def unlocked(self) -> Layer:
        """Return the current layer; EditError when there is none that may be changed."""
        layer = self._layer()
        if layer.locked:
            raise EditError(
                self.tr("Layer “{name}” is locked.").format(name=layer.name),
                hint=self.tr("Unlock it in the Layer menu to change it."),
            )
        return layer

    def _solution(self, span: Span) -> Morph:
        """Return the solution of a span; never the stale one that may be on screen."""
        solution = self._solver.solutions().get(span)
        if solution is not None:
            return solution
        if self._solver.busy:
            raise EditError(
                self.tr("This in-between is still being solved."),
                hint=self.tr("Wait a moment, then insert the keyframe again."),
            )
        raise EditError(
            self.tr("This in-between is not solved."),
            hint=self.tr("Show the layer, or mend its outlines or marks, so that it can be."),
        )

    def _index(self, layer: Layer) -> int:
        return [other.id for other in self._session.document.layers].index(layer.id)
