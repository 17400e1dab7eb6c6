"""Which span matters most to the artist now."""

from __future__ import annotations

from collections.abc import Callable, Iterable

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


def nearness(playhead: Playhead) -> Callable[[float], float]:
    """Return a function that tells how soon a frame will be seen, in frames.

    While playing those ahead come first, to the end of the range and on from its start.
    """
    here, (first, last) = playhead.frame, playhead.range

    def ahead(frame: float) -> float:
        return frame - here if frame >= here else last - here + frame - first

    def around(frame: float) -> float:
        return abs(frame - here)

    return ahead if playhead.playing else around
