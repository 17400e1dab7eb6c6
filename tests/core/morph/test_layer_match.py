"""All keyframes of a layer at once: mates both ways, and suggestions with a place on each."""

from __future__ import annotations

import numpy as np
import pytest

from core.model import Document, Keyframe, Layer, Outline, RingPoint
from core.model.edits import add_mark
from core.morph.layer_match import match_layer
from core.morph.scene import solve_span, span_of
from tests.core.shapes import ellipse, letter_l, rotation

TALLER = letter_l() * [1.0, 1.3]
TURNED = TALLER @ rotation(0.4).T
HOLE = 0.5 + ellipse(40, 0.2, 0.15)


def keyframes(*outlines):
    return tuple(Keyframe(1 + 8 * k, outline) for k, outline in enumerate(outlines))


@pytest.fixture
def letters():
    """An L, a taller one, and that turned."""
    return keyframes(*(Outline.polygon(shape) for shape in (letter_l(), TALLER, TURNED)))


def test_a_mark_has_one_place_on_every_key_whichever_was_clicked(letters):
    match = match_layer(letters)
    for corner in range(6):
        place = RingPoint(0, float(corner))
        for key in range(3):
            assert match.mates({key: place}) == (place, place, place)


def test_mates_agree_whether_they_are_asked_for_from_one_end_or_the_other(letters):
    match = match_layer(letters)
    for at in np.linspace(0.05, 5.95, 23):
        there = match.mates({0: RingPoint(0, float(at))})
        back = match.mates({2: there[2]})
        assert abs(back[0].at - at) < 0.02


def test_what_was_solved_without_marks_is_suggested_as_it_was(letters):
    span = span_of(Layer(1, "L", letters), 1)
    proposed = solve_span(span).report.proposed
    found = match_layer(letters, 1, proposed).suggestions(1, proposed)
    assert {(*s.places[1:], s.confidence) for s in found} == set(proposed)


def test_what_stands_out_is_suggested_first_and_each_kind_in_order_around_the_outline(letters):
    proposed = [
        (RingPoint(0, at), RingPoint(0, at), confidence)
        for at, confidence in ((0.0, 0.9), (0.5, 0.0), (1.0, 0.8), (2.5, 0.1), (4.0, 0.4))
    ]
    found = match_layer(letters[:2], 0, proposed).suggestions(0, proposed)
    assert [s.places[0].at for s in found] == [0.0, 1.0, 4.0, 0.5, 2.5]
    assert [s.sure for s in found] == [True, True, True, False, False]


def test_accepting_all_suggestions_leaves_the_in_between_as_it_was(letters):
    ends = letters[:2]
    before = solve_span(span_of(Layer(1, "L", ends), 0))
    match = match_layer(ends, 0, before.report.proposed)
    document = Document((Layer(1, "L", ends),))
    for suggestion in match.suggestions(0, before.report.proposed):
        document = add_mark(document, 1, suggestion.places)
    after = solve_span(span_of(document.layers[0], 0))
    assert after.report.distortion_mean == pytest.approx(before.report.distortion_mean, rel=1e-3)


def test_suggestions_that_were_accepted_are_suggested_no_more(letters):
    found = match_layer(letters).suggestions(0)
    assert found
    document = Document((Layer(1, "L", letters),))
    for suggestion in found:
        document = add_mark(document, 1, suggestion.places)
    assert match_layer(document.layers[0].keyframes).suggestions(0) == ()


def test_holes_are_suggested_for_beside_an_exterior_that_is_marked():
    shapes = [Outline.polygon(3 * letter_l(), HOLE), Outline.polygon(3 * TALLER, HOLE + 0.1)]
    layer = Layer(1, "L", keyframes(*shapes))
    corners = [(RingPoint(0, float(k)),) * 2 for k in range(6)]
    document = Document((layer,))
    for places in corners:
        document = add_mark(document, 1, places)
    found = match_layer(document.layers[0].keyframes).suggestions(0)
    assert {place.ring for s in found for place in s.places} == {1}


def test_a_layer_of_one_key_has_its_mark_there_and_nowhere_else(letters):
    place = RingPoint(0, 0.5)
    assert match_layer(letters[:1]).mates({0: place}) == (place,)
