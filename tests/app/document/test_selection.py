"""Undo and redo bring back what was selected."""

from __future__ import annotations

import gc
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from PySide6.QtWidgets import QApplication

from app.document.selection import Selection
from app.document.session import Session
from app.workspace import Workspace
from core.model import Document, Outline
from core.model.edits import (
    add_layer,
    delete_nodes,
    insert_keyframe,
    move_nodes,
    remove_keyframe,
    remove_layer,
    remove_marks,
)
from tests.card import SQUARE, a_document

OpenWorkspace = Callable[..., Workspace]


def two_layers() -> Document:
    return add_layer(a_document(), "Other", 1, Outline.polygon(SQUARE))


def test_what_is_deleted_is_selected_again_when_it_is_back(open_workspace: OpenWorkspace) -> None:
    space = open_workspace(a_document())
    selection, session = space.selection, space.session
    selection.select_key(1, 1)
    selection.select_nodes(frozenset({(0, 3)}))
    session.apply("", delete_nodes, 1, 1, 0, [3])
    assert selection.nodes == frozenset()
    session.undo()
    assert (selection.key, selection.nodes) == (1, {(0, 3)})
    selection.select_mark(1)
    session.apply("", remove_marks, 1, [1])
    assert selection.mark is None
    session.undo()
    assert selection.mark == 1
    session.redo()
    assert selection.mark is None


def test_undo_goes_back_to_the_layer_that_it_changes(open_workspace: OpenWorkspace) -> None:
    space = open_workspace(two_layers())
    selection, session = space.selection, space.session
    selection.select_layer(1)
    session.apply("", move_nodes, 1, 0, 0, [0], (5, 5))
    selection.select_layer(2)
    session.undo()
    assert selection.layer.id == 1
    session.apply("", remove_layer, 1)
    assert selection.layer.id == 2
    session.undo()
    assert selection.layer.id == 1


def test_the_selection_stays_on_its_key_where_others_come_and_go_before_it(
    qapp: QApplication,
) -> None:
    session = Session(a_document())
    selection = Selection(session)
    selection.select_key(1, 1)
    selection.select_nodes(frozenset({(0, 2)}))
    chosen, told = selection.keyframe, []
    selection.changed.connect(lambda: told.append(selection.key))
    session.apply("", insert_keyframe, 1, replace(chosen, frame=13))
    assert (selection.keyframe, selection.nodes) == (chosen, {(0, 2)})
    session.apply("", remove_keyframe, 1, 0)
    assert (selection.keyframe, selection.nodes) == (chosen, {(0, 2)})
    assert told == [2, 1]
    session.apply("", remove_keyframe, 1, 1)
    assert (selection.keyframe.frame, selection.nodes) == (13, frozenset())


def test_a_drag_keeps_no_document_alive_for_its_selection(qapp: QApplication) -> None:
    session = Session(a_document())  # without others who look at documents in the background
    selection = Selection(session)
    drag = session.begin("Move")
    for step in np.linspace(0, 9, 50):
        drag.apply(move_nodes, 1, 0, 0, [0], (step, 0))
    drag.commit()
    gc.collect()
    session.apply("", move_nodes, 1, 0, 0, [0], (1, 0))
    assert len(selection._kept) <= 4


def test_another_document_starts_with_a_selection_of_its_own(open_workspace: OpenWorkspace) -> None:
    space = open_workspace(two_layers())
    space.selection.select_layer(1)
    space.session.apply("", remove_layer, 2)
    space.session.replace(two_layers())
    assert space.selection.layer.id == 2
