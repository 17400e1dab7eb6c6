from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.canvas.moment import Role
from core.model import Document, Outline
from core.model.edits import add_layer
from tests.app.canvas.conftest import Hand
from tests.card import SQUARE, a_document

SOURCE, BETWEEN, TARGET, OVERLAY = Role.SOURCE, Role.IN_BETWEEN, Role.TARGET, Role.OVERLAY
CORNERS = ((200.0, 120.0), (640.0, 100.0), (700.0, 420.0), (400.0, 300.0), (180.0, 440.0))
Key = Qt.Key
QT_CONTROL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def empty(open_canvas: Callable[..., Hand]) -> Hand:
    hand = open_canvas(Document())
    hand.canvas.set_tool("pen")
    return hand


def draw(hand: Hand, role: Role, corners=CORNERS) -> np.ndarray:
    """Click the corners and close; return where the clicks were."""
    hand.canvas.set_tool("pen")
    clicked = np.array([hand.place(role, corner) for corner in corners])
    for corner in corners:
        hand.click(role, corner)
    hand.click(role, corners[0])
    return clicked


def test_a_drawn_polygon_has_exactly_the_clicked_points(empty: Hand):
    clicked = draw(empty, SOURCE)
    ring = empty.document.layers[0].keyframes[0].outline.rings[0]
    assert np.array_equal(ring.points, clicked)
    assert not ring.curved.any()
    assert empty.steps == ["Draw layer"]


def test_undo_after_drawing_restores_the_identical_document(empty: Hand):
    before = empty.document
    draw(empty, SOURCE)
    assert empty.document is not before
    empty.workspace.session.undo()
    assert empty.document is before


def test_what_is_drawn_is_kept_when_the_layout_changes_and_the_keys_follow(empty: Hand):
    for corner in CORNERS[:3]:
        empty.click(SOURCE, corner)
    empty.pane(SOURCE).view.setFocus()
    empty.workspace.view.update(layout="overlay")
    assert empty.steps == ["Draw layer"]
    assert len(empty.points()) == 3
    assert empty.pane(OVERLAY).view.hasFocus()
    for corner in CORNERS:
        empty.click(OVERLAY, corner)
    empty.key(OVERLAY, Key.Key_Return)
    assert len(empty.points()) == 5
    empty.workspace.view.update(layout="side by side")
    assert empty.pane(BETWEEN).view.hasFocus()


def test_an_option_of_the_view_does_not_end_a_drawing(empty: Hand):
    for corner in CORNERS[:3]:
        empty.click(SOURCE, corner)
    empty.workspace.view.update(mesh=True)
    empty.click(SOURCE, CORNERS[3])
    empty.key(SOURCE, Key.Key_Return)
    assert len(empty.points()) == 4


def test_enter_closes_the_outline(empty: Hand):
    for corner in CORNERS[:3]:
        empty.click(SOURCE, corner)
    empty.key(SOURCE, Key.Key_Return)
    assert len(empty.points()) == 3


def test_enter_with_two_nodes_says_what_is_missing(empty: Hand):
    for corner in CORNERS[:2]:
        empty.click(SOURCE, corner)
    hints: list[str] = []
    empty.canvas.hint_changed.connect(hints.append)
    empty.key(SOURCE, Key.Key_Return)
    assert not empty.document.layers
    assert "at least 3" in hints[-1]


def test_a_double_click_sets_the_last_node_and_closes(empty: Hand):
    for corner in CORNERS[:3]:
        empty.click(SOURCE, corner)
    empty.double_click(SOURCE, CORNERS[3])
    assert len(empty.points()) == 4


def test_escape_abandons_the_outline_and_changes_nothing(empty: Hand):
    before = empty.document
    for corner in CORNERS[:4]:
        empty.click(SOURCE, corner)
    empty.key(SOURCE, Key.Key_Escape)
    assert empty.document is before
    assert empty.canvas.tool == "pen"
    assert len(draw(empty, SOURCE)) == len(empty.points())


@pytest.mark.parametrize(
    ("key", "modifiers"),
    [
        (Key.Key_Backspace, Qt.KeyboardModifier.NoModifier),
        (Key.Key_Z, Qt.KeyboardModifier.ControlModifier),
    ],
)
def test_backspace_and_undo_take_back_the_last_node_only(empty: Hand, key: Qt.Key, modifiers):
    for corner in CORNERS:
        empty.click(SOURCE, corner)
    empty.key(SOURCE, key, modifiers)
    empty.key(SOURCE, Key.Key_Return)
    clicked = [empty.place(SOURCE, corner) for corner in CORNERS[:-1]]
    assert np.array_equal(empty.points(), clicked)


def test_a_drag_makes_a_smooth_node_with_symmetric_handles(empty: Hand):
    empty.click(SOURCE, CORNERS[0])
    empty.drag(SOURCE, CORNERS[1], (700, 160))
    empty.click(SOURCE, CORNERS[2])
    empty.key(SOURCE, Key.Key_Return)
    ring = empty.document.layers[0].keyframes[0].outline.rings[0]
    pulled = empty.place(SOURCE, (700, 160)) - empty.place(SOURCE, CORNERS[1])
    np.testing.assert_allclose(ring.handles_out[1], pulled)
    np.testing.assert_allclose(ring.handles_in[1], -pulled)
    assert not ring.handles_out[[0, 2]].any()


def test_shift_keeps_to_multiples_of_45_degrees(empty: Hand):
    shift = Qt.KeyboardModifier.ShiftModifier
    empty.click(SOURCE, CORNERS[0])
    empty.click(SOURCE, (500, 133), shift)
    empty.click(SOURCE, (500, 400))
    empty.key(SOURCE, Key.Key_Return)
    first, second = empty.points()[:2]
    assert second[1] == pytest.approx(first[1])
    assert second[0] > first[0] + 200


def test_taking_another_tool_keeps_what_was_drawn(empty: Hand):
    for corner in CORNERS[:4]:
        empty.click(SOURCE, corner)
    empty.canvas.set_tool("select")
    assert len(empty.points()) == 4


def test_a_click_in_another_pane_does_not_tear_the_outline(empty: Hand):
    empty.click(SOURCE, CORNERS[0])
    empty.click(TARGET, CORNERS[1])
    for corner in CORNERS[2:4]:
        empty.click(SOURCE, corner)
    empty.key(SOURCE, Key.Key_Return)
    assert len(empty.points()) == 3


def test_the_target_of_a_single_key_becomes_a_key_24_frames_later(open_canvas):
    hand = open_canvas(a_document(target=False))
    clicked = draw(hand, TARGET)
    layer = hand.document.layers[0]
    assert [key.frame for key in layer.keyframes] == [1, 25]
    assert np.array_equal(hand.points(1), clicked)
    assert len(layer.keyframes[1].marks) == len(layer.labels) == 2
    assert hand.workspace.selection.key == 1
    hand.workspace.session.undo()
    assert len(hand.document.layers[0].keyframes) == 1


def test_drawing_on_a_key_replaces_its_outline_as_one_step_and_carries_the_marks(open_canvas):
    hand = open_canvas(a_document())
    before = hand.document
    grown = [((x - 450) * 1.2 + 450, (y - 275) * 1.2 + 275) for x, y in SQUARE]
    draw(hand, SOURCE, [*grown[1:], grown[0]])
    key = hand.document.layers[0].keyframes[0]
    for mark, corner in zip(key.marks, (SQUARE[0], SQUARE[2]), strict=True):
        away = np.hypot(*(key.outline.position(mark) - corner))
        assert away < 80
    assert hand.document.layers[0].keyframes[1] is before.layers[0].keyframes[1]
    assert hand.steps == ["Draw outline"]
    hand.workspace.session.undo()
    assert hand.document is before


def test_drawing_in_between_makes_a_new_layer_and_selects_it(open_canvas):
    hand = open_canvas(a_document())
    draw(hand, BETWEEN)
    assert [layer.name for layer in hand.document.layers] == ["Card", "Shape 1"]
    assert hand.workspace.selection.layer is hand.document.layers[1]


def test_drawing_in_the_overlay_makes_a_key_where_the_playhead_is(open_canvas):
    hand = open_canvas(a_document())
    hand.workspace.view.update(layout="overlay")
    hand.workspace.playhead.move_to(13)
    hand.canvas.set_tool("pen")
    draw(hand, OVERLAY)
    assert [key.frame for key in hand.document.layers[0].keyframes] == [1, 13, 25]


def test_a_locked_layer_refuses_with_a_reason(open_canvas):
    document = a_document()
    layer = replace(document.layers[0], locked=True)
    hand = open_canvas(replace(document, layers=(layer,)))
    hand.canvas.set_tool("pen")
    hand.move(BETWEEN, CORNERS[0])
    assert "a new layer" in hand.canvas.hint
    hand.click(SOURCE, CORNERS[0])
    assert "“Card” is locked" in hand.canvas.hint
    assert hand.document.layers[0] is layer


def test_names_of_new_layers_are_free(open_canvas):
    document = add_layer(Document(), "Shape 1", 1, Outline.polygon(SQUARE))
    hand = open_canvas(document)
    draw(hand, BETWEEN)
    assert hand.document.layers[1].name == "Shape 2"


def test_the_window_keeps_its_keys_while_nothing_is_drawn(empty: Hand):
    view = empty.pane(SOURCE).view
    view.setFocus()
    heard: list[object] = []
    empty.canvas.keyPressEvent = lambda event: heard.append(event.key())
    QTest.keyClick(view, Key.Key_Return)
    assert heard == [Key.Key_Return]


@pytest.mark.parametrize("key", [Qt.KeyboardModifier.AltModifier, QT_CONTROL])
def test_with_alt_a_hole_is_cut_and_marks_stay(open_canvas, key: Qt.KeyboardModifier):
    hand = open_canvas(a_document())
    before = hand.document.layers[0].keyframes[0]
    hand.canvas.set_tool("pen")
    hand.click(SOURCE, (400, 200), key)
    for corner in ((500, 200), (450, 300)):
        hand.click(SOURCE, corner)
    hand.key(SOURCE, Key.Key_Return)
    after = hand.document.layers[0].keyframes[0]
    assert [len(ring) for ring in after.outline.rings] == [4, 3]
    assert after.outline.rings[0] is before.outline.rings[0]
    assert after.marks == before.marks
    assert hand.steps == ["Cut hole"]


def test_a_hole_outside_the_shape_is_refused_with_advice(open_canvas):
    hand = open_canvas(a_document())
    errors = []
    hand.workspace.session.failed.connect(errors.append)
    hand.canvas.set_tool("pen")
    hand.click(SOURCE, (200, 200), QT_CONTROL)
    for corner in ((500, 200), (450, 300)):
        hand.click(SOURCE, corner)
    hand.key(SOURCE, Key.Key_Return)
    assert hand.steps == []
    assert "within the outline" in errors[0].hint
