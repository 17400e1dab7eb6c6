"""Which span matters most to the artist now."""

from __future__ import annotations

from collections.abc import Iterable

from app.document.playhead import Playhead
from app.document.selection import Selection
from core.model import Document

Key = tuple[int, int]
"""Which span: layer id, and index of the span in the layer."""


def most_urgent(
    keys: Iterable[Key], document: Document, selection: Selection, playhead: Playhead
) -> Key | None:
    """Return the first of some spans: of the current layer, under the playhead, early in time."""
    current, frame = selection.layer, playhead.frame

    def urgency(key: Key) -> tuple[bool, bool, int]:
        layer = document.layer(key[0])
        return layer is not current, layer.span_at(frame)[0] != key[1], key[1]

    return min(keys, key=urgency, default=None)
