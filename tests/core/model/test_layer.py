from __future__ import annotations

from dataclasses import replace
from itertools import islice
from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.model import Document, Easing, Keyframe, Layer, Outline, Recipe
from core.model.easing import HOLD
from core.model.layer import mark_labels
from tests.core.model.shapes import easings, layers

frames = st.floats(-50, 250)
SQUARE = Outline.polygon([[0, 0], [1, 0], [1, 1], [0, 1]])


@given(layers(), frames)
def test_span_and_time_lead_back_to_the_frame(layer: Layer, frame: float) -> None:
    index, t = layer.span_at(frame)
    assert 0.0 <= t <= 1.0
    first, last = layer.keyframes[0].frame, layer.keyframes[-1].frame
    if layer.spans:
        start, end = (key.frame for key in layer.keyframes[index : index + 2])
        assert start + t * (end - start) == pytest.approx(min(max(frame, first), last))


@given(layers())
def test_a_key_begins_its_span_and_the_last_key_ends_the_last_one(layer: Layer) -> None:
    *starts, last = layer.keyframes
    assert [layer.span_at(key.frame) for key in starts] == [(i, 0.0) for i in range(len(starts))]
    assert layer.span_at(last.frame) == (max(layer.spans - 1, 0), float(layer.spans > 0))


@given(layers(max_keys=1), frames)
def test_a_single_key_stands_still_for_ever(layer: Layer, frame: float) -> None:
    assert layer.span_at(frame) == (0, 0.0)
    assert layer.progress_at(frame) == (0, 0.0)


@given(layers(), frames)
def test_a_key_is_found_at_its_frame_and_nowhere_else(layer: Layer, frame: float) -> None:
    for index, key in enumerate(layer.keyframes):
        assert layer.key_at(key.frame) == index
    on_a_key = frame in {key.frame for key in layer.keyframes}
    assert (layer.key_at(frame) is not None) == on_a_key


@given(layers())
def test_every_frame_in_a_keys_room_keeps_the_keys_in_order_and_no_other_does(
    layer: Layer,
) -> None:
    for key in range(len(layer.keyframes)):
        least, most = layer.room(key)
        for frame in {least - 1, least, most, most + 1} - {inf, -inf}:
            frames = [other.frame for other in layer.keyframes]
            frames[key] = frame
            assert (frames == sorted(set(frames))) == (least <= frame <= most)


def test_marks_are_lettered_a_to_z_and_on_from_aa() -> None:
    labels = list(islice(mark_labels(), 26 * 27 + 1))
    assert labels[:2] + labels[25:28] + labels[-2:] == ["a", "b", "z", "aa", "ab", "zz", "aaa"]
    assert len(set(labels)) == len(labels)


@given(st.lists(layers(), max_size=3))
def test_a_document_spans_from_its_first_key_to_its_last(stack: list[Layer]) -> None:
    keys = [key.frame for layer in stack for key in layer.keyframes] or [1]
    assert Document(tuple(stack)).frames == (min(keys), max(keys))


def test_progress_is_time_in_the_span_eased_by_the_key_that_begins_it() -> None:
    slow = Easing(0.42, 0, 1, 1)
    layer = Layer(
        1, "", (Keyframe(0, SQUARE, (), slow), Keyframe(10, SQUARE), Keyframe(20, SQUARE))
    )
    assert layer.progress_at(5) == (0, slow(0.5))
    assert layer.progress_at(10) == (1, 0.0)
    assert layer.progress_at(99) == (1, 1.0)


def test_only_a_key_between_two_spans_that_move_rigidly_is_passed() -> None:
    keys = tuple(Keyframe(frame, SQUARE, passes=True) for frame in (1, 5, 9, 20))
    layer = Layer(1, "L", keys)
    assert [layer.passes(i) for i in range(4)] == [False, True, True, False]
    straight = replace(layer, recipe=Recipe(method="linear"))
    assert not any(straight.passes(i) for i in range(4))
    held = (keys[0], replace(keys[1], easing=HOLD), *keys[2:])
    assert not any(replace(layer, keyframes=held).passes(i) for i in range(4))


@given(easings(), st.booleans(), st.booleans())
def test_easing_is_even_where_a_key_is_passed_and_as_chosen_elsewhere(
    easing: Easing, first: bool, last: bool
) -> None:
    easing = replace(easing, hold=False)
    found = easing.even_at(first, last)
    for end, even in ((0.0, first), (1.0, last)):
        if even:
            assert abs(found(abs(end - 1e-6)) - end) / 1e-6 == pytest.approx(1, abs=1e-3)
    if not first:
        assert (found.x1, found.y1) == (easing.x1, easing.y1)
    if not last:
        assert (found.x2, found.y2) == (easing.x2, easing.y2)
