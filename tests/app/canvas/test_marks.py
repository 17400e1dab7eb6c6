from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from app.canvas.marks_overlay import LEASH, RADIUS, STALK, letter_centres
from app.canvas.moment import Role
from app.canvas.pins import pins_on_key
from core.model import Document, Keyframe, Layer, Outline, RingPoint
from core.model.edits import add_mark, remove_marks
from core.morph import suggest
from core.morph.marks.rings import match_rings
from tests.app.canvas.conftest import Hand
from tests.card import LEANING, SQUARE, a_document

SOURCE, BETWEEN, TARGET = Role.SOURCE, Role.IN_BETWEEN, Role.TARGET
Key = Qt.Key
SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def hand(open_canvas: Callable[..., Hand]) -> Hand:
    return open_canvas(a_document(), tool="marks")


def place_of(hand: Hand, key: int, mark: int) -> np.ndarray:
    keyframe = hand.document.layers[0].keyframes[key]
    return keyframe.outline.position(keyframe.marks[mark])


def letter(hand: Hand, role: Role, mark: int) -> np.ndarray:
    """Where in the document the letter of a mark stands."""
    view = hand.pane(role).view
    pins = pins_on_key(hand.pane(role).keyframe)
    return view.to_document(letter_centres(view, pins)[mark])


def test_one_click_places_a_mark_at_the_corner_with_its_mate(hand: Hand):
    near = (SQUARE[1][0] + 6, SQUARE[1][1] - 5)
    hand.click(SOURCE, near)
    layer = hand.document.layers[0]
    assert layer.labels == ("a", "b", "c")
    assert tuple(place_of(hand, 0, 2)) == SQUARE[1]
    assert tuple(place_of(hand, 1, 2)) == LEANING[1]
    assert hand.workspace.selection.mark == 2
    assert hand.steps == ["Place mark c"]


def test_undo_after_placing_restores_the_identical_document(hand: Hand):
    before = hand.document
    hand.click(TARGET, LEANING[3])
    hand.workspace.session.undo()
    assert hand.document is before


def test_shift_places_a_mark_beside_a_corner(hand: Hand):
    hand.click(SOURCE, (SQUARE[1][0] - 15, SQUARE[1][1]), SHIFT)
    assert place_of(hand, 0, 2) == pytest.approx((585, 150), abs=1.5)


def test_a_click_far_from_the_outline_places_nothing(hand: Hand):
    before = hand.document
    hand.click(SOURCE, (450, 275))
    hand.click(BETWEEN, SQUARE[1])
    assert hand.document is before


def test_a_mark_gets_a_mate_on_every_keyframe(open_canvas):
    shapes = (SQUARE, LEANING, SQUARE)
    keys = tuple(Keyframe(f, Outline.polygon(s)) for f, s in zip((1, 9, 25), shapes, strict=True))
    hand = open_canvas(Document((Layer(1, "Card", keys),)), tool="marks")
    hand.workspace.playhead.move_to(12)
    hand.click(TARGET, SQUARE[2])
    places = [tuple(place_of(hand, key, 0)) for key in range(3)]
    assert places == [SQUARE[2], LEANING[2], SQUARE[2]]


def test_a_mark_on_a_single_keyframe_is_allowed(open_canvas):
    hand = open_canvas(a_document(target=False), tool="marks")
    hand.click(SOURCE, SQUARE[1])
    assert tuple(place_of(hand, 0, 2)) == SQUARE[1]


@pytest.mark.parametrize("by_letter", [False, True])
def test_a_mark_is_dragged_by_its_dot_or_its_letter_as_one_step(hand: Hand, by_letter: bool):
    before = hand.document
    start = letter(hand, TARGET, 0) if by_letter else np.array(LEANING[0])
    end = start + np.array([100, 0])
    hand.drag(TARGET, start, end)
    pixel = hand.pane(TARGET).view.pixel
    assert place_of(hand, 1, 0) == pytest.approx(np.add(LEANING[0], (100, 0)), abs=1.5 * pixel)
    assert hand.document.layers[0].keyframes[0] is before.layers[0].keyframes[0]
    assert hand.steps == ["Move mark a"]
    hand.workspace.session.undo()
    assert hand.document is before


def test_a_dragged_mark_snaps_to_a_corner_unless_shift_is_held(hand: Hand):
    beside = np.array(SQUARE[1]) - [8, 0]
    hand.drag(SOURCE, SQUARE[0], (450, 150), beside)
    assert tuple(place_of(hand, 0, 0)) == SQUARE[1]
    hand.drag(SOURCE, SQUARE[1], (450, 150), beside, keys=SHIFT)
    assert place_of(hand, 0, 0) == pytest.approx(beside, abs=1.5)


def test_escape_takes_a_dragged_mark_back(hand: Hand):
    before = hand.document
    hand.pull(SOURCE, SQUARE[0], (450, 150))
    assert hand.document is not before
    hand.key(SOURCE, Key.Key_Escape)
    hand.release(SOURCE, (450, 150))
    assert hand.document is before


def test_delete_removes_the_selected_mark_everywhere(hand: Hand):
    hand.click(SOURCE, SQUARE[0])
    hand.key(SOURCE, Key.Key_Delete)
    layer = hand.document.layers[0]
    assert layer.labels == ("b",)
    assert all(len(key.marks) == 1 for key in layer.keyframes)


def test_tab_goes_through_the_marks_and_arrows_move_them_along_the_outline(hand: Hand):
    hand.key(SOURCE, Key.Key_Tab)
    hand.key(SOURCE, Key.Key_Tab)
    assert hand.workspace.selection.mark == 1
    hand.key(SOURCE, Key.Key_Left)
    hand.key(SOURCE, Key.Key_Left, SHIFT)
    assert place_of(hand, 0, 1) == pytest.approx((589, 400))
    hand.key(SOURCE, Key.Key_Right)
    assert place_of(hand, 0, 1) == pytest.approx((590, 400))


def test_the_hint_says_how_to_correct_a_mate(hand: Hand):
    hints: list[str] = []
    hand.canvas.hint_changed.connect(hints.append)
    hand.click(SOURCE, SQUARE[1])
    assert "Mark c is placed" in hints[-1]
    assert "if its mate is not right" in hints[-1]


def test_hovering_changes_nothing_but_the_hint(hand: Hand):
    hand.workspace.view.update(suggestions="never")
    before, hints = hand.document, []
    hand.canvas.hint_changed.connect(hints.append)
    hand.move(SOURCE, (450, 150))
    assert "place mark c" in hints[-1]
    hand.move(SOURCE, SQUARE[0])
    assert "Drag mark a" in hints[-1]
    assert hand.document is before


@pytest.fixture
def gate(monkeypatch: pytest.MonkeyPatch) -> Iterator[threading.Event]:
    """Outlines are matched when this is set, and never in the thread of the window."""
    gate, threads = threading.Event(), []

    def match(*args):
        threads.append(threading.get_ident())
        gate.wait(10)
        return match_rings(*args)

    monkeypatch.setattr(suggest, "match_rings", match)
    suggest._match.cache_clear()
    yield gate
    gate.set()
    assert threads
    assert threading.get_ident() not in threads


def test_hovering_shows_the_mate_once_it_is_found(gate, open_canvas, qtbot: QtBot):
    hand = open_canvas(a_document())
    hand.workspace.view.update(suggestions="never")
    hand.canvas.set_tool("marks")
    hints: list[str] = []
    hand.canvas.hint_changed.connect(hints.append)
    hand.move(SOURCE, (450, 150))
    assert "place mark c" in hints[-1]
    assert "as shown" not in hints[-1]
    gate.set()
    qtbot.waitUntil(lambda: "its mate is proposed as shown" in hints[-1])


def test_a_mark_clicked_before_its_mate_is_found_is_placed_with_it(gate, open_canvas, qtbot: QtBot):
    hand = open_canvas(a_document())
    before = hand.document
    hand.canvas.set_tool("marks")
    hand.click(SOURCE, SQUARE[1])
    hand.click(SOURCE, SQUARE[3])
    assert "Looking for the mate" in hand.canvas.hint
    assert hand.document is before
    gate.set()
    qtbot.waitUntil(lambda: len(hand.document.layers[0].labels) == 4)
    assert [tuple(place_of(hand, 1, mark)) for mark in (2, 3)] == [LEANING[1], LEANING[3]]
    assert hand.steps == ["Place mark c", "Place mark d"]


def test_a_mark_that_waits_for_its_mate_is_dropped_by_another_edit(gate, open_canvas, qtbot: QtBot):
    hand = open_canvas(a_document())
    hand.canvas.set_tool("marks")
    hand.click(SOURCE, SQUARE[1])
    hand.workspace.session.apply("Delete mark a", remove_marks, 1, [0])
    gate.set()
    qtbot.waitUntil(lambda: hand.workspace.suggestions.current)
    assert hand.document.layers[0].labels == ("b",)
    assert hand.workspace.suggestions.waiting == ()


def test_letters_stand_off_the_shape_and_off_its_holes(open_canvas):
    hole = [(400, 220), (500, 220), (500, 330), (400, 330)]
    for exterior, inner in ((SQUARE, hole), (SQUARE[::-1], hole[::-1])):
        outline = Outline.polygon(exterior, inner)
        marks = tuple(RingPoint(ring, at) for ring in (0, 1) for at in (0.5, 1.0, 2.5))
        pins = pins_on_key(Keyframe(1, outline, marks))
        from shapely.geometry import Point, Polygon

        shape = Polygon(exterior, [inner])
        for place, outward in zip(pins.places, pins.outward, strict=True):
            assert not shape.contains(Point(place + 5 * outward))
            assert np.hypot(*outward) == pytest.approx(1)


def test_letters_of_marks_close_together_stand_side_by_side(open_canvas):
    document = a_document(marks=False)
    for at in (1.94, 1.0, 1.03, 1.06, 1.5, 1.97, 2.0):
        document = add_mark(document, 1, [RingPoint(0, at), RingPoint(0, at)])
    hand = open_canvas(document, tool="marks")
    for role in (SOURCE, TARGET):
        view, pins = hand.pane(role).view, pins_on_key(hand.pane(role).keyframe)
        centres = letter_centres(view, pins)
        apart = np.hypot(*(centres[:, None] - centres).T) + 100 * np.eye(len(centres))
        assert apart.min() > 1.7 * RADIUS
        stalks = np.hypot(*(centres - view.to_screen(pins.places)).T)
        assert stalks.max() <= LEASH * STALK + 1e-6
    hand.click(SOURCE, letter(hand, SOURCE, 2))
    assert hand.workspace.selection.mark == 2


def test_a_locked_layer_refuses_marks(open_canvas):
    document = a_document()
    layer = replace(document.layers[0], locked=True)
    hand = open_canvas(replace(document, layers=(layer,)))
    hand.canvas.set_tool("marks")
    hand.click(SOURCE, SQUARE[1])
    hand.drag(SOURCE, SQUARE[0], (450, 150))
    assert hand.document.layers[0] is layer


def test_insert_places_a_mark_at_the_next_free_corner(hand: Hand, qtbot: QtBot):
    hand.key(SOURCE, Key.Key_Tab)
    hand.key(SOURCE, Key.Key_Insert)
    hand.key(SOURCE, Key.Key_Insert)
    qtbot.waitUntil(lambda: len(hand.document.layers[0].labels) == 4)
    assert hand.document.layers[0].labels == ("a", "b", "c", "d")
    assert [tuple(place_of(hand, 0, mark)) for mark in (2, 3)] == [SQUARE[1], SQUARE[3]]


def test_marks_stand_back_for_every_tool_but_their_own(hand: Hand):
    view = hand.pane(SOURCE).view

    def saturation() -> int:
        """Of the ground of a mark's letter."""
        x, y = letter_centres(view, pins_on_key(hand.pane(SOURCE).keyframe))[0]
        return view.viewport().grab().toImage().pixelColor(round(x) - 7, round(y)).saturation()

    full = saturation()
    for tool in ("select", "nodes", "pen", "freehand"):
        hand.canvas.set_tool(tool)
        assert 0.2 * full < saturation() < 0.8 * full
    hand.canvas.set_tool("marks")
    assert saturation() == full
