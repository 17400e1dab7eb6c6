from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.errors import EditError
from core.model import Document, Keyframe, Layer, Outline, Ring, RingPoint
from core.model.edits import add_mark
from core.morph.edits import (
    cut_hole,
    delete_nodes,
    draw_key,
    length_along,
    move_nodes,
    paste_key,
    redraw_key,
    slide_mark,
)
from tests.card import LEANING, SQUARE, a_document

HOLE = ((400.0, 220.0), (500.0, 220.0), (500.0, 330.0), (400.0, 330.0))


def with_hole() -> Document:
    key = Keyframe(1, Outline.polygon(SQUARE, HOLE))
    return Document((Layer(1, "Frame", (key,)),))


def places(document: Document, key: int) -> np.ndarray:
    keyframe = document.layers[0].keyframes[key]
    return np.array([keyframe.outline.position(mark) for mark in keyframe.marks])


def test_nodes_of_several_rings_move_together():
    moved = move_nodes(with_hole(), 1, 0, frozenset({(0, 1), (1, 3)}), np.array([5.0, -3.0]))
    exterior, hole = moved.layers[0].keyframes[0].outline.rings
    assert tuple(exterior.points[1]) == (605, 147)
    assert tuple(hole.points[3]) == (405, 327)
    assert tuple(exterior.points[0]) == SQUARE[0]


def test_nodes_are_deleted_all_or_none():
    document = with_hole()
    with pytest.raises(EditError):
        delete_nodes(document, 1, 0, frozenset({(0, 0), (1, 0), (1, 1)}))
    fewer = delete_nodes(document, 1, 0, frozenset({(0, 0), (1, 0)}))
    assert [len(ring) for ring in fewer.layers[0].keyframes[0].outline.rings] == [3, 3]


def test_marks_of_an_outline_redrawn_in_place_stay_where_they_were():
    document = redraw_key(a_document(), 1, 0, Outline.polygon(SQUARE[2:] + SQUARE[:2]))
    np.testing.assert_allclose(places(document, 0), places(a_document(), 0))


@pytest.mark.parametrize("offset", [(2000.0, 0.0), (-900.0, 700.0)])
@pytest.mark.parametrize("backwards", [False, True])
def test_marks_of_an_outline_redrawn_elsewhere_keep_their_order(offset, backwards: bool):
    document = a_document(marks=False)
    for at in (0.0, 1.0, 2.0, 3.0):
        document = add_mark(document, 1, [RingPoint(0, at), RingPoint(0, at)])
    moved = np.add(SQUARE, offset)
    outline = Outline.polygon(moved[::-1] if backwards else moved)
    marks = redraw_key(document, 1, 0, outline).layers[0].keyframes[0].marks
    at = np.array([mark.at for mark in marks])
    steps = np.roll(at, -1) - at
    assert len(set(at)) == 4
    assert 1 in (np.sum(steps < 0), np.sum(steps > 0))


def test_a_drawn_key_places_every_mark():
    document = draw_key(a_document(target=False), 1, 25, Outline.polygon(LEANING))
    np.testing.assert_allclose(places(document, 1), [LEANING[0], LEANING[2]])


@settings(deadline=None, max_examples=30)
@given(st.floats(-2000, 2000))
def test_sliding_a_mark_forth_and_back_returns_it(length: float):
    there = slide_mark(a_document(), 1, 0, 0, length)
    back = slide_mark(there, 1, 0, 0, -length)
    np.testing.assert_allclose(places(back, 0), places(a_document(), 0), atol=1e-6)


def test_a_hole_whose_nodes_are_all_deleted_is_filled():
    document = add_mark(with_hole(), 1, [RingPoint(1, 2.0)])
    filled = delete_nodes(document, 1, 0, frozenset((1, node) for node in range(4)))
    key = filled.layers[0].keyframes[0]
    assert len(key.outline.rings) == 1
    assert key.marks[0].ring == 0


def test_holes_must_lie_inside_and_apart():
    triangle = np.array([[420.0, 170.0], [480.0, 170.0], [450.0, 200.0]])
    document = cut_hole(with_hole(), 1, 0, Ring.polygon(triangle))
    assert len(document.layers[0].keyframes[0].outline.rings) == 3
    for offset in ((0.0, 60.0), (160.0, 0.0), (900.0, 0.0)):
        with pytest.raises(EditError):
            cut_hole(with_hole(), 1, 0, Ring.polygon(triangle + offset))


@pytest.mark.parametrize("frame", [13, 25])
def test_a_key_pasted_into_its_own_layer_brings_its_marks(frame):
    document = a_document()
    copied = document.layers[0].keyframes[0]
    layer = paste_key(document, 1, frame, copied, ("a", "b")).layers[0]
    pasted = layer.keyframes[layer.key_at(frame)]
    assert (pasted.outline, pasted.marks) == (copied.outline, copied.marks)


@pytest.mark.parametrize("frame", [13, 25])
def test_a_key_pasted_from_another_layer_gets_marks_of_this_one(frame):
    copied = Keyframe(1, Outline.polygon(LEANING))
    layer = paste_key(a_document(), 1, frame, copied, ()).layers[0]
    pasted = layer.keyframes[layer.key_at(frame)]
    assert pasted.outline == copied.outline
    assert [mark.at for mark in pasted.marks] == [0.0, 2.0]


@pytest.mark.parametrize(("at", "step", "length"), [(0.5, (3, 0), 3), (0.5, (-3, 4), -5)])
def test_an_arrow_leads_along_the_outline_whichever_way_it_points(at, step, length):
    outline = Outline.polygon(SQUARE)
    assert length_along(outline, RingPoint(0, at), np.array(step)) == length
    assert length_along(outline, RingPoint(0, at + 2), np.array(step)) == -length
