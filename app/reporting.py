"""What went wrong or was repaired, in the message bar and on the canvas, with what mends it."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from PySide6.QtCore import QObject, QTimer

from app.canvas.canvas import Canvas
from app.files.files import Files
from app.jobs.solver import SpanState
from app.jobs.urgency import Key
from app.panels.messages import Action, MessageBar
from app.workspace import Workspace
from core.errors import FileError, MarkError, MorphError, OutlineError, Repair, Trouble, Where
from core.model import Layer
from core.model.edits import remove_marks, replace_outline
from core.morph.scene import Span, span_of

if TYPE_CHECKING:
    from core.morph.morph import Morph

UNSEEN = 1e-4
"""A repair that moved less than this fraction of an outline is not worth a word."""


class _Shown(NamedTuple):
    """The solver's error as it is on show."""

    error: MorphError
    about: str
    here: bool
    """Whether the canvas shows what is wrong."""
    mark: int | None
    """The chosen mark."""


class Reporter(QObject):
    """Shows one trouble at a time: what was just refused, or else what cannot be solved."""

    def __init__(self, workspace: Workspace, canvas: Canvas, files: Files, bar: MessageBar) -> None:
        super().__init__(bar)
        self._workspace, self._canvas, self._files, self._bar = workspace, canvas, files, bar
        self._shown: _Shown | None = None
        """The solver's error on show."""
        self._in_view: Key | None = None
        """The span that was in view when that was decided."""
        self._dismissed: MorphError | None = None
        self._offered: set[Span] = set()
        """The spans whose targets were offered to be mirrored."""
        self._told: set[tuple[int, int]] = set()
        """Keyframes (layer id, index) of which it was told that they were repaired."""
        self._passing = False
        """Whether what is on show goes with the next change."""
        self._refused = False
        """Whether that is what was just refused, which comes before all that cannot be solved."""
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._follow_solver)
        workspace.session.failed.connect(self.show_refusal)
        workspace.session.changed.connect(self._on_changed)
        workspace.session.replaced.connect(self._on_replaced)
        workspace.solver.updated.connect(self._follow_soon)
        workspace.selection.changed.connect(self._follow_soon)
        workspace.playhead.moved.connect(self._on_playhead_moved)
        workspace.playhead.playing_changed.connect(self._on_playhead_moved)
        files.failed.connect(self.show_refusal)
        files.noted.connect(self.note)
        bar.closed.connect(self._on_closed)

    def show_refusal(self, error: MorphError) -> None:
        """Show what was refused just now; the next change takes it away."""
        self._passing, self._refused, self._shown = True, True, None
        actions: tuple[Action, ...] = ()
        if isinstance(error, FileError) and self._workspace.session.dirty:
            actions = ((self.tr("Save as…"), self._save_as),)
        self._bar.show_error(error, *actions)
        if _has_place(error.where):
            self._canvas.show_error(error)

    def note(self, text: str, *actions: Action) -> None:
        """Show what happened; the next change takes it away, and so does what cannot be solved."""
        self._passing, self._refused, self._shown = True, False, None
        self._bar.show_info(text, *actions)

    def show_fault(self, fault: BaseException) -> None:
        """Show a fault of the program itself; the details are in its log."""
        what = self.tr("Something went wrong in the program ({fault}).")
        self.show_refusal(
            MorphError(
                what.format(fault=f"{type(fault).__name__}: {fault}"),
                hint=self.tr("Your work is safe; save it, and report this with the log file."),
            )
        )

    # -- following -----------------------------------------------------------------------------

    def _on_changed(self) -> None:
        if self._passing:
            self._clear()
        self._follow_soon()

    def _on_replaced(self) -> None:
        self._told.clear()
        self._offered.clear()

    def _on_playhead_moved(self) -> None:
        """Follow to another span, unless it plays: what plays is looked at, not worked on."""
        layer = self._workspace.selection.layer
        if layer is None or self._workspace.playhead.playing:
            return
        if self._in_view != (layer.id, self._span_in_view(layer)):
            self._follow_soon()

    def _follow_soon(self) -> None:
        self._soon.start()

    def _follow_solver(self) -> None:
        """Show the most pressing error of the solver, or take it away when it is gone."""
        layer = self._workspace.selection.layer
        self._in_view = layer and (layer.id, self._span_in_view(layer))
        if self._refused:
            return
        key = self._most_pressing()
        error = None if key is None else self._workspace.solver.errors[key]
        if error is None and not self._passing and not self._tell_repairs():
            self._offer_mirror()
        if error is None or key is None or error is self._dismissed:
            if self._shown is not None:
                self._clear()
            return
        layer = self._workspace.session.document.layer(key[0])
        several = len(self._workspace.session.document.layers) > 1
        about = self.tr("Layer “{name}”: ").format(name=layer.name) if several else ""
        here = self._workspace.selection.layer is layer and key[1] == self._span_in_view(layer)
        shown = _Shown(error, about, here, self._workspace.selection.mark)
        if shown == self._shown:
            return
        self._passing, self._shown = False, shown
        self._bar.show_error(error, *self._mends(error, key, layer), about=about)
        if shown.here:
            self._canvas.show_error(error)
        else:
            self._canvas.clear_error()

    def _most_pressing(self) -> Key | None:
        """Return the failed span of the current layer under the playhead, or else the first."""
        current = self._workspace.selection.layer

        def urgency(key: Key) -> tuple[bool, bool]:
            layer = self._workspace.session.document.layer(key[0])
            return layer is not current, self._span_in_view(layer) != key[1]

        return min(self._workspace.solver.errors, key=urgency, default=None)

    def _span_in_view(self, layer: Layer) -> int:
        return layer.span_at(self._workspace.playhead.frame)[0]

    def _on_closed(self) -> None:
        if self._shown is not None:
            self._dismissed = self._shown.error
        self._clear()
        self._follow_soon()

    def _clear(self) -> None:
        self._passing, self._refused, self._shown = False, False, None
        self._bar.clear()
        self._canvas.clear_error()

    def _solved(self) -> tuple[Layer, int, Morph] | None:
        """Return what is solved under the playhead: layer, span index and solution."""
        layer = self._workspace.selection.layer
        if layer is None or not layer.spans or self._workspace.session.dragging:
            return None
        index, solver = self._span_in_view(layer), self._workspace.solver
        if solver.state(layer.id, index) is not SpanState.SOLVED:
            return None
        morph = solver.morph_of(span_of(layer, index))
        return None if morph is None else (layer, index, morph)

    def _tell_repairs(self) -> bool:
        """Tell of each keyframe once, while it lasts, that it had to be repaired, and where."""
        if (solved := self._solved()) is None:
            return False
        layer, index, morph = solved
        for at, side in ((index, "source"), (index + 1, "target")):
            key = layer.id, at
            repairs = [r for r in morph.report.repairs if r.where.side == side and r.moved > UNSEEN]
            if not repairs:
                self._told.discard(key)
            elif key not in self._told:
                self._told.add(key)
                text = self.tr("{repairs} What you drew is kept as it is.")
                show = self.tr("Show place"), partial(self._show_place, repairs[0], (key[0], index))
                self.note(text.format(repairs=" ".join(map(str, repairs))), show)
                self._canvas.show_error(repairs[0])
                return True
        return False

    def _offer_mirror(self) -> None:
        """Offer the mirrored target once, where it would match far better."""
        if (solved := self._solved()) is None:
            return
        layer, index, morph = solved
        span = span_of(layer, index)
        if not morph.report.mirror or span in self._offered:
            return
        self._offered.add(span)
        self.note(
            self.tr("The target matches far better mirrored."),
            (self.tr("Mirror target"), partial(self._mirror, layer.id, index + 1)),
        )

    def _mirror(self, layer_id: int, key: int) -> None:
        """Mirror a keyframe left to right, where it is."""
        target = self._workspace.session.document.layer(layer_id).keyframes[key]
        text, mirrored = self.tr("Mirror target"), target.outline.mirrored()
        self._workspace.session.apply(text, replace_outline, layer_id, key, mirrored, target.marks)

    # -- mending -------------------------------------------------------------------------------

    def _mends(self, error: MorphError, key: Key, layer: Layer) -> list[Action]:
        actions: list[Action] = []
        marks = [mark for mark in error.where.marks if mark < len(layer.labels)]
        if marks:
            chosen = self._workspace.selection.mark  # most likely the one that was moved just now
            mark = chosen if chosen in marks else marks[-1]
            text = self.tr("Delete mark {letter}").format(letter=layer.labels[mark])
            actions.append((text, partial(self._remove_mark, layer.id, mark, text)))
        if _has_place(error.where):
            actions.append((self.tr("Show place"), partial(self._show_place, error, key)))
        elif not actions and self._workspace.session.undo_stack.canUndo():
            step = self._workspace.session.undo_stack.undoText()
            text = self.tr("Undo {step}").format(step=step)
            actions.append((text, self._workspace.session.undo))
        return actions

    def _remove_mark(self, layer_id: int, mark: int, text: str) -> None:
        self._workspace.session.apply(text, remove_marks, layer_id, [mark])

    def _show_place(self, error: Trouble, key: Key) -> None:
        """Go to the keyframe that is or was wrong, with the tool that can mend it."""
        layer_id, index = key
        keyframes = self._workspace.session.document.layer(layer_id).keyframes
        at = index + (error.where.side == "target")
        self._workspace.playhead.stop()
        first, last = keyframes[index].frame, keyframes[index + 1].frame
        if not first <= self._workspace.playhead.frame < last:
            self._workspace.playhead.move_to(first)
        self._workspace.selection.select_key(layer_id, at)
        if isinstance(error, MarkError):
            self._canvas.set_tool("marks")
        elif isinstance(error, OutlineError | Repair):
            self._canvas.set_tool("nodes")
        self._canvas.framing.fit()
        self._canvas.show_error(error)

    def _save_as(self) -> None:
        self._clear()
        self._files.save_as()


def _has_place(where: Where) -> bool:
    return bool(where.marks) or where.point is not None or where.node is not None
