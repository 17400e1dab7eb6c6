"""What a drag does in the nodes tool: move nodes, bend a curve, select by a rectangle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.canvas.node_hits import HandleHit, Node, smooth_nodes
from app.canvas.pointer import Pointer
from app.canvas.tools.tool import Apply
from app.document.selection import Selection
from core.model import Outline, edits
from core.model.outline import Array
from core.morph import edits as composed


@dataclass
class MoveNodes:
    """A drag of the selected nodes."""

    drag: Apply
    text: str
    layer_id: int
    key: int
    nodes: frozenset[Node]
    start: Array

    def move(self, pointer: Pointer) -> None:
        """Move them; Shift keeps to one axis."""
        step = pointer.position - self.start
        if pointer.shift:
            step[np.argmin(np.abs(step))] = 0.0
        self.drag(composed.move_nodes, self.layer_id, self.key, self.nodes, step)

    def end(self, pointer: Pointer) -> None:
        """Nothing is left to do."""


@dataclass
class MoveHandle:
    """A drag of one Bézier handle; a smooth node stays smooth unless Alt is held."""

    drag: Apply
    text: str
    layer_id: int
    key: int
    hit: HandleHit
    outline: Outline

    def move(self, pointer: Pointer) -> None:
        """Point the handle at the mouse."""
        r, i = self.hit.node
        ring = self.outline.rings[r]
        ends = {"in": ring.handles_in[i], "out": ring.handles_out[i]}
        other = "in" if self.hit.side == "out" else "out"
        reach = pointer.position - ring.points[i]
        ends[self.hit.side] = reach
        length = float(np.hypot(*reach))
        if smooth_nodes(ring)[i] and not pointer.alt and length > 0:
            ends[other] = -reach / length * float(np.hypot(*ends[other]))
        self.drag(edits.set_handles, self.layer_id, self.key, (r, i), ends["in"], ends["out"])

    def end(self, pointer: Pointer) -> None:
        """Nothing is left to do."""


@dataclass
class Marquee:
    """A rectangle that selects the nodes in it."""

    selection: Selection
    outline: Outline
    start: Array
    kept: frozenset[Node]
    now: Array
    text: str = ""

    def move(self, pointer: Pointer) -> None:
        """Select what is inside so far."""
        self.now = pointer.position
        low, high = np.minimum(self.start, self.now), np.maximum(self.start, self.now)
        inside = {
            (r, int(i))
            for r, ring in enumerate(self.outline.rings)
            for i in np.flatnonzero(((ring.points >= low) & (ring.points <= high)).all(axis=1))
        }
        self.selection.select_nodes(self.kept | inside)

    def end(self, pointer: Pointer) -> None:
        """Nothing is left to do."""
