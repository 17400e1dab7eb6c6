"""Nodes: move, add, delete and smooth the nodes of an outline."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from app.canvas.ink import draw_nodes, draw_ring, pen
from app.canvas.node_hits import (
    EdgeHit,
    HandleHit,
    Hit,
    Node,
    NodeHit,
    hit_outline,
    paint_nodes,
)
from app.canvas.pointer import REACH, Pointer
from app.canvas.tools.node_drags import Marquee, MoveHandle, MoveNodes
from app.canvas.tools.tool import Command, Gesture, Tool, arrow_step
from app.style import colours
from app.workspace import Workspace
from core.model import Outline, RingPoint, edits
from core.model.outline import Array
from core.morph import edits as composed

if TYPE_CHECKING:
    from app.canvas.pane import Pane


class NodesTool(Tool):
    """Works on the nodes of the key in each pane."""

    name = "nodes"
    aims = True

    def __init__(self, workspace: Workspace, parent: QObject) -> None:
        super().__init__(workspace, parent)
        self._hit: Hit | None = None
        self._pane: Pane | None = None

    def hover(self, pointer: Pointer) -> None:
        """Find what is under the mouse."""
        self._pane, self._hit = pointer.pane, self._hit_at(pointer)
        over = isinstance(self._hit, (NodeHit, HandleHit))
        self.cursor = Qt.CursorShape.PointingHandCursor if over else Qt.CursorShape.ArrowCursor

    def leave(self) -> None:
        """Forget the hover."""
        super().leave()
        self._pane = self._hit = None

    def grab(self, pointer: Pointer) -> Gesture | None:
        """Select what is pressed, and take it; on nothing, open a marquee."""
        layer, keyframe = self.editable(pointer.pane), pointer.pane.keyframe
        if layer is None or keyframe is None:
            return None
        key, hit = self.selection.key, self._hit_at(pointer)
        if isinstance(hit, HandleHit):
            text = self.tr("Move handle")
            return MoveHandle(self.drag, text, layer.id, key, hit, keyframe.outline)
        if hit is None:
            kept = self.selection.nodes if pointer.shift else frozenset()
            self.selection.select_nodes(kept)
            start = pointer.position
            return Marquee(self.selection, keyframe.outline, start, kept, start)
        self._select(_nodes_of(hit, keyframe.outline), add=pointer.shift)
        nodes, text = self.selection.nodes, self.tr("Move nodes")
        return MoveNodes(self.drag, text, layer.id, key, nodes, pointer.position)

    def double_click(self, pointer: Pointer) -> None:
        """Add a node on the edge, or turn a node from corner to smooth and back."""
        layer, keyframe = self.editable(pointer.pane), pointer.pane.keyframe
        hit = self._hit_at(pointer)
        if layer is None or keyframe is None:
            return
        key = self.selection.key
        if isinstance(hit, EdgeHit):
            self._add(layer.id, key, hit.place)
        elif isinstance(hit, NodeHit):
            handles = _other_kind(keyframe.outline, hit.node)
            text = self.tr("Change node")
            self.session.apply(text, edits.set_handles, layer.id, key, hit.node, *handles)
        self.hover(pointer)

    def key(self, key: int, modifiers: Qt.KeyboardModifier) -> Command | None:
        """Step through nodes; nudge, add and delete them."""
        layer, nodes = self.layer, self.selection.nodes
        if layer is None:
            return None
        if key in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            return self._previous if key == Qt.Key.Key_Backtab else self._next
        if key == Qt.Key.Key_Insert:
            return self._insert
        step = arrow_step(key, modifiers)
        if nodes and step is not None:
            return lambda: self._nudge(layer.id, self.selection.key, nodes, step)
        if nodes and key in (Qt.Key.Key_Delete, Qt.Key.Key_Backspace):
            return self._delete
        return None

    def advice(self) -> str:
        """Say what the next click does."""
        layer = self.selection.layer
        if layer is None:
            return self.tr("There is no outline yet: press P or B and draw one")
        if isinstance(self._hit, HandleHit):
            return self.tr("Drag the handle to bend the curve; Alt moves it on its own")
        if isinstance(self._hit, NodeHit):
            return self.tr(
                "Drag to move the node; double-click to make it smooth or a corner; Del deletes it"
            )
        if isinstance(self._hit, EdgeHit):
            return self.tr("Double-click to add a node here; drag to move this side")
        if self.selection.nodes:
            return self.tr("Arrow keys move the selected nodes, with Shift by 10; Del deletes them")
        return self.tr("Click a node, or drag a rectangle around several; Tab goes through them")

    @property
    def seen(self) -> object:
        """What is under the mouse, and how far a marquee reaches."""
        marquee = isinstance(self._gesture, Marquee)
        return self._pane, self._hit, tuple(self._gesture.now) if marquee else None

    def paint(self, painter: QPainter, pane: Pane) -> None:
        """Paint the nodes of the key in the pane, and what is under the mouse."""
        keyframe = pane.keyframe
        if keyframe is None or self.fixed:
            return
        chosen = self.selection.nodes if pane.key == self.selection.key else frozenset()
        paint_nodes(painter, pane.view, keyframe.outline, pane.tint, chosen)
        if pane is self._pane and self._hit is not None:
            self._paint_hit(painter, pane, keyframe.outline)
        if isinstance(self._gesture, Marquee) and self._moving and pane.key == self.selection.key:
            corners = pane.view.to_screen([self._gesture.start, self._gesture.now])
            fill = QColor(colours().selection)
            fill.setAlpha(40)
            painter.setBrush(fill)
            painter.setPen(pen(colours().selection, 1.0, Qt.PenStyle.DashLine))
            painter.drawRect(QRectF(QPointF(*corners[0]), QPointF(*corners[1])))

    # -- selecting -----------------------------------------------------------------------------

    def _hit_at(self, pointer: Pointer) -> Hit | None:
        keyframe = pointer.pane.keyframe
        if keyframe is None:
            return None
        current = pointer.pane.key == self.selection.key
        nodes = self.selection.nodes if current else frozenset()
        return hit_outline(keyframe.outline, nodes, pointer.position, pointer.reach)

    def _select(self, nodes: frozenset[Node], *, add: bool) -> None:
        """Select pressed nodes; with ``add`` they join the selection, or leave it."""
        selected = self.selection.nodes
        if add:
            self.selection.select_nodes(selected ^ nodes if nodes <= selected else selected | nodes)
        elif not nodes <= selected:
            self.selection.select_nodes(nodes)

    def _all_nodes(self) -> list[Node]:
        keyframe = self.selection.keyframe
        rings = keyframe.outline.rings if keyframe else ()
        return [(r, i) for r, ring in enumerate(rings) for i in range(len(ring))]

    def _next(self) -> None:
        self._step(1)

    def _previous(self) -> None:
        self._step(-1)

    def _step(self, by: int) -> None:
        nodes, selected = self._all_nodes(), sorted(self.selection.nodes)
        if not selected:
            target = 0 if by > 0 else -1
        else:
            target = (nodes.index(selected[-1 if by > 0 else 0]) + by) % len(nodes)
        self.selection.select_nodes(frozenset({nodes[target]}))

    # -- editing -------------------------------------------------------------------------------

    def _nudge(self, layer_id: int, key: int, nodes: frozenset[Node], step: Array) -> None:
        text = self.tr("Move nodes")
        self.session.amend(self.held, text, composed.move_nodes, layer_id, key, nodes, step)

    def _insert(self) -> None:
        """Add a node in the middle of the side after the last selected node."""
        layer, nodes = self.selection.layer, self._all_nodes()
        assert layer is not None
        ring, node = max(self.selection.nodes, default=nodes[0])
        self._add(layer.id, self.selection.key, RingPoint(ring, node + 0.5))

    def _add(self, layer_id: int, key: int, place: RingPoint) -> None:
        if self.session.apply(self.tr("Add node"), edits.insert_node, layer_id, key, place):
            self.selection.select_nodes(frozenset({(place.ring, int(place.at) + 1)}))

    def _delete(self) -> None:
        layer, nodes = self.selection.layer, self.selection.nodes
        assert layer is not None
        self._hit = None
        text = self.tr("Delete nodes")
        if self.session.apply(text, composed.delete_nodes, layer.id, self.selection.key, nodes):
            self.selection.select_nodes(frozenset())

    def _paint_hit(self, painter: QPainter, pane: Pane, outline: Outline) -> None:
        view, hit = pane.view, self._hit
        if isinstance(hit, EdgeHit):
            at = view.to_screen(outline.position(hit.place))
            draw_nodes(painter, at[None], colours().selection, smooth=True, size=3.0)
        elif isinstance(hit, NodeHit) and hit.node in self._all_nodes():
            r, i = hit.node
            at = view.to_screen(outline.rings[r].points[i])
            draw_ring(painter, at, REACH, colours().selection)


def _nodes_of(hit: NodeHit | EdgeHit, outline: Outline) -> frozenset[Node]:
    """Return the node that was hit, or both ends of the side that was."""
    if isinstance(hit, NodeHit):
        return frozenset({hit.node})
    ring, segment = hit.place.ring, int(hit.place.at)
    count = len(outline.rings[ring])
    return frozenset({(ring, segment % count), (ring, (segment + 1) % count)})


def _other_kind(outline: Outline, node: Node) -> tuple[Array, Array]:
    """Return the handles (in, out) that make a corner of a smooth node, or smooth a corner."""
    r, i = node
    ring = outline.rings[r]
    if ring.handles_in[i].any() or ring.handles_out[i].any():
        return np.zeros(2), np.zeros(2)
    before, here, after = ring.points[i - 1], ring.points[i], ring.points[(i + 1) % len(ring)]
    chord = after - before
    along = chord / max(float(np.hypot(*chord)), 1e-12)
    return -along * np.hypot(*(here - before)) / 3, along * np.hypot(*(after - here)) / 3
