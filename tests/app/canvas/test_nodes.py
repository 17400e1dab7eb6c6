from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication

from app.canvas.moment import Role
from core.model import Outline, Ring
from core.model.edits import replace_outline
from tests.app.canvas.conftest import Hand
from tests.card import LEANING, SQUARE, a_document

SOURCE, TARGET = Role.SOURCE, Role.TARGET
Key = Qt.Key
SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def hand(open_canvas: Callable[..., Hand]) -> Hand:
    hand = open_canvas(a_document())
    hand.canvas.set_tool("nodes")
    return hand


def selected(hand: Hand) -> set[int]:
    return {node for _, node in hand.workspace.selection.nodes}


def middle(a: int, b: int) -> tuple[float, float]:
    return (SQUARE[a][0] + SQUARE[b][0]) / 2, (SQUARE[a][1] + SQUARE[b][1]) / 2


def test_a_dragged_node_goes_with_the_mouse_as_one_undo_step(hand: Hand):
    before = hand.document
    hand.drag(SOURCE, SQUARE[1], (650, 200), (700, 100))
    moved = hand.place(SOURCE, (700, 100)) - hand.place(SOURCE, SQUARE[1])
    np.testing.assert_allclose(hand.points()[1], np.array(SQUARE[1]) + moved)
    assert np.array_equal(hand.points()[[0, 2, 3]], np.array(SQUARE)[[0, 2, 3]])
    assert hand.steps == ["Move nodes"]
    hand.workspace.session.undo()
    assert hand.document is before


def test_dragging_solves_live(hand: Hand, qtbot):
    solved = []
    hand.workspace.solver.updated.connect(lambda: solved.append(hand.workspace.session.dragging))
    hand.pull(SOURCE, SQUARE[1], (650, 120))
    qtbot.waitUntil(lambda: True in solved)
    hand.release(SOURCE, (650, 120))


def test_escape_takes_a_drag_back(hand: Hand):
    before = hand.document
    hand.pull(SOURCE, SQUARE[1], (700, 100))
    assert hand.document is not before
    hand.key(SOURCE, Key.Key_Escape)
    hand.release(SOURCE, (700, 100))
    assert hand.document is before
    assert hand.steps == []
    assert hand.canvas.tool == "nodes"


def test_undo_in_the_middle_of_a_drag_ends_it(hand: Hand):
    before = hand.document
    hand.pull(SOURCE, SQUARE[1], (700, 100))
    hand.workspace.session.undo()
    hand.move(SOURCE, (650, 120), held=Qt.MouseButton.LeftButton)
    hand.release(SOURCE, (650, 120))
    assert hand.document is before


def test_a_click_that_shakes_moves_nothing(hand: Hand):
    before = hand.document
    pixel = hand.pane(SOURCE).view.pixel
    hand.pull(SOURCE, SQUARE[1], (SQUARE[1][0] + 2 * pixel, SQUARE[1][1]))
    hand.release(SOURCE, SQUARE[1])
    assert hand.document is before
    assert selected(hand) == {1}


def test_shift_adds_nodes_and_they_move_together(hand: Hand):
    hand.click(SOURCE, SQUARE[0])
    hand.click(SOURCE, SQUARE[1], SHIFT)
    assert selected(hand) == {0, 1}
    hand.drag(SOURCE, SQUARE[0], (300, 100))
    assert hand.points()[:, 1] == pytest.approx([100, 100, 400, 400], abs=1.5)


def test_a_marquee_selects_what_is_inside(hand: Hand):
    hand.drag(SOURCE, (250, 100), (650, 250))
    assert selected(hand) == {0, 1}
    hand.drag(SOURCE, (250, 450), (350, 350), keys=SHIFT)
    assert selected(hand) == {0, 1, 3}
    hand.click(SOURCE, (100, 60))
    assert selected(hand) == set()
    assert hand.steps == []


def test_nodes_of_the_other_key_are_edited_in_its_pane(hand: Hand):
    before = hand.document.layers[0].keyframes[0]
    hand.drag(TARGET, LEANING[1], (720, 120))
    assert hand.workspace.selection.key == 1
    assert hand.document.layers[0].keyframes[0] is before
    assert hand.points(1)[1] == pytest.approx((720, 120), abs=1.5)


def test_a_double_click_on_the_edge_adds_a_node_there_and_marks_stay_in_place(hand: Hand):
    key = hand.document.layers[0].keyframes[0]
    places = [key.outline.position(mark) for mark in key.marks]
    hand.double_click(SOURCE, middle(0, 1))
    after = hand.document.layers[0].keyframes[0]
    assert len(hand.points()) == 5
    assert hand.points()[1] == pytest.approx(middle(0, 1), abs=1.5)
    for mark, place in zip(after.marks, places, strict=True):
        np.testing.assert_allclose(after.outline.position(mark), place, atol=1e-9)
    assert selected(hand) == {1}
    assert hand.steps == ["Add node"]


def test_delete_removes_the_selected_nodes(hand: Hand):
    hand.click(SOURCE, SQUARE[1])
    hand.key(SOURCE, Key.Key_Delete)
    assert np.array_equal(hand.points(), np.array(SQUARE)[[0, 2, 3]])
    assert selected(hand) == set()


def test_a_ring_keeps_three_nodes_and_says_so(hand: Hand):
    errors = []
    hand.workspace.session.failed.connect(errors.append)
    hand.drag(SOURCE, (250, 100), (650, 250))
    hand.key(SOURCE, Key.Key_Delete)
    assert len(hand.points()) == 4
    assert "at least 3" in str(errors[0])


def test_arrow_keys_move_by_one_and_with_shift_by_ten(hand: Hand):
    hand.click(SOURCE, SQUARE[2])
    hand.key(SOURCE, Key.Key_Right)
    hand.key(SOURCE, Key.Key_Down, SHIFT)
    np.testing.assert_allclose(hand.points()[2], np.add(SQUARE[2], (1, 10)))
    assert hand.steps == ["Move nodes", "Move nodes"]


def test_a_held_arrow_key_is_one_undo_step(hand: Hand):
    hand.click(SOURCE, SQUARE[2])
    view, none = hand.pane(SOURCE).view, Qt.KeyboardModifier.NoModifier
    for repeats in (False, True, True):
        press = QKeyEvent(QEvent.Type.KeyPress, Key.Key_Right, none, "", repeats)
        QApplication.sendEvent(view, press)
    QApplication.sendEvent(view, QKeyEvent(QEvent.Type.KeyRelease, Key.Key_Right, none))
    np.testing.assert_allclose(hand.points()[2], np.add(SQUARE[2], (3, 0)))
    assert hand.steps == ["Move nodes"]


def test_arrow_keys_are_the_windows_while_no_node_is_selected(hand: Hand):
    hand.key(SOURCE, Key.Key_Right)
    assert hand.steps == []


def test_tab_goes_through_the_nodes_and_round_again(hand: Hand):
    hand.pane(SOURCE).view.setFocus()
    seen = []
    for _ in range(5):
        hand.key(SOURCE, Key.Key_Tab)
        seen += selected(hand)
    assert seen == [0, 1, 2, 3, 0]
    hand.key(SOURCE, Key.Key_Backtab, SHIFT)
    assert selected(hand) == {3}


def test_a_double_click_turns_a_corner_smooth_and_back(hand: Hand):
    hand.double_click(SOURCE, SQUARE[1])
    ring = hand.document.layers[0].keyframes[0].outline.rings[0]
    before, after = ring.handles_in[1], ring.handles_out[1]
    assert before @ after == pytest.approx(-np.hypot(*before) * np.hypot(*after))
    hand.double_click(SOURCE, SQUARE[1])
    assert not hand.document.layers[0].keyframes[0].outline.rings[0].curved.any()


@pytest.fixture
def smooth(open_canvas: Callable[..., Hand]) -> Hand:
    """The square with one smooth node, whose handles are as long as 60."""
    before, after = np.zeros((4, 2)), np.zeros((4, 2))
    before[1], after[1] = (-60, 0), (60, 0)
    document = a_document()
    marks = document.layers[0].keyframes[0].marks
    outline = Outline((Ring(SQUARE, before, after),))
    hand = open_canvas(replace_outline(document, 1, 0, outline, marks))
    hand.canvas.set_tool("nodes")
    hand.click(SOURCE, SQUARE[1])
    return hand


def test_dragging_a_handle_of_a_smooth_node_keeps_it_smooth(smooth: Hand):
    smooth.drag(SOURCE, (660, 150), (600, 230))
    ring = smooth.document.layers[0].keyframes[0].outline.rings[0]
    assert ring.handles_out[1] == pytest.approx((0, 80), abs=1.5)
    assert ring.handles_in[1] == pytest.approx((0, -60), abs=1.5)
    assert smooth.steps == ["Move handle"]


def test_alt_moves_a_handle_on_its_own(smooth: Hand):
    smooth.drag(SOURCE, (660, 150), (600, 230), keys=Qt.KeyboardModifier.AltModifier)
    ring = smooth.document.layers[0].keyframes[0].outline.rings[0]
    assert tuple(ring.handles_in[1]) == (-60, 0)


@pytest.mark.parametrize(
    ("change", "word"), [({"locked": True}, "locked"), ({"visible": False}, "hidden")]
)
def test_a_locked_or_hidden_layer_refuses_with_a_reason(open_canvas, change, word: str):
    document = a_document()
    layer = replace(document.layers[0], **change)
    hand = open_canvas(replace(document, layers=(layer,)))
    hand.canvas.set_tool("nodes")
    assert f"“Card” is {word}" in hand.canvas.hint
    hand.drag(SOURCE, SQUARE[1], (700, 100))
    assert hand.document.layers[0] is layer
    assert f"“Card” is {word}" in hand.canvas.hint


def test_insert_adds_a_node_in_the_middle_of_the_side(hand: Hand):
    hand.key(SOURCE, Key.Key_Tab)
    hand.key(SOURCE, Key.Key_Insert)
    assert tuple(hand.points()[1]) == middle(0, 1)
    assert selected(hand) == {1}
