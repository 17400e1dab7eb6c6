"""The properties panel: what is chosen, in numbers and colours."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QFrame, QScrollArea, QVBoxLayout, QWidget

from app.panels.document_section import DocumentSection
from app.panels.layer_section import LayerSection
from app.panels.mapping_section import MappingSection
from app.panels.onion_section import OnionSection
from app.panels.result_section import ResultSection
from app.panels.span_section import KeyframeSection, SpanSection
from app.workspace import Workspace

WIDTH = 276


class PropertiesPanel(QScrollArea):
    """Sections that follow the selection and the playhead. Every edit is one undo step."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent, widgetResizable=True, frameShape=QFrame.Shape.NoFrame)
        self.setAccessibleName(self.tr("Properties"))
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setMinimumWidth(WIDTH)
        self.layer = LayerSection(workspace)
        self.keyframe = KeyframeSection(workspace)
        self.span = SpanSection(workspace)
        self.mapping = MappingSection(workspace)
        self.result = ResultSection(workspace)
        self.document = DocumentSection(workspace)
        self.onion = OnionSection(workspace)
        self._sections = (
            self.layer,
            self.keyframe,
            self.span,
            self.mapping,
            self.result,
            self.document,
            self.onion,
        )
        body = QWidget()
        column = QVBoxLayout(body)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        for section in self._sections:
            column.addWidget(section)
        column.addStretch(1)
        self.setWidget(body)
        workspace.session.changed.connect(self._refresh)
        workspace.selection.changed.connect(self._refresh)
        workspace.playhead.moved.connect(self.span.refresh)
        workspace.playhead.moved.connect(self.result.follow)
        workspace.solver.updated.connect(self.result.refresh)
        workspace.solver.updated.connect(self.span.show_angle)
        workspace.inspector.changed.connect(self.result.refresh)
        self._refresh()

    def sizeHint(self) -> QSize:
        """Return a width at which nothing is clipped."""
        return QSize(WIDTH + 20, 600)

    def _refresh(self) -> None:
        for section in self._sections:
            section.refresh()
