"""Suggested marks: faint until they are accepted, one or all, and never in the document before."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.canvas.moment import Role
from core.io import project
from core.model import Document, Keyframe, Layer, Outline, RingPoint
from core.model.edits import move_mark, move_nodes
from core.morph.layer_match import Suggestion
from core.morph.scene import solve_span, span_of
from tests.app.canvas.conftest import Hand

SOURCE, BETWEEN, TARGET, OVERLAY = Role.SOURCE, Role.IN_BETWEEN, Role.TARGET, Role.OVERLAY
Key = Qt.Key
L = np.array([(300, 80), (420, 80), (420, 320), (600, 320), (600, 420), (300, 420)], dtype=float)
TALL = np.array([(300, 60), (380, 60), (380, 380), (640, 380), (640, 440), (300, 440)], dtype=float)


def letters(*shapes: np.ndarray) -> Document:
    """A layer without marks whose keys are these shapes."""
    keys = (Keyframe(1 + 24 * k, Outline.polygon(shape)) for k, shape in enumerate(shapes))
    return Document((Layer(1, "L", tuple(keys)),))


@pytest.fixture
def hand(open_canvas: Callable[..., Hand]) -> Hand:
    return open_canvas(letters(L, TALL), tool="marks", solve=solve_span)


@pytest.fixture
def settle(qtbot: QtBot) -> Callable[[Hand], tuple[Suggestion, ...]]:
    """Wait until suggestions hold for the document as it is, and return those shown."""

    def wait(hand: Hand) -> tuple[Suggestion, ...]:
        qtbot.waitUntil(lambda: hand.workspace.suggestions.current)
        QApplication.processEvents()  # the panes show them
        return hand.workspace.suggestions.shown

    return wait


def position(hand: Hand, suggestion: Suggestion, key: int) -> np.ndarray:
    """Where a suggestion lies in the document."""
    return hand.document.layers[0].keyframes[key].outline.position(suggestion.places[key])


def seen(hand: Hand, role: Role) -> list[tuple[float, ...]]:
    """The places at which a pane shows suggestions."""
    ends = hand.pane(role).suggested.ends
    return [tuple(place) for _, pins in ends for place in pins.places]


def picture(hand: Hand, role: Role) -> QImage:
    """What a pane looks like."""
    return hand.pane(role).view.grab().toImage()


# -- what is shown -----------------------------------------------------------------------------


def test_an_unmarked_span_shows_the_marks_that_it_was_solved_with(hand: Hand):
    w = hand.workspace
    morph = w.solver.morph_of(span_of(hand.document.layers[0], 0))
    shown = w.suggestions.shown
    assert shown
    assert {(*s.places, s.confidence) for s in shown} == set(morph.report.proposed)
    assert seen(hand, SOURCE) == [tuple(position(hand, s, 0)) for s in shown]
    assert seen(hand, TARGET) == [tuple(position(hand, s, 1)) for s in shown]
    assert seen(hand, BETWEEN) == []


def test_what_does_not_stand_out_is_but_a_dot_and_can_be_accepted_all_the_same(hand: Hand, settle):
    shown = hand.workspace.suggestions.shown
    corner, side = shown[0], shown[-1]
    assert corner.sure
    assert not side.sure

    def amber_around(suggestion: Suggestion) -> int:
        middle = hand.pixel(SOURCE, position(hand, suggestion, 0))
        image, near = picture(hand, SOURCE), range(-6, 7)
        pixels = (image.pixelColor(middle.x() + x, middle.y() + y) for x in near for y in near)
        return sum(pixel.hue() in range(35, 60) and pixel.saturation() > 60 for pixel in pixels)

    assert 0 < amber_around(side) < amber_around(corner)
    hand.click(SOURCE, position(hand, side, 0))
    settle(hand)
    [key, _] = hand.document.layers[0].keyframes
    assert key.marks == (side.places[0],)


def test_suggestions_come_with_the_marks_tool_and_go_with_it(hand: Hand):
    assert seen(hand, SOURCE)
    drawn = picture(hand, SOURCE)
    hand.key(SOURCE, Key.Key_Escape)
    assert hand.canvas.tool == "select"
    assert seen(hand, SOURCE) == []
    assert picture(hand, SOURCE) != drawn


@pytest.mark.parametrize(("when", "with_tool", "without"), [("always", 1, 1), ("never", 0, 0)])
def test_they_can_be_shown_always_or_never(hand: Hand, when: str, with_tool: int, without: int):
    hand.workspace.view.update(suggestions=when)
    assert bool(hand.workspace.suggestions.shown) == with_tool
    hand.canvas.set_tool("select")
    assert bool(hand.workspace.suggestions.shown) == without


def test_hiding_all_marks_hides_suggestions_too(hand: Hand):
    hand.workspace.view.update(marks=False)
    assert hand.workspace.suggestions.shown == ()


def test_the_overlay_shows_both_ends(hand: Hand):
    hand.workspace.view.update(layout="overlay")
    shown = hand.workspace.suggestions.shown
    ends = [tuple(position(hand, s, key)) for key in (0, 1) for s in shown]
    assert sorted(seen(hand, OVERLAY)) == sorted(ends)


def test_a_locked_layer_gets_no_suggestions(hand: Hand):
    from core.model.edits import update_layer

    hand.workspace.session.apply("Lock layer", update_layer, 1, locked=True)
    assert hand.workspace.suggestions.shown == ()


# -- accepting ---------------------------------------------------------------------------------


@pytest.mark.parametrize(("role", "key"), [(SOURCE, 0), (TARGET, 1)])
def test_a_click_on_either_side_accepts_exactly_one(hand: Hand, settle, role: Role, key: int):
    before, chosen = hand.document, hand.workspace.suggestions.shown[0]
    hand.click(role, position(hand, chosen, key))
    layer = hand.document.layers[0]
    assert layer.labels == ("a",)
    assert tuple(frame.marks[0] for frame in layer.keyframes) == chosen.places
    assert hand.workspace.selection.mark == 0
    assert hand.steps == ["Place mark a"]
    assert chosen.places not in [s.places for s in settle(hand)]
    hand.workspace.session.undo()
    assert hand.document is before


@pytest.mark.parametrize("key", [0, 1])
def test_a_click_on_either_end_in_the_overlay_accepts_it(hand: Hand, key: int):
    hand.workspace.view.update(layout="overlay")
    chosen = hand.workspace.suggestions.shown[0]
    hand.click(OVERLAY, position(hand, chosen, key))
    assert hand.document.layers[0].keyframes[0].marks == chosen.places[:1]


def test_enter_accepts_all_in_one_step_and_undo_restores_the_document(hand: Hand, settle):
    before, shown = hand.document, hand.workspace.suggestions.shown
    hand.key(SOURCE, Key.Key_Return)
    layer = hand.document.layers[0]
    assert list(zip(*(key.marks for key in layer.keyframes), strict=True)) == [
        s.places for s in shown
    ]
    assert hand.steps == ["Accept suggested marks"]
    assert settle(hand) == ()
    hand.workspace.session.undo()
    assert hand.document is before
    assert settle(hand) == shown


def test_a_drag_makes_it_a_mark_where_it_is_dropped(hand: Hand):
    before, chosen = hand.document, hand.workspace.suggestions.shown[0]
    start = position(hand, chosen, 1)
    hand.drag(TARGET, start, (380, 200))
    source, target = hand.document.layers[0].keyframes
    assert source.marks == chosen.places[:1]
    assert target.outline.position(target.marks[0]) == pytest.approx((380, 200), abs=1.5)
    assert hand.steps == ["Place mark a"]
    hand.workspace.session.undo()
    assert hand.document is before


def test_escape_takes_a_dragged_suggestion_back(hand: Hand):
    before, chosen = hand.document, hand.workspace.suggestions.shown[0]
    hand.pull(SOURCE, position(hand, chosen, 0), (500, 250))
    assert hand.document.layers[0].labels == ("a",)
    hand.key(SOURCE, Key.Key_Escape)
    hand.release(SOURCE, (500, 250))
    assert hand.document is before


def test_tab_goes_through_them_and_enter_accepts_the_one_that_is_reached(hand: Hand, settle):
    shown = hand.workspace.suggestions.shown
    for _ in range(2):
        hand.key(SOURCE, Key.Key_Tab)
    assert "suggestion 2" in hand.canvas.hint
    hand.key(SOURCE, Key.Key_Return)
    layer = hand.document.layers[0]
    assert tuple(key.marks[0] for key in layer.keyframes) == shown[1].places
    rest = settle(hand)
    hand.key(SOURCE, Key.Key_Tab)  # from mark a, which is selected, on to the suggestions
    hand.key(SOURCE, Key.Key_Return)
    assert tuple(key.marks[1] for key in hand.document.layers[0].keyframes) == rest[0].places


def test_escape_leaves_the_suggestion_that_tab_reached_before_it_leaves_the_tool(hand: Hand):
    hand.key(SOURCE, Key.Key_Tab)
    hand.key(SOURCE, Key.Key_Escape)
    assert hand.canvas.tool == "marks"
    hand.key(SOURCE, Key.Key_Escape)
    assert hand.canvas.tool == "select"


def test_the_hint_says_what_a_click_and_enter_and_escape_do(hand: Hand):
    shown = hand.workspace.suggestions.shown
    hand.move(SOURCE, (450, 500))
    assert "or a suggestion · Enter: all · Esc: hide" in hand.canvas.hint
    hand.move(SOURCE, position(hand, shown[0], 0))
    assert "accept suggestion 1 as mark a" in hand.canvas.hint


def test_real_marks_come_before_suggestions_under_the_mouse(hand: Hand, settle):
    first = position(hand, hand.workspace.suggestions.shown[0], 0)
    hand.click(SOURCE, first)
    settle(hand)
    hand.click(SOURCE, first)
    assert hand.document.layers[0].labels == ("a",)


# -- following the document --------------------------------------------------------------------


def test_with_marks_of_the_artist_they_fill_the_gaps_only(hand: Hand, settle):
    hand.click(SOURCE, L[2])
    marks = {key.marks[0] for key in hand.document.layers[0].keyframes}
    for suggestion in settle(hand):
        assert marks.isdisjoint(suggestion.places)


def test_where_marks_contradict_each_other_no_more_are_suggested(hand: Hand, settle, qtbot: QtBot):
    session, suggestions = hand.workspace.session, hand.workspace.suggestions
    for place in (L[0], (L[0] + L[1]) / 2, L[1]):  # which leaves three corners without a mark
        hand.click(SOURCE, place)
        settle(hand)
    assert suggestions.shown
    first, second, third = hand.document.layers[0].keyframes[1].marks
    between = replace(second, at=(second.at + third.at) / 2)
    session.apply("Move mark", move_mark, 1, 1, 0, between)
    qtbot.waitUntil(lambda: bool(hand.workspace.solver.errors))
    assert suggestions.shown == ()
    session.undo()
    assert hand.document.layers[0].keyframes[1].marks[0] == first
    qtbot.waitUntil(lambda: bool(suggestions.shown))


def test_they_follow_a_dragged_node_after_its_release_and_are_stale_until_then(
    hand: Hand, settle, qtbot: QtBot
):
    suggestions = hand.workspace.suggestions
    before = suggestions.shown
    hand.workspace.view.update(suggestions="always")
    hand.canvas.set_tool("nodes")
    hand.pull(TARGET, TALL[1], (460, 60))
    assert not suggestions.current
    qtbot.waitUntil(lambda: not hand.workspace.solver.busy)
    assert suggestions.shown == before  # still seen, on the outline as it is now
    assert not suggestions.current
    hand.release(TARGET, (460, 60))
    settle(hand)
    span = span_of(hand.document.layers[0], 0)
    proposed = hand.workspace.solver.morph_of(span).report.proposed
    assert {(*s.places, s.confidence) for s in suggestions.shown} == set(proposed)


def test_a_stale_suggestion_cannot_be_accepted(hand: Hand):
    session, suggestions = hand.workspace.session, hand.workspace.suggestions
    chosen = suggestions.shown[0]
    drag = session.begin("Move node")
    drag.apply(move_nodes, 1, 1, 0, [1], (20.0, 0.0))
    moved = hand.document
    suggestions.accept(chosen)
    suggestions.accept_all()
    hand.key(SOURCE, Key.Key_Return)
    assert hand.document is moved
    assert not hand.pane(SOURCE).suggested.current
    drag.abandon()


def test_they_follow_the_playhead_to_another_span(open_canvas, settle):
    document = letters(L, TALL, L[:, ::-1])
    hand = open_canvas(document, tool="marks", solve=solve_span)
    first = hand.workspace.suggestions.shown
    hand.workspace.playhead.move_to(30)
    second = settle(hand)
    assert second != first
    assert hand.workspace.suggestions.span == 1
    assert seen(hand, SOURCE) == [tuple(position(hand, s, 1)) for s in second]
    hand.click(TARGET, position(hand, second[0], 2))
    assert tuple(k.marks[0] for k in hand.document.layers[0].keyframes) == second[0].places


def test_holes_get_suggestions_too(open_canvas):
    hole = np.array([(320, 350), (400, 350), (360, 400)], dtype=float)
    outlines = [Outline.polygon(shape, hole + k) for k, shape in enumerate((L, TALL))]
    keys = tuple(Keyframe(1 + 24 * k, outline) for k, outline in enumerate(outlines))
    hand = open_canvas(Document((Layer(1, "L", keys),)), tool="marks", solve=solve_span)
    rings = {place.ring for s in hand.workspace.suggestions.shown for place in s.places}
    assert rings == {0, 1}


def test_what_is_suggested_is_never_saved(hand: Hand, tmp_path):
    assert hand.workspace.suggestions.shown
    assert not hand.workspace.session.dirty
    project.save(hand.document, tmp_path / "letters.betwixt")
    layer = project.load(tmp_path / "letters.betwixt").layers[0]
    assert layer.labels == ()
    assert all(key.marks == () for key in layer.keyframes)


def test_nothing_is_matched_while_no_marks_are_placed(open_canvas, qtbot: QtBot, monkeypatch):
    asked = []
    monkeypatch.setattr("app.jobs.suggestions.match_layer", lambda *args: asked.append(args))
    hand = open_canvas(letters(L, TALL))
    hand.workspace.session.apply("Mark", _marked, 1)
    qtbot.waitUntil(lambda: not hand.workspace.solver.busy)
    assert asked == []


def _marked(document: Document, layer_id: int) -> Document:
    from core.model.edits import add_mark

    return add_mark(document, layer_id, [RingPoint(0, 0.0), RingPoint(0, 0.0)])
