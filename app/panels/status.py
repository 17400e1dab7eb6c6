"""The status bar: what the next click does, how solving goes, and the verdict on the frame."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, QTimer, Signal
from PySide6.QtWidgets import QLabel, QProgressBar, QPushButton, QSizePolicy, QStatusBar, QWidget

from app.jobs.solver import SpanState
from app.style import colours
from app.verdict import describe_frame, describe_span
from app.workspace import Workspace
from core.model import Layer
from core.morph.scene import span_of

TELL_MS = 50
"""How often progress is shown."""
PATIENCE_MS = 200
"""Solving that is done sooner goes unmentioned, so that nothing flickers."""


class StatusStrip(QStatusBar):
    """Hint at the left, solving and verdict at the right."""

    cancel_asked = Signal()

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self.setSizeGripEnabled(False)
        self.setContentsMargins(10, 0, 10, 0)
        self.hint = QLabel(textFormat=Qt.TextFormat.PlainText)
        self.hint.setAccessibleName(self.tr("What the next click does"))
        self.hint.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.stage = QLabel(textFormat=Qt.TextFormat.PlainText)
        self.bar = QProgressBar(maximum=1000, textVisible=False)
        self.bar.setAccessibleName(self.tr("Solving"))
        self.bar.setFixedSize(120, 8)
        self.cancel = QPushButton(self.tr("Cancel"))
        self.cancel.setAccessibleName(self.tr("Cancel solving"))
        self.cancel.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.cancel.clicked.connect(self.cancel_asked)
        self.badge = QLabel()
        self.badge.setAccessibleName(self.tr("Verdict on the frame on screen"))
        self.addWidget(self.hint, 1)
        for widget in (self.stage, self.bar, self.cancel, self.badge):
            self.addPermanentWidget(widget)
        self._late = QTimer(self, singleShot=True, interval=PATIENCE_MS)
        self._late.timeout.connect(self._show_solving)
        self._told: tuple[float, str] = (0.0, "")
        self._tell = QTimer(self, singleShot=True, interval=TELL_MS)
        self._tell.timeout.connect(self._show_progress)
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._judge)
        workspace.solver.busy_changed.connect(self._on_busy)
        workspace.solver.progress.connect(self._on_progress)
        for signal in (
            workspace.solver.updated,
            workspace.inspector.changed,
            workspace.session.changed,
            workspace.selection.changed,
            workspace.playhead.moved,
        ):
            signal.connect(self._judge_soon)
        self._on_busy(workspace.solver.busy)

    def set_hint(self, hint: str) -> None:
        """Say what the next click does."""
        self.hint.setText(hint)
        self.hint.setToolTip(hint)

    # -- solving -------------------------------------------------------------------------------

    def _on_busy(self, busy: bool) -> None:
        if busy:
            self._late.start()
        else:
            self._late.stop()
            self._set_solving(False)
        self._judge()

    def _show_solving(self) -> None:
        self._set_solving(True)
        self._judge()

    def _set_solving(self, shown: bool) -> None:
        for widget in (self.stage, self.bar, self.cancel):
            widget.setVisible(shown)

    def _on_progress(self, fraction: float, stage: str) -> None:
        self._told = fraction, stage
        if not self._tell.isActive():
            self._tell.start()

    def _show_progress(self) -> None:
        fraction, stage = self._told
        if self.bar.isVisible():  # a bar repaints at once, which would cost the drag its frames
            self.bar.setValue(round(1000 * fraction))
            self.stage.setText(self.tr("Solving: {stage}").format(stage=stage) if stage else "")

    # -- the verdict ---------------------------------------------------------------------------

    def _judge_soon(self) -> None:
        """Judge once what several signals announce, when all have heard of it."""
        self._soon.start()

    def _judge(self) -> None:
        """Judge the current layer's in-between on screen."""
        layer, frame = self._workspace.selection.layer, self._workspace.playhead.frame
        c = colours()
        if layer is None or not layer.spans or not layer.visible:
            self._set_verdict("", c.muted, "")
            return
        index, _ = layer.span_at(frame)
        state = self._workspace.solver.state(layer.id, index)
        if state is SpanState.SOLVING:
            if not self._late.isActive():  # else the last verdict may stand for a moment
                self._set_verdict(self.tr("updating…"), c.solving, "")
        elif state is SpanState.FAILED:
            text = self.tr("The shape on screen is the last one that could be computed.")
            self._set_verdict(self.tr("not solved"), c.error, text)
        elif state is SpanState.NONE:
            self._set_verdict(self.tr("out of date"), c.solving, "")
        else:
            self._judge_frame(layer, index)

    def _judge_frame(self, layer: Layer, index: int) -> None:
        """Judge the in-between on screen by what the inspector saw."""
        workspace, c = self._workspace, colours()
        report = workspace.solver.morph_of(span_of(layer, index)).report
        tip = self.tr(
            "{triangles} triangles, mean distortion {mean:.3f}, smallest angle {angle:.0f}°"
        ).format(
            triangles=report.triangles,
            mean=report.distortion_mean,
            angle=57.29578 * report.smallest_angle,
        )
        tip = f"{describe_span(workspace.inspector, layer.id, index)}\n{tip}"
        drawn = workspace.session.document.drawn_at(workspace.playhead.frame)
        check = workspace.inspector.frame_check(layer.id, drawn)
        if check is None:
            self._set_verdict(self.tr("checking…"), c.solving, tip)
        elif check.sound:
            self._set_verdict(self.tr("sound"), c.solved, tip)
        else:
            self._set_verdict(describe_frame(check), c.error, tip)

    def _set_verdict(self, text: str, colour: str, tip: str) -> None:
        self.badge.setVisible(bool(text))
        self.badge.setToolTip(tip)
        self.badge.setText(f'<span style="color:{colour}">●</span>&nbsp; {text}')

    def changeEvent(self, event: QEvent) -> None:
        """Follow the theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "badge"):
            self._judge()
