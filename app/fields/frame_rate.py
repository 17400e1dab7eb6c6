"""Frames per second: the usual ones to choose, any to type."""

from __future__ import annotations

from PySide6.QtCore import QLocale, Qt
from PySide6.QtWidgets import QComboBox, QWidget

from app.document.session import Session
from app.fields.calm import CalmWheel
from app.style import TARGET_SIZE
from core.model import Document
from core.model.edits import update_document

USUAL = (12, 24, 25, 30, 60)
LEAST, MOST = 1.0, 240.0


class FrameRateField(CalmWheel, QComboBox):
    """Shows and edits the frame rate of the session's document."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent, editable=True)
        self.setAccessibleName(self.tr("Frames per second"))
        self.setToolTip(self.tr("Frames per second: choose, or type any"))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumHeight(TARGET_SIZE)
        self.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.addItems([str(fps) for fps in USUAL])
        self.setCompleter(None)  # who types 6 does not mean 60
        self._session = session
        self._shown, self._told = 0.0, ""
        self.activated.connect(self._apply)
        self.lineEdit().editingFinished.connect(self._apply)
        session.changed.connect(self._show)
        self._show(session.document)

    def _show(self, document: Document) -> None:
        if document.fps != self._shown:  # else leave alone what is being typed
            self._shown = document.fps
            self._told = QLocale().toString(document.fps, "g", 6)
            self.setEditText(self._told)

    def _apply(self) -> None:
        if self.currentText() == self._told:  # nothing was typed, and this may be rounded
            return
        fps, understood = QLocale().toDouble(self.currentText())
        if understood and LEAST <= fps <= MOST:
            self._session.apply(self.tr("Change frame rate"), update_document, fps=fps)
        else:
            self._shown = 0.0
        self._show(self._session.document)
