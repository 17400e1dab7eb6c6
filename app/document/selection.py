"""What the artist works on: a layer, one of its keyframes, nodes or a mark on it. Not undoable."""

from __future__ import annotations

from dataclasses import dataclass
from weakref import ref

from PySide6.QtCore import QObject, Signal

from app.document.session import Session
from core.model import Document, Keyframe, Layer


@dataclass(frozen=True)
class _Kept:
    """What was selected in a document when it was left."""

    document: ref[Document]
    selected: tuple[int | None, int, frozenset[tuple[int, int]], int | None]
    """Layer, key, nodes and mark."""


class Selection(QObject):
    """The current layer, keyframe, nodes and mark; always valid for the session's document."""

    changed = Signal()

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._layer_id: int | None = None
        self._key = 0
        self._nodes: frozenset[tuple[int, int]] = frozenset()
        self._mark: int | None = None
        self._seen = session.document
        self._kept: dict[int, _Kept] = {}
        """What was selected in documents that can be shown again, by their identity."""
        session.changed.connect(self._follow)
        session.replaced.connect(self._start_over)
        self._keep_valid(session.document)

    @property
    def layer(self) -> Layer | None:
        """The current layer; None only in an empty document."""
        return None if self._layer_id is None else self._session.document.layer(self._layer_id)

    @property
    def key(self) -> int:
        """Index of the current keyframe in the layer."""
        return self._key

    @property
    def keyframe(self) -> Keyframe | None:
        """The current keyframe."""
        return self.layer.keyframes[self._key] if self.layer else None

    @property
    def nodes(self) -> frozenset[tuple[int, int]]:
        """Selected (ring, node) pairs on the current keyframe."""
        return self._nodes

    @property
    def mark(self) -> int | None:
        """Index of the selected mark."""
        return self._mark

    def select_layer(self, layer_id: int) -> None:
        """Make a layer current."""
        if layer_id != self._layer_id:
            self._set(layer_id, 0)

    def select_key(self, layer_id: int, key: int) -> None:
        """Make a keyframe current."""
        if (layer_id, key) != (self._layer_id, self._key):
            self._set(layer_id, key)

    def select_key_at(self, frame: float) -> None:
        """Make the current layer's keyframe at a frame current, if there is one."""
        layer = self.layer
        key = layer.key_at(frame) if layer else None
        if layer is not None and key is not None:
            self.select_key(layer.id, key)

    def select_nodes(self, nodes: frozenset[tuple[int, int]]) -> None:
        """Select nodes on the current keyframe."""
        if nodes != self._nodes or self._mark is not None:
            self._nodes, self._mark = nodes, None
            self.changed.emit()

    def select_mark(self, mark: int | None) -> None:
        """Select a mark of the current layer."""
        if mark != self._mark or self._nodes:
            self._nodes, self._mark = frozenset(), mark
            self.changed.emit()

    def _set(self, layer_id: int | None, key: int) -> None:
        self._layer_id, self._key = layer_id, key
        self._nodes, self._mark = frozenset(), None
        self.changed.emit()

    def _follow(self, document: Document) -> None:
        """Select what was selected when this very document was left: undo and redo show it again.

        Anything else that no longer exists is not selected any more.
        """
        selected = self._layer_id, self._key, self._nodes, self._mark
        self._kept = {key: kept for key, kept in self._kept.items() if kept.document() is not None}
        before, self._seen = self._seen, document
        self._kept[id(before)] = _Kept(ref(before), selected)
        kept = self._kept.get(id(document))
        if kept is not None and kept.selected != selected:
            self._layer_id, self._key, self._nodes, self._mark = kept.selected
            self.changed.emit()
        elif kept is None:
            self._follow_key(before, document)
        self._keep_valid(document)

    def _follow_key(self, before: Document, after: Document) -> None:
        """Stay with the keyframe where others have come or gone before it."""
        ids = [layer.id for layer in after.layers]
        if self._layer_id is None or self._layer_id not in ids:
            return
        old, layer = before.layer(self._layer_id).keyframes, after.layer(self._layer_id)
        if len(old) == len(layer.keyframes):
            return
        key = layer.key_at(old[self._key].frame)
        if key is None:  # it is gone
            self._set(self._layer_id, min(self._key, len(layer.keyframes) - 1))
        elif key != self._key:
            self._key = key
            self.changed.emit()

    def _start_over(self) -> None:
        self._kept.clear()
        self._seen = self._session.document
        layers = self._session.document.layers
        self._set(layers[-1].id if layers else None, 0)

    def _keep_valid(self, document: Document) -> None:
        ids = [layer.id for layer in document.layers]
        if self._layer_id not in ids:
            self._set(ids[-1] if ids else None, 0)
            return
        layer = document.layer(self._layer_id)
        if self._key >= len(layer.keyframes):
            self._set(self._layer_id, len(layer.keyframes) - 1)
            return
        rings = layer.keyframes[self._key].outline.rings
        nodes = frozenset((r, n) for r, n in self._nodes if r < len(rings) and n < len(rings[r]))
        mark = None if self._mark is None or self._mark >= len(layer.labels) else self._mark
        if (nodes, mark) != (self._nodes, self._mark):
            self._nodes, self._mark = nodes, mark
            self.changed.emit()
