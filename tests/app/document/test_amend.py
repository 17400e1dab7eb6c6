"""Edits of one gesture are one undo step, though nothing stays open between them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from app.document.session import Session
from core.model import Document
from core.model.edits import update_document


@pytest.fixture
def session(qapp: object) -> Iterator[Session]:
    session = Session(Document())
    yield session
    session.close()


def fps(session: Session, gesture: object, value: float) -> None:
    session.amend(gesture, "Frame rate", update_document, fps=value)


def test_a_gesture_is_one_step_and_undo_restores_the_identical_document(session: Session) -> None:
    before = session.document
    for value in (1.0, 12.0, 120.0):
        fps(session, "typing", value)
    assert session.undo_stack.count() == 1
    session.undo()
    assert session.document is before
    session.redo()
    assert session.document.fps == 120.0


def test_another_gesture_is_another_step(session: Session) -> None:
    fps(session, "typing", 12.0)
    fps(session, "typing again", 30.0)
    session.undo()
    assert session.document.fps == 12.0


def test_any_edit_in_between_ends_the_gesture(session: Session) -> None:
    fps(session, "typing", 12.0)
    session.apply("Background", update_document, background="")
    fps(session, "typing", 30.0)
    assert session.undo_stack.count() == 3


def test_a_gesture_that_ends_where_it_began_leaves_no_step(session: Session) -> None:
    fps(session, "typing", 12.0)
    fps(session, "typing", 24.0)
    assert session.undo_stack.count() == 0
    assert not session.dirty


def test_what_was_saved_can_be_undone_to(session: Session, tmp_path: Path) -> None:
    fps(session, "typing", 12.0)
    session.mark_saved(tmp_path / "a.betwixt")
    fps(session, "typing", 30.0)
    assert session.dirty
    session.undo()
    assert session.document.fps == 12.0
    assert not session.dirty
