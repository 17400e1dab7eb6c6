"""A locked layer stays as it is, whichever way an edit comes from; undo alone goes through it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from app.document.session import Session
from app.files.placing import Place, set_key
from app.panels.layer_section import restyle
from app.panels.mapping_section import remix
from core.io.importers import Part
from core.model import Document, Keyframe, Layer, Outline, edits

SQUARE = Outline.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])
PART = Part("part", Outline.polygon([(0, 0), (20, 0), (0, 20)]), None)


@pytest.fixture
def session(qapp: object) -> Session:
    keys = (Keyframe(1, SQUARE), Keyframe(9, SQUARE))
    free, locked = Layer(1, "free", keys), Layer(2, "kept", keys, locked=True)
    return Session(Document((free, locked)))


@pytest.mark.parametrize(
    ("edit", "arguments"),
    [
        (edits.remove_layer, ()),
        (edits.move_keyframe, (1, 12)),
        (edits.replace_outline, (0, SQUARE.mirrored().transformed(np.eye(2), (5, 0)), ())),
        (set_key, (Place.TARGET, PART, 1.0)),
        (edits.hang_layer, (1,)),
    ],
)
def test_nothing_changes_the_shape_or_motion_of_a_locked_layer(
    session: Session, edit: Callable[..., Document], arguments: tuple[Any, ...]
) -> None:
    before, refused = session.document, []
    session.failed.connect(refused.append)
    assert not session.apply("Edit", edit, 2, *arguments)
    assert session.document is before
    assert "“kept” is locked" in refused[0].what
    session.apply("Unlock", edits.update_layer, 2, locked=False)
    assert session.apply("Edit", edit, 2, *arguments)


def test_its_style_and_recipe_stay_too(session: Session) -> None:
    before = session.document
    session.apply("Edit", restyle, 2, fill="#123456")
    session.apply("Edit", remix, 2, density=40)
    session.begin("Drag").apply(restyle, 2, fill="#123456")
    assert session.document is before


def test_a_locked_layer_can_be_named_shown_reordered_and_unlocked(session: Session) -> None:
    assert session.apply("Edit", edits.update_layer, 2, name="other", visible=False)
    assert session.apply("Edit", edits.reorder_layer, 2, 0)
    assert session.apply("Edit", edits.update_layer, 2, locked=False)
    assert session.apply("Edit", edits.remove_layer, 2)


def test_undo_reaches_back_through_a_lock(session: Session) -> None:
    session.apply("Unlock", edits.update_layer, 2, locked=False)
    session.apply("Delete", edits.remove_layer, 2)
    session.undo()
    session.undo()
    assert session.document.layer(2).locked
