from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt

from app.canvas.moment import Role
from app.canvas.tools.transform_box import TransformBox
from core.model import Outline
from core.model.edits import add_layer
from tests.app.canvas.conftest import Hand
from tests.card import LEANING, SQUARE, a_document

SOURCE, BETWEEN, TARGET = Role.SOURCE, Role.IN_BETWEEN, Role.TARGET
SHIFT, ALT = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.AltModifier
TOP_LEFT, TOP, RIGHT, BOTTOM_RIGHT = 0, 1, 3, 4
INSIDE = (450.0, 300.0)


@pytest.fixture
def hand(open_canvas: Callable[..., Hand]) -> Hand:
    return open_canvas(a_document())


def handle(hand: Hand, index: int) -> np.ndarray:
    """Where in the document a handle of the source's box is."""
    view = hand.pane(SOURCE).view
    box = TransformBox.around(hand.document.layers[0].keyframes[0].outline)
    return view.to_document(box.handles(view)[index])


def rotator(hand: Hand) -> np.ndarray:
    view = hand.pane(SOURCE).view
    box = TransformBox.around(hand.document.layers[0].keyframes[0].outline)
    return view.to_document(box.rotator(view))


def test_dragging_the_shape_moves_its_key_only_as_one_step(hand: Hand):
    before = hand.document
    hand.drag(SOURCE, INSIDE, (480, 310), (500, 330))
    moved = hand.place(SOURCE, (500, 330)) - hand.place(SOURCE, INSIDE)
    np.testing.assert_allclose(hand.points(), np.array(SQUARE) + moved)
    assert hand.document.layers[0].keyframes[1] is before.layers[0].keyframes[1]
    assert hand.steps == ["Move outline"]
    hand.workspace.session.undo()
    assert hand.document is before


def test_escape_takes_any_transform_back(hand: Hand):
    before = hand.document
    for start in (np.array(INSIDE), handle(hand, BOTTOM_RIGHT), rotator(hand)):
        hand.pull(SOURCE, start, np.add(start, (60, 35)))
        assert hand.document is not before
        hand.key(SOURCE, Qt.Key.Key_Escape)
        hand.release(SOURCE, np.add(start, (60, 35)))
        assert hand.document is before
    assert hand.steps == []


def test_a_corner_handle_scales_about_the_opposite_corner(hand: Hand):
    start = handle(hand, BOTTOM_RIGHT)
    hand.drag(SOURCE, start, np.add(start, (150, 125)))
    moved = hand.place(SOURCE, np.add(start, (150, 125))) - hand.place(SOURCE, start)
    np.testing.assert_allclose(hand.points()[0], SQUARE[0])
    np.testing.assert_allclose(hand.points()[2], np.array(SQUARE[2]) + moved)


def test_a_side_handle_scales_one_way_only(hand: Hand):
    start = handle(hand, RIGHT)
    hand.drag(SOURCE, start, np.add(start, (100, 70)))
    assert np.ptp(hand.points()[:, 1]) == pytest.approx(250)
    assert np.ptp(hand.points()[:, 0]) == pytest.approx(400, abs=2)


def test_shift_keeps_proportions_and_alt_the_middle(hand: Hand):
    start = handle(hand, BOTTOM_RIGHT)
    hand.drag(SOURCE, start, np.add(start, (75, 10)), keys=SHIFT | ALT)
    size = np.ptp(hand.points(), axis=0)
    assert size[0] / size[1] == pytest.approx(300 / 250)
    np.testing.assert_allclose(hand.points().mean(axis=0), np.mean(SQUARE, axis=0))
    assert size[0] == pytest.approx(450, abs=4)


def test_scaling_through_zero_mirrors_but_never_flattens(hand: Hand):
    start = handle(hand, RIGHT)
    hand.pull(SOURCE, start, (SQUARE[0][0], start[1]))
    assert np.ptp(hand.points()[:, 0]) > 0
    hand.move(SOURCE, (150, start[1]), held=Qt.MouseButton.LeftButton)
    hand.release(SOURCE, (150, start[1]))
    assert hand.points()[1][0] < hand.points()[0][0]


def test_the_round_handle_rotates_about_the_middle_and_shift_in_steps(hand: Hand):
    centre = np.mean(SQUARE, axis=0)
    start = rotator(hand)
    hand.drag(SOURCE, start, np.add(centre, (180, -20)), keys=SHIFT)
    turned = np.array(SQUARE) - centre
    c, s = np.cos(np.pi / 2), np.sin(np.pi / 2)
    np.testing.assert_allclose(hand.points() - centre, turned @ [[c, s], [-s, c]], atol=1e-9)
    assert hand.steps == ["Rotate outline"]


def test_arrow_keys_move_the_outline_that_was_clicked(hand: Hand):
    hand.click(TARGET, INSIDE)
    hand.key(TARGET, Qt.Key.Key_Left)
    hand.key(TARGET, Qt.Key.Key_Up, SHIFT)
    np.testing.assert_allclose(hand.points(1), np.add(LEANING, (-1, -10)))
    assert np.array_equal(hand.points(0), SQUARE)


def test_arrow_keys_move_nothing_that_was_not_clicked(hand: Hand):
    hand.key(TARGET, Qt.Key.Key_Left)
    hand.click(SOURCE, INSIDE)
    hand.key(TARGET, Qt.Key.Key_Left)
    assert hand.steps == []


@pytest.mark.parametrize("let_go", ["Esc", "a click beside it", "another frame", "another tool"])
def test_arrow_keys_move_an_outline_no_more_after(let_go: str, hand: Hand):
    hand.click(SOURCE, INSIDE)
    assert "arrow keys" in hand.canvas.hint
    match let_go:
        case "Esc":
            hand.key(SOURCE, Qt.Key.Key_Escape)
        case "a click beside it":
            hand.click(SOURCE, (50, 50))
        case "another frame":
            hand.workspace.playhead.step(1)
        case "another tool":
            hand.canvas.set_tool("marks")
            hand.canvas.set_tool("select")
    hand.key(SOURCE, Qt.Key.Key_Left)
    assert hand.steps == []
    assert hand.canvas.tool == "select"
    assert "arrow keys" not in hand.canvas.hint


def test_a_click_selects_the_topmost_layer_under_the_mouse(open_canvas):
    small = Outline.polygon([(350, 200), (400, 200), (400, 250), (350, 250)])
    hand = open_canvas(add_layer(a_document(), "Small", 1, small))
    assert hand.workspace.selection.layer.name == "Small"
    hand.click(BETWEEN, (550, 350))
    assert hand.workspace.selection.layer.name == "Card"
    hand.click(BETWEEN, (375, 225))
    assert hand.workspace.selection.layer.name == "Small"
    assert hand.steps == []


def test_in_between_shapes_are_not_dragged(hand: Hand):
    before = hand.document
    hand.drag(BETWEEN, INSIDE, (500, 330))
    assert hand.document is before


def test_the_mirrored_view_does_not_mirror_edits(hand: Hand):
    hand.canvas.camera.flip()
    hand.drag(SOURCE, INSIDE, (500, 300))
    assert hand.points()[0] == pytest.approx((350, 150), abs=2)


def test_a_locked_layer_shows_no_handles_and_refuses(open_canvas):
    document = a_document()
    layer = replace(document.layers[0], locked=True)
    hand = open_canvas(replace(document, layers=(layer,)))
    start = handle(hand, BOTTOM_RIGHT)
    hand.drag(SOURCE, start, np.add(start, (50, 50)))
    assert "“Card” is locked" in hand.canvas.hint
    hand.drag(SOURCE, INSIDE, (500, 330))
    hand.key(SOURCE, Qt.Key.Key_Left)
    assert hand.document.layers[0] is layer
