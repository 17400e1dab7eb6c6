"""What comes between the press and the release of a drag on the canvas."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from PySide6.QtCore import Qt

from app.canvas.moment import Role
from core.model import Keyframe, Outline
from core.model.edits import insert_keyframe, update_layer
from tests.app.canvas.conftest import Hand
from tests.card import LEANING, a_document

SOURCE = Role.SOURCE
MIDDLE = Qt.MouseButton.MiddleButton
INSIDE, THERE, BEYOND = (450.0, 300.0), (480.0, 310.0), (500.0, 330.0)


@pytest.fixture
def hand(open_canvas: Callable[..., Hand]) -> Hand:
    return open_canvas(a_document())


def test_the_middle_button_does_not_keep_a_left_drag_from_ending(hand: Hand):
    hand.pull(SOURCE, INSIDE, THERE)
    hand.press(SOURCE, THERE, button=MIDDLE)
    hand.release(SOURCE, THERE)
    hand.release(SOURCE, THERE, button=MIDDLE)
    moved = hand.document
    assert not hand.workspace.session.dragging
    hand.move(SOURCE, BEYOND)
    assert hand.document is moved
    assert hand.steps == ["Move outline"]


def test_the_left_button_does_not_end_or_change_a_pan_of_the_middle_one(hand: Hand):
    before, corner = hand.document, hand.pixel(SOURCE, INSIDE)
    hand.press(SOURCE, INSIDE, button=MIDDLE)
    hand.press(SOURCE, INSIDE)
    hand.release(SOURCE, INSIDE)
    at = hand.pixel(SOURCE, THERE)
    hand.move(SOURCE, THERE, held=MIDDLE)
    assert hand.pixel(SOURCE, INSIDE) == at
    assert at != corner
    hand.release(SOURCE, INSIDE, button=MIDDLE)
    hand.move(SOURCE, BEYOND)
    assert hand.pixel(SOURCE, INSIDE) == at
    assert hand.document is before


def test_an_edit_during_a_drag_ends_it_and_both_are_kept(hand: Hand):
    session = hand.workspace.session
    hand.pull(SOURCE, INSIDE, THERE)
    moved = hand.points()
    key = Keyframe(13, Outline.polygon(LEANING), hand.document.layers[0].keyframes[0].marks)
    session.apply("Insert keyframe", insert_keyframe, 1, key)
    hand.move(SOURCE, BEYOND, held=Qt.MouseButton.LeftButton)
    hand.release(SOURCE, BEYOND)
    assert [key.frame for key in hand.document.layers[0].keyframes] == [1, 13, 25]
    np.testing.assert_array_equal(hand.points(), moved)
    assert hand.steps == ["Move outline", "Insert keyframe"]


def test_escape_after_an_edit_during_a_drag_takes_neither_back(hand: Hand):
    hand.pull(SOURCE, INSIDE, THERE)
    hand.workspace.session.apply("Rename layer", update_layer, 1, name="Leaf")
    renamed = hand.document
    hand.key(SOURCE, Qt.Key.Key_Escape)
    hand.release(SOURCE, THERE)
    assert hand.document is renamed
    assert hand.steps == ["Move outline", "Rename layer"]
