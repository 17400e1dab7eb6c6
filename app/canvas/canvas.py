"""The canvas: its panes, the tool in hand, and who gets which mouse or key event."""

from __future__ import annotations

from PySide6.QtCore import (
    QEvent,
    QPoint,
    Qt,
    QTimer,
    QVariantAnimation,
    Signal,
)
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from app.canvas.camera import Camera
from app.canvas.chosen_key import ChosenKey
from app.canvas.framing import Framing
from app.canvas.keyboard import Keyboard
from app.canvas.moment import Moment, Role, moment_of
from app.canvas.pane import Pane
from app.canvas.panes import Panes
from app.canvas.pointer import Pointer
from app.canvas.tools.freehand import FreehandTool
from app.canvas.tools.marks import MarksTool
from app.canvas.tools.nodes import NodesTool
from app.canvas.tools.pen import PenTool
from app.canvas.tools.select import SelectTool
from app.canvas.tools.tool import Tool
from app.workspace import Workspace
from core.errors import Trouble

SIDE_BY_SIDE = (Role.SOURCE, Role.IN_BETWEEN, Role.TARGET)
TOOLS: tuple[type[Tool], ...] = (SelectTool, NodesTool, PenTool, FreehandTool, MarksTool)
PULSES, PULSE_MS = 3, 600
PATIENCE_MS = 250
"""How long a stale in-between is shown as if it were up to date."""


class Canvas(QWidget):
    """Shows the moment under the playhead, and lets tools edit it."""

    hint_changed = Signal(str)
    """What the next click does."""
    tool_changed = Signal(str)
    menu_wanted = Signal(QPoint)
    """Where on the screen a context menu is asked for."""
    _refresh_wanted = Signal()

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self._error: Trouble | None = None
        self._hint = ""
        self._seen: tuple[Tool, object] | None = None
        self.camera = Camera(self)
        self._tools = {tool.name: tool(workspace, self) for tool in TOOLS}
        self._tool = self._tools[SelectTool.name]
        self.panes = {role: Pane(role, workspace, self.camera, self) for role in Role}
        self._arranged = Panes(self.panes, self)
        self.chosen = ChosenKey(workspace, self._arranged, self)
        self.framing = Framing(self.camera, workspace.session, self._arranged)
        self._keyboard = Keyboard(self, workspace.playhead)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._arranged)
        self._late = False
        self._patience = QTimer(self, singleShot=True, interval=PATIENCE_MS)
        self._patience.timeout.connect(self._on_late)
        self._refresh_due = False
        self._moment: Moment | None = None
        self._refresh_wanted.connect(self._refresh, Qt.ConnectionType.QueuedConnection)
        self._pulse = QVariantAnimation(
            self, startValue=0.0, endValue=0.0, duration=PULSE_MS, loopCount=PULSES
        )
        self._pulse.setKeyValueAt(0.3, 1.0)
        self._pulse.valueChanged.connect(self._on_pulse)
        self._listen()
        self._show_layout()
        self.refresh()

    # -- the tool in hand ----------------------------------------------------------------------

    @property
    def tool(self) -> str:
        """The name of the tool in hand."""
        return self._tool.name

    @property
    def hint(self) -> str:
        """What the next click does."""
        return self._hint

    @property
    def in_hand(self) -> Tool:
        """The tool in hand."""
        return self._tool

    @property
    def at_rest(self) -> bool:
        """Whether the tool in hand is the one that others are put away for."""
        return self.tool == SelectTool.name

    def put_tool_away(self) -> None:
        """Take the tool that others are put away for."""
        self.set_tool(SelectTool.name)

    def set_tool(self, name: str) -> None:
        """Take a tool: "select", "nodes", "pen", "freehand" or "marks"."""
        if name == self.tool:
            return
        self._tool.put_away()
        self._tool = self._tools[name]
        self._workspace.suggestions.set_placing(name == MarksTool.name)
        self.tool_changed.emit(name)
        self._after_tool()

    # -- errors --------------------------------------------------------------------------------

    def show_error(self, error: Trouble) -> None:
        """Highlight the place of an error, or of a repair."""
        self._error = error
        self.refresh()
        self._pulse.start()

    def clear_error(self) -> None:
        """Take the highlight away."""
        self._error = None
        self._pulse.stop()
        self.refresh()

    # -- showing -------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Show the workspace as it is now."""
        self._moment = None
        self._refresh()

    def _refresh(self) -> None:
        """Show what changed: while the playhead moves within a span, the panes of keys stay."""
        self._refresh_due = False
        self.chosen.keep_in_view()
        before, self._moment = self._moment, moment_of(self._workspace, patient=not self._late)
        self._arranged.show_board(self._moment.document.size)
        keys_stay = before is not None and before.span == self._moment.span
        for pane in self._arranged.shown:
            if pane.live or not keys_stay:
                pane.look(self._moment, self._error)
        self._tool.look_again()
        self._after_tool()
        self._keep_patience()  # last, for it is by looking that frames are found to be missing

    def _keep_patience(self) -> None:
        """Do not dim what is there in a moment: it would only flicker."""
        if not self._workspace.solver.busy and self._workspace.frames.missing is None:
            self._patience.stop()
            self._late = False
        elif not self._late and not self._patience.isActive():
            self._patience.start()

    def _on_late(self) -> None:
        self._late = True
        self._refresh_soon()

    def _refresh_soon(self) -> None:
        """Show once, before the next paint, what several signals announce."""
        self._moment = None
        self._on_playhead_moved()

    def _on_playhead_moved(self) -> None:
        if not self._refresh_due:
            self._refresh_due = True
            self._refresh_wanted.emit()

    def _on_replaced(self) -> None:
        self._tool.abandon()
        self._error = None
        self.framing.fit()

    def _on_pulse(self, pulse: float) -> None:
        for pane in self._arranged.shown:
            pane.error_ring.set_pulse(pulse)

    def _show_layout(self) -> None:
        self._layout = self._workspace.view.layout
        roles = (Role.OVERLAY,) if self._layout == "overlay" else SIDE_BY_SIDE
        self._arranged.show_panes(roles)
        self.setFocusProxy(self.panes[roles[len(roles) // 2]].view)

    def _on_view_changed(self) -> None:
        if self._workspace.view.layout != self._layout:
            self._change_layout()
        self.refresh()

    def _change_layout(self) -> None:
        """Show other panes; what was begun in those before ends there, and the keys move on."""
        self._tool.put_away()
        focused = any(pane.view.hasFocus() for pane in self.panes.values())
        self._show_layout()
        if focused:
            self.setFocus()

    # -- events of the views -------------------------------------------------------------------

    def _on_pressed(self, pointer: Pointer) -> None:
        self._tool.press(pointer)
        self._after_tool()

    def _on_moved(self, pointer: Pointer) -> None:
        self._tool.move(pointer)
        self._after_tool()

    def _on_released(self, pointer: Pointer) -> None:
        self._tool.release(pointer)
        self._after_tool()

    def _on_double_clicked(self, pointer: Pointer) -> None:
        self._tool.double_click(pointer)
        self._after_tool()

    def _on_left(self) -> None:
        self._tool.leave()
        self._after_tool()

    def _on_focus_changed(self) -> None:
        for pane in self._arranged.shown:
            pane.set_focused(pane.view.hasFocus())
        self.chosen.follow_focus()

    def _after_tool(self) -> None:
        """Show what the tool changed about itself; mere hovering mostly changes nothing."""
        seen = self._tool, self._tool.seen
        for pane in self._arranged.shown:
            pane.follow(self._tool, repaint=seen != self._seen)
        self._seen = seen
        if self._tool.hint != self._hint:
            self._hint = self._tool.hint
            self.hint_changed.emit(self._hint)

    # -- Qt ------------------------------------------------------------------------------------

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Ask for a menu, unless a drawing is under way."""
        if not self._tool.busy:
            self.menu_wanted.emit(event.globalPos())

    def changeEvent(self, event: QEvent) -> None:
        """Follow the theme; drop the hand when the keyboard goes to another window."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._refresh_soon()
        elif event.type() == QEvent.Type.ActivationChange and not self.isActiveWindow():
            self._keyboard.drop_hand()

    def _listen(self) -> None:
        w = self._workspace
        for signal in (
            w.session.changed,
            w.selection.changed,
            w.playhead.playing_changed,
            w.solver.updated,
            w.inspector.changed,
            w.suggestions.changed,
            w.frames.came,
        ):
            signal.connect(self._refresh_soon)
        self._keyboard.used.connect(self._after_tool)
        w.playhead.moved.connect(self._on_playhead_moved)
        w.session.replaced.connect(self._on_replaced)
        w.view.changed.connect(self._on_view_changed)
        for pane in self.panes.values():
            view = pane.view
            view.pressed.connect(self._on_pressed)
            view.moved.connect(self._on_moved)
            view.released.connect(self._on_released)
            view.double_clicked.connect(self._on_double_clicked)
            view.left.connect(self._on_left)
            view.focus_changed.connect(self._on_focus_changed)
            view.resized.connect(self.framing.fit_again)
