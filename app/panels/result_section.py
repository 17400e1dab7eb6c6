"""What the solver made of the span under the playhead."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from app.jobs.solver import SpanState
from app.panels.section import Section
from app.workspace import Workspace
from core.model import Layer
from core.morph.report import Report
from core.morph.scene import span_of


class ResultSection(Section):
    """How good the mapping is, what it took, and what was repaired; read only."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(self.tr("Result"), workspace, parent)
        self.state = _text()
        self.state.setAccessibleName(self.tr("State of the result"))
        self.add_wide(self.state)
        self._values: dict[str, QLabel] = {}
        self._shown = 0
        for name, text, tip in (
            ("mesh", self.tr("Mesh"), self.tr("Vertices and triangles")),
            ("folds", self.tr("Folds"), self.tr("Inverted triangles at the source and the target")),
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

    def text(self, name: str) -> str:
        """Return what is shown in a row."""
        return self._values[name].text()

    def _show(self, layer: Layer, index: int) -> None:
        solver = self.workspace.solver
        morph = solver.morph_of(span_of(layer, index))
        state = solver.state(layer.id, index)
        error = solver.errors.get((layer.id, index)) if state is SpanState.FAILED else None
        self.state.setText(self._state(state, known=morph is not None, error=error))
        for value in self._values.values():
            value.setEnabled(state is SpanState.SOLVED)
            if morph is None:
                value.setText("–")
        if morph is not None:
            self._show_report(morph.report)

    def _state(self, state: SpanState, *, known: bool, error: object) -> str:
        stale = self.tr("Below: the result before the last change.") if known else ""
        return {
            SpanState.SOLVED: self.tr("✓ Solved"),
            SpanState.SOLVING: " ".join((self.tr("… Solving."), stale)),
            SpanState.FAILED: " ".join((self.tr("⚠ {}").format(error), stale)),
            SpanState.NONE: " ".join((self.tr("○ Not solved."), stale)),
        }[state].strip()

    def _show_report(self, report: Report) -> None:
        shown = {
            "mesh": self.tr("{} vertices\n{} triangles").format(report.vertices, report.triangles),
            "folds": self._folds(len(report.folds_source), len(report.folds_target)),
            "mean": _distortion(report.distortion_mean),
            "worst": _distortion(report.distortion_worst),
            "time": _milliseconds(report.seconds),
            "repairs": "\n".join(report.repairs) or self.tr("none"),
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
