"""Every change an artist can make, each as one pure function Document → Document.

A function returns the very same document when nothing changes, and raises ``EditError`` when the
edit is impossible: what it names is not there, or what it makes is no sound document. Parts that
did not change are shared, so results computed for them stay valid.
"""

from __future__ import annotations

from core.model.edits.keyframes import (
    insert_keyframe,
    move_keyframe,
    remove_keyframe,
    replace_outline,
    set_easing,
    set_passing,
    set_turning,
)
from core.model.edits.layers import (
    add_layer,
    duplicate_layer,
    hang_layer,
    remove_layer,
    reorder_layer,
    update_document,
    update_layer,
)
from core.model.edits.locks import require_locks_kept
from core.model.edits.marks import (
    add_mark,
    move_mark,
    remove_marks,
)
from core.model.edits.nodes import (
    delete_nodes,
    insert_node,
    move_nodes,
    set_handles,
    transform_outline,
)

__all__ = [
    "add_layer",
    "add_mark",
    "delete_nodes",
    "duplicate_layer",
    "hang_layer",
    "insert_keyframe",
    "insert_node",
    "move_keyframe",
    "move_mark",
    "move_nodes",
    "remove_keyframe",
    "remove_layer",
    "remove_marks",
    "reorder_layer",
    "replace_outline",
    "require_locks_kept",
    "set_easing",
    "set_handles",
    "set_passing",
    "set_turning",
    "transform_outline",
    "update_document",
    "update_layer",
]
