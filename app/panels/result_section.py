"""What the solver made of the span under the playhead."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QPushButton, QSizePolicy, QWidget

from app.jobs.inspector import Standing
from app.jobs.solver import SpanState
from app.jobs.urgency import Key
from app.panels.section import Section
from app.verdict import describe_span, troubled_frames
from app.workspace import Workspace
from core.model import Layer
from core.morph.report import Report
from core.morph.scene import span_of

SIGNS = {
    Standing.NONE: "○",
    Standing.STALE: "○",
    Standing.SOLVING: "…",
    Standing.FAILED: "✕",
    Standing.CHECKING: "…",
    Standing.SOUND: "✓",
    Standing.UNSOUND: "⚠",
}


class ResultSection(Section):
    """How good the mapping is, what it took, and what was repaired; read only."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(self.tr("Result"), workspace, parent)
        self.state = _text()
        self.state.setAccessibleName(self.tr("State of the result"))
        self.add_wide(self.state)
        self.go = QPushButton()
        self.go.setToolTip(self.tr("Show the next frame in which something folds or crosses"))
        self.go.setAccessibleName(self.tr("Go to the next troubled frame"))
        self.go.clicked.connect(self._go)
        self.add_wide(self.go)
        self._values: dict[str, QLabel] = {}
        self._shown = 0
        self._next = 0
        for name, text, tip in (
            ("mesh", self.tr("Mesh"), self.tr("Vertices and triangles")),
            ("folds", self.tr("Map folds"), self.tr("Inverted triangles at source and target")),
            ("mean", self.tr("Distortion"), self.tr("Mean over the area; 1 is perfectly rigid")),
            ("worst", self.tr("Worst"), self.tr("Distortion of the worst triangle")),
            ("time", self.tr("Solved in"), ""),
            ("repairs", self.tr("Repairs"), self.tr("What was changed in the outlines")),
        ):
            value = _text()
            value.setToolTip(tip)
            self.add_row(text, value).setToolTip(tip)
            self._values[name] = value

    def refresh(self) -> None:
        """Show the result of the span under the playhead."""
        layer = self.workspace.selection.layer
        self.setVisible(layer is not None and layer.spans > 0)
        if layer is not None and layer.spans:
            self._shown = layer.span_at(self.workspace.playhead.frame)[0]
            self._show(layer, self._shown)

    def follow(self, frame: float) -> None:
        """Show the result of another span, if the playhead is in one now."""
        layer = self.workspace.selection.layer
        if layer is not None and layer.span_at(frame)[0] != self._shown:
            self.refresh()
        elif layer is not None:
            self._show_way(layer, self._shown)

    def text(self, name: str) -> str:
        """Return what is shown in a row."""
        return self._values[name].text()

    def _show(self, layer: Layer, index: int) -> None:
        solver, place = self.workspace.solver, (layer.id, index)
        morph = solver.morph_of(span_of(layer, index))
        state = solver.state(*place)
        stale = morph is not None and state is not SpanState.SOLVED
        self.state.setText(self._verdict(place, stale=stale))
        self._show_way(layer, index)
        for value in self._values.values():
            value.setEnabled(state is SpanState.SOLVED)
            if morph is None:
                value.setText("–")
        if morph is not None:
            self._show_report(morph.report)

    def _verdict(self, place: Key, *, stale: bool) -> str:
        """Say how the span stands, and whether the numbers below are older than that."""
        inspector = self.workspace.inspector
        words = f"{SIGNS[inspector.standing(*place)]} {describe_span(inspector, *place)}"
        return f"{words} {self.tr('Below: the result before the last change.')}" if stale else words

    def _show_way(self, layer: Layer, index: int) -> None:
        """Offer to go to the next troubled frame after the playhead, or else to the first."""
        troubled = troubled_frames(self.workspace.inspector.check(layer.id, index))
        self.go.setVisible(bool(troubled))
        if troubled:
            here = self.workspace.playhead.frame
            self._next = next((frame for frame in troubled if frame > here), troubled[0])
            self.go.setText(self.tr("Go to frame {}").format(self._next))

    def _go(self) -> None:
        self.workspace.playhead.stop()
        self.workspace.playhead.move_to(self._next)

    def _show_report(self, report: Report) -> None:
        shown = {
            "mesh": self.tr("{} vertices\n{} triangles").format(report.vertices, report.triangles),
            "folds": self._folds(len(report.folds_source), len(report.folds_target)),
            "mean": _distortion(report.distortion_mean),
            "worst": _distortion(report.distortion_worst),
            "time": _milliseconds(report.seconds),
            "repairs": "\n".join(map(str, report.repairs)) or self.tr("none"),
        }
        for name, text in shown.items():
            self._values[name].setText(text)
        stages = (
            f"{stage.name}: {_milliseconds(stage.seconds)}, {stage.result}"
            for stage in report.stages
        )
        self._values["time"].setToolTip("\n".join(stages))

    def _folds(self, source: int, target: int) -> str:
        if not source and not target:
            return self.tr("none")
        return self.tr("⚠ {} source, {} target").format(source, target)


def _text() -> QLabel:
    label = QLabel(wordWrap=True)
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label


def _distortion(value: float) -> str:
    return f"{value:.3f}" if math.isfinite(value) else "∞"


def _milliseconds(seconds: float) -> str:
    return f"{1000 * seconds:.1f} ms" if seconds < 1 else f"{seconds:.2f} s"
