"""The one writer: the current document, its history, and the file it lives in."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from core.errors import MorphError
from core.model import Document
from core.model.edits import require_locks_kept


class Session(QObject):
    """Holds the document. Everything else reads it here and changes it through here.

    An edit is ``session.apply(text, edit, *args)`` with a pure function of ``core.model.edits``.
    A gesture of the mouse is the ``Drag`` that ``begin(text)`` returns. Every other edit, undo and
    saving end it first, so that they keep what it has done so far.
    Where no end can be told, as when a number is typed, ``amend`` joins the steps of one gesture.
    """

    changed = Signal(object)
    """The new Document: after every edit, undo, redo, and while dragging."""
    replaced = Signal()
    """Another document was opened; emitted after ``changed``."""
    failed = Signal(object)
    """A MorphError: an edit was refused and nothing changed."""
    file_changed = Signal()
    """The path or the unsaved state changed."""

    def __init__(self, document: Document | None = None, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._document = document or Document()
        self._drag: Drag | None = None
        self.path: Path | None = None
        self.undo_stack = QUndoStack(self)
        self.undo_stack.cleanChanged.connect(self._on_clean_changed)

    @property
    def document(self) -> Document:
        """The document as it is now, an unfinished drag included."""
        return self._document

    @property
    def dragging(self) -> bool:
        """Whether a drag is under way."""
        return self._drag is not None

    @property
    def dirty(self) -> bool:
        """Whether there is unsaved work."""
        return not self.undo_stack.isClean()

    def apply(self, text: str, edit: Callable[..., Document], *args: Any, **kwargs: Any) -> bool:
        """Replace the document by ``edit(document, *args, **kwargs)``; return whether it changed.

        ``text`` names the step in the Edit menu. A refused edit emits ``failed``.
        """
        return self._apply(None, text, lambda document: edit(document, *args, **kwargs))

    def amend(
        self, gesture: object, text: str, edit: Callable[..., Document], *args: Any, **kwargs: Any
    ) -> bool:
        """Do as ``apply``, in one undo step with the last one if that had the same gesture.

        Nothing stays open in between, so other edits, undo and saving may come at any time.
        """
        return self._apply(gesture, text, lambda document: edit(document, *args, **kwargs))

    def _apply(self, gesture: object, text: str, edit: Callable[[Document], Document]) -> bool:
        self.commit()
        before = self._document
        after = self._edited(before, edit)
        if after is before:
            return False
        self.undo_stack.push(_Swap(self, text, before, after, gesture))
        return True

    def _edited(self, document: Document, edit: Callable[[Document], Document]) -> Document:
        """Return the document after an edit; if that is refused, say why and keep what is."""
        try:
            edited = edit(document)
            require_locks_kept(document, edited)
        except MorphError as error:
            self.failed.emit(error)
            return self._document
        return edited

    def begin(self, text: str) -> Drag:
        """Start a drag, named for the Edit menu."""
        self.commit()
        self._drag = Drag(self, text)
        return self._drag

    def commit(self) -> None:
        """End the drag that is under way, if any is, and keep what it has done."""
        if self._drag is not None:
            self._drag.commit()

    def undo(self) -> None:
        """Take back the last step; an unfinished drag counts as one."""
        self.commit()
        self.undo_stack.undo()

    def redo(self) -> None:
        """Do the step again that was taken back last."""
        self.commit()
        self.undo_stack.redo()

    def replace(self, document: Document, path: Path | None = None, *, saved: bool = True) -> None:
        """Open another document, with an empty history; ``saved=False`` for a recovered one."""
        self._drag = None
        self.path = path
        self.undo_stack.clear()
        if not saved:
            self.undo_stack.resetClean()
        self._document = document
        self.changed.emit(document)
        self.replaced.emit()
        self.file_changed.emit()

    def mark_saved(self, path: Path) -> None:
        """Note that the document as it is now is in this file."""
        self.path = path
        self.undo_stack.setClean()
        self.file_changed.emit()

    def close(self) -> None:
        """Cut the signals and drop the history before Qt takes the objects apart.

        Steps that are left would be freed twice: by Qt, and with what they hold of Python's.
        """
        self.undo_stack.cleanChanged.disconnect(self._on_clean_changed)
        self.undo_stack.clear()

    def _on_clean_changed(self, _clean: bool) -> None:
        self.file_changed.emit()

    def _show(self, document: Document) -> None:
        if document is not self._document:
            self._document = document
            self.changed.emit(document)


class Drag:
    """An edit still in the making: one undo step, or none if nothing changed in the end.

    Each ``apply`` starts from the document at the beginning. Once it has ended, it does nothing.
    """

    def __init__(self, session: Session, text: str) -> None:
        self._session, self._text, self._before = session, text, session.document

    @property
    def open(self) -> bool:
        """Whether it is still under way; undo or another edit may have ended it."""
        return self._session._drag is self

    def apply(self, edit: Callable[..., Document], *args: Any, **kwargs: Any) -> None:
        """Show ``edit(document at the beginning, *args, **kwargs)``."""
        if self.open:
            session = self._session
            edited = session._edited(self._before, lambda before: edit(before, *args, **kwargs))
            session._show(edited)

    def commit(self) -> None:
        """End it and keep what it has done."""
        if self._end() and self._session.document is not self._before:
            swap = _Swap(self._session, self._text, self._before, self._session.document)
            self._session.undo_stack.push(swap)

    def abandon(self) -> None:
        """End it and go back to the document before it."""
        if self._end():
            self._session._show(self._before)

    def _end(self) -> bool:
        ending = self.open
        if ending:
            self._session._drag = None
        return ending


class _Swap(QUndoCommand):
    """One step: the documents before and after it, so that no inverse can be wrong."""

    def __init__(
        self,
        session: Session,
        text: str,
        before: Document,
        after: Document,
        gesture: object = None,
    ) -> None:
        super().__init__(text)
        self._session, self._before, self._after = session, before, after
        self._gesture = gesture

    def id(self) -> int:
        """Return which commands may merge; -1 is none."""
        return -1 if self._gesture is None else 1

    def mergeWith(self, other: QUndoCommand) -> bool:
        """Take in the next step of the same gesture; together they may change nothing."""
        if not isinstance(other, _Swap) or other._gesture != self._gesture:
            return False
        self._after = other._after
        self.setObsolete(self._before == self._after)
        return True

    def undo(self) -> None:
        self._session._show(self._before)

    def redo(self) -> None:
        self._session._show(self._after)
