from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from copy import deepcopy
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.errors import EditError
from core.model import (
    Document,
    Easing,
    Keyframe,
    Layer,
    Outline,
    Recipe,
    RingPoint,
    Style,
    Turning,
    edits,
)
from core.model.outline import MIN_NODES
from core.model.structure import problems
from core.model.style import FILLS
from tests.core.model.shapes import documents, easings, layers, outlines, places

Call = tuple[Callable[..., Document], tuple[Any, ...]]
TRIANGLE = Outline.polygon([[0, 0], [10, 0], [0, 10]])


@st.composite
def calls(draw: st.DrawFn, document: Document) -> Call:
    """Any edit of one keyframe or one layer, with arguments that fit the document."""
    layer = draw(st.sampled_from(document.layers))
    key = draw(st.integers(0, len(layer.keyframes) - 1))
    outline, marks = layer.keyframes[key].outline, layer.keyframes[key].marks
    place = draw(places(outline))
    node = (place.ring, int(place.at))
    options: list[Call] = [
        (edits.set_easing, (key, Easing(0.1, 0.2, 0.3, 0.4))),
        (edits.set_passing, (key, True)),
        (edits.set_turning, (key, Turning("clockwise", 3, "straight"))),
        (edits.hang_layer, (None,)),
        (edits.move_nodes, (key, place.ring, [node[1]], (3.0, -4.0))),
        (edits.set_handles, (key, node, (1.0, 2.0), (3.0, 4.0))),
        (edits.insert_node, (key, place)),
        (edits.transform_outline, (key, [[0, -1], [1, 0]], (5.0, 6.0))),
        (edits.replace_outline, (key, TRIANGLE, [RingPoint(0, 0.5)] * len(marks))),
        (edits.add_mark, ([RingPoint(0, 0.25)] * len(layer.keyframes),)),
        (edits.move_keyframe, (key, layer.keyframes[key].frame)),
    ]
    if len(outline.rings[place.ring]) > MIN_NODES:
        options.append((edits.delete_nodes, (key, place.ring, [node[1]])))
    if marks:
        options.append((edits.move_mark, (key, draw(st.integers(0, len(marks) - 1)), place)))
        options.append((edits.remove_marks, ([0],)))
    edit, args = draw(st.sampled_from(options))
    return edit, (layer.id, *args)


@given(documents(), st.data())
def test_an_edit_leaves_the_given_document_as_it_was(
    document: Document, data: st.DataObject
) -> None:
    before = deepcopy(document)
    edit, args = data.draw(calls(document))
    edit(document, *args)
    assert document == before


@given(documents(), st.data())
def test_an_edit_shares_every_layer_and_key_it_does_not_touch(
    document: Document, data: st.DataObject
) -> None:
    edit, (layer_id, *args) = data.draw(calls(document))
    after = edit(document, layer_id, *args)
    for old, new in zip(document.layers, after.layers, strict=True):
        assert new is old or old.id == layer_id
    if isinstance(args[0], int):  # an edit of one keyframe
        old, new = document.layer(layer_id), after.layer(layer_id)
        for i, (a, b) in enumerate(zip(old.keyframes, new.keyframes, strict=True)):
            assert b is a or i == args[0]


@given(documents(), st.data())
def test_a_lock_keeps_all_but_name_place_and_visibility(
    document: Document, data: st.DataObject
) -> None:
    edit, (layer_id, *args) = data.draw(calls(document))
    locked = edits.update_layer(document, layer_id, locked=True)
    after = edit(locked, layer_id, *args)
    if after is locked:
        edits.require_locks_kept(locked, after)
    else:
        with pytest.raises(EditError, match="is locked"):
            edits.require_locks_kept(locked, after)
    for free in (
        edits.reorder_layer(edits.update_layer(locked, layer_id, name="x"), layer_id, 0),
        edits.update_layer(locked, layer_id, visible=False, locked=False),
        edits.update_document(locked, fps=3.0),
    ):
        edits.require_locks_kept(locked, free)
    with pytest.raises(EditError, match="is locked"):
        edits.require_locks_kept(locked, edits.remove_layer(locked, layer_id))


@given(documents())
def test_an_edit_that_changes_nothing_returns_the_very_same_document(document: Document) -> None:
    layer = document.layers[0]
    key = layer.keyframes[0]
    ring = key.outline.rings[0]
    place = (0, 1)
    for after in (
        edits.update_document(document, fps=document.fps),
        edits.update_layer(document, layer.id, style=Style(), recipe=Recipe()),
        edits.reorder_layer(document, layer.id, 0),
        edits.hang_layer(document, layer.id, None),
        edits.move_keyframe(document, layer.id, 0, key.frame),
        edits.set_easing(document, layer.id, 0, Easing()),
        edits.replace_outline(document, layer.id, 0, deepcopy(key.outline), key.marks),
        edits.move_nodes(document, layer.id, 0, 0, [0, 1], (0.0, 0.0)),
        edits.move_nodes(document, layer.id, 0, 0, [], (5.0, 5.0)),
        edits.set_handles(
            document, layer.id, 0, place, ring.handles_in[1].copy(), ring.handles_out[1].copy()
        ),
        edits.insert_node(document, layer.id, 0, RingPoint(0, 1.0)),
        edits.delete_nodes(document, layer.id, 0, 0, []),
        edits.transform_outline(document, layer.id, 0, np.eye(2), (0.0, 0.0)),
        edits.remove_marks(document, layer.id, []),
    ):
        assert after is document


# -- what is impossible ------------------------------------------------------------------------

indices = st.integers(-3, 12)
numbers = st.floats() | st.sampled_from([0.0, -1.0, 1e308])
vectors = st.tuples(numbers, numbers)
any_place = st.builds(RingPoint, st.integers(-1, 1), st.floats(-2, 12) | numbers)


@st.composite
def wild_calls(draw: st.DrawFn) -> Call:
    """Any edit of layer 1, with arguments of the right kind that may not fit the document."""
    key, ring, node, mark = (draw(indices) for _ in range(4))
    x, place, offset = draw(numbers), draw(any_place), draw(vectors)
    with np.errstate(all="ignore"):
        outline = Outline.polygon(draw(st.lists(vectors, max_size=4)))
    drawn = Keyframe(draw(st.integers(-(10**7), 10**7)), outline, (place,), Easing(x, x, x, x))
    options: list[Call] = [
        (edits.update_layer, ()),
        (edits.duplicate_layer, ("copy",)),
        (edits.remove_layer, ()),
        (edits.reorder_layer, (key,)),
        (edits.hang_layer, (key,)),
        (edits.insert_keyframe, (drawn,)),
        (edits.insert_keyframe, (replace(drawn, marks=()),)),
        (edits.remove_keyframe, (key,)),
        (edits.move_keyframe, (key, drawn.frame)),
        (edits.replace_outline, (key, outline, [place])),
        (edits.set_easing, (key, drawn.easing)),
        (edits.move_nodes, (key, ring, [node, node + 1], offset)),
        (edits.set_handles, (key, (ring, node), offset, (0.0, 0.0))),
        (edits.insert_node, (key, place)),
        (edits.delete_nodes, (key, ring, [node])),
        (edits.transform_outline, (key, [offset, (0.0, x)], offset)),
        (edits.add_mark, ([place, place],)),
        (edits.move_mark, (key, mark, place)),
        (edits.remove_marks, ([mark],)),
    ]
    return draw(st.sampled_from(options))


@given(wild_calls())
def test_no_edit_is_possible_on_a_layer_that_is_not_there(call: Call) -> None:
    edit, args = call
    for document in (Document(), Document((Layer(2, "", (Keyframe(1, TRIANGLE),)),))):
        with pytest.raises(EditError, match="no such layer"):
            edit(document, 1, *args)


@settings(max_examples=300)
@given(layers(), wild_calls())
@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # coordinates may overflow
def test_an_edit_makes_a_sound_document_or_is_refused(layer: Layer, call: Call) -> None:
    edit, args = call
    with suppress(EditError):
        assert not list(problems(edit(Document((layer,)), 1, *args)))


@given(numbers, numbers)
def test_settings_are_sound_or_refused(a: float, b: float) -> None:
    for changes in ({"fps": a}, {"size": (a, b)}):
        with suppress(EditError):
            assert not list(problems(edits.update_document(Document(), **changes)))


@pytest.mark.parametrize(
    ("edit", "args"),
    [
        (edits.update_document, ()),
        (edits.move_nodes, (1, 0, 0, [0], (np.nan, 0))),
        (edits.move_nodes, (1, 0, 1, [0], (1, 1))),
        (edits.move_nodes, (1, 0, 0, [3], (1, 1))),
        (edits.set_handles, (1, 0, (0, -1), (1, 1), (1, 1))),
        (edits.delete_nodes, (1, 0, 0, [7])),
        (edits.insert_node, (1, 0, RingPoint(0, 3.5))),
        (edits.add_mark, (1, [RingPoint(0, -0.5)])),
        (edits.move_mark, (1, 0, 0, RingPoint(0, 0.5))),
        (edits.remove_marks, (1, [-1])),
        (edits.add_layer, ("", 1, Outline(()))),
    ],
)
def test_what_does_not_fit_the_document_is_refused(
    edit: Callable[..., Document], args: tuple[Any, ...]
) -> None:
    changes = {"fps": 0} if edit is edits.update_document else {}
    with pytest.raises(EditError):
        edit(Document((Layer(1, "", (Keyframe(1, TRIANGLE),)),)), *args, **changes)


# -- layers ------------------------------------------------------------------------------------


@given(documents(), st.integers(-5, 5), st.data())
def test_reordering_keeps_every_layer_and_the_order_of_the_others(
    document: Document, index: int, data: st.DataObject
) -> None:
    layer = data.draw(st.sampled_from(document.layers))
    after = edits.reorder_layer(document, layer.id, index)
    others = [other for other in document.layers if other is not layer]
    assert [other for other in after.layers if other is not layer] == others
    assert after.layers.index(layer) == min(max(index, 0), len(others))


@given(documents(), st.data())
def test_a_duplicate_lies_above_its_original_and_differs_only_in_name(
    document: Document, data: st.DataObject
) -> None:
    layer = data.draw(st.sampled_from(document.layers))
    after = edits.duplicate_layer(document, layer.id, "copy")
    copy = after.layers[after.layers.index(layer) + 1]
    assert copy == replace(layer, id=copy.id, name="copy")
    assert len({other.id for other in after.layers}) == len(after.layers)
    assert edits.remove_layer(after, copy.id) == document


def hanging(*carriers: int | None) -> Document:
    """Return layers 1, 2, … that hang on these."""
    keys = (Keyframe(1, TRIANGLE),)
    return Document(tuple(Layer(i, "", keys, carrier=c) for i, c in enumerate(carriers, 1)))


def test_layers_hang_in_chains_but_never_in_circles() -> None:
    document = edits.hang_layer(hanging(None, 1, None), 3, 2)
    assert [layer.id for layer in document.carriers(document.layer(3))] == [2, 1]
    for layer, carrier in ((1, 1), (1, 2), (1, 3)):
        with pytest.raises(EditError, match="cannot hang on"):
            edits.hang_layer(document, layer, carrier)
    with pytest.raises(EditError, match="no such layer"):
        edits.hang_layer(document, 1, 4)
    assert edits.hang_layer(document, 3, None) == hanging(None, 1, None)


def test_what_hung_on_a_layer_that_is_removed_hangs_on_nothing() -> None:
    assert edits.remove_layer(hanging(None, 1, 2), 2).layer(3).carrier is None
    assert edits.remove_layer(hanging(None, 1, 2), 1).layer(3).carrier == 2


def test_a_key_that_is_moved_takes_the_keys_at_its_frame_along_that_hang_on_it() -> None:
    document = hanging(None, 1, 2, None)
    document = edits.insert_keyframe(document, 3, Keyframe(5, TRIANGLE))
    after = edits.transform_outline(document, 1, 0, 2 * np.eye(2), (5.0, 0.0))
    moved = TRIANGLE.transformed(2 * np.eye(2), (5.0, 0.0))
    outlines = [[key.outline for key in layer.keyframes] for layer in after.layers]
    assert outlines == [[moved], [moved], [moved, TRIANGLE], [TRIANGLE]]
    locked = edits.update_layer(document, 2, locked=True)
    assert edits.transform_outline(locked, 1, 0, np.eye(2), (1.0, 0.0)).layer(2) is locked.layer(2)


def test_a_hidden_layer_that_carries_a_visible_one_moves() -> None:
    document = edits.update_layer(hanging(None, 1, 2), 1, visible=False)
    document = edits.update_layer(document, 2, visible=False)
    assert [layer.id for layer in document.moving] == [1, 2, 3]
    assert not edits.update_layer(document, 3, visible=False).moving


def test_new_layers_are_told_apart_by_colour_as_long_as_there_are_others() -> None:
    document = Document()
    for i in range(len(FILLS) + 1):
        document = edits.add_layer(document, f"{i}", 1, TRIANGLE)
    fills = [layer.style.fill for layer in document.layers]
    assert len(set(fills)) == len(fills) - 1
    document = edits.update_layer(document, 3, style=Style(fill="#000000"))
    assert edits.add_layer(document, "x", 1, TRIANGLE).layers[-1].style.fill == fills[2]


def test_a_new_layer_lies_on_top_with_an_id_of_its_own() -> None:
    document = edits.add_layer(Document(), "first", 1, TRIANGLE)
    document = edits.add_layer(document, "second", 5, TRIANGLE)
    assert [layer.name for layer in document.layers] == ["first", "second"]
    assert len({layer.id for layer in document.layers}) == 2
    assert document.frames == (1, 5)


# -- keyframes ---------------------------------------------------------------------------------


@given(layers(), st.integers(-30, 230))
def test_keyframes_stay_in_order_one_a_frame(layer: Layer, frame: int) -> None:
    document = Document((layer,))
    key = Keyframe(frame, TRIANGLE, (RingPoint(0, 0.0),) * len(layer.labels))
    try:
        after = edits.insert_keyframe(document, layer.id, key).layers[0]
    except EditError:
        assert layer.key_at(frame) is not None
    else:
        frames = [key.frame for key in after.keyframes]
        assert frames == sorted({*frames})
        assert after.keyframes[after.key_at(frame) or 0].outline is key.outline


@given(easings(), st.integers(1, 23), st.floats(0, 24))
def test_a_keyframe_put_into_a_span_leaves_progress_as_it_was(
    easing: Easing, at: int, frame: float
) -> None:
    easing = replace(easing, x1=min(easing.x1, easing.x2), x2=max(easing.x1, easing.x2))
    layer = Layer(1, "", (Keyframe(0, TRIANGLE, (), easing), Keyframe(24, TRIANGLE)))
    after = edits.insert_keyframe(Document((layer,)), 1, Keyframe(at, TRIANGLE)).layers[0]
    key = layer.progress_at(at)[1]
    span, s = after.progress_at(frame)
    whole = key + (1 - key) * s if span else key * s
    assert whole == pytest.approx(layer.progress_at(frame)[1], abs=1e-4)


def test_a_keyframe_put_before_or_after_all_others_changes_no_timing() -> None:
    slow, fast = Easing(0.5, 0, 1, 1), Easing(0, 0, 0.5, 1)
    layer = Layer(1, "", (Keyframe(10, TRIANGLE, (), slow), Keyframe(20, TRIANGLE)))
    for frame in (5, 25):
        after = edits.insert_keyframe(
            Document((layer,)), 1, Keyframe(frame, TRIANGLE, (), fast)
        ).layers[0]
        key = after.key_at(frame)
        assert key is not None
        assert after.keyframes[key].easing == fast
        assert tuple(k for k in after.keyframes if k.frame != frame) == layer.keyframes


@given(layers(), st.integers(-30, 230), st.data())
def test_a_keyframe_moves_only_between_its_neighbours(
    layer: Layer, frame: int, data: st.DataObject
) -> None:
    key = data.draw(st.integers(0, len(layer.keyframes) - 1))
    frames = [other.frame for other in layer.keyframes]
    frames[key] = frame
    document = Document((layer,))
    if frames == sorted({*frames}):
        after = edits.move_keyframe(document, layer.id, key, frame).layers[0]
        assert [other.frame for other in after.keyframes] == frames
    else:
        with pytest.raises(EditError):
            edits.move_keyframe(document, layer.id, key, frame)


@given(layers(), st.data())
def test_removing_a_keyframe_removes_just_that_one(layer: Layer, data: st.DataObject) -> None:
    key = data.draw(st.integers(0, len(layer.keyframes) - 1))
    document = Document((layer,))
    if len(layer.keyframes) == 1:
        with pytest.raises(EditError, match="at least one keyframe"):
            edits.remove_keyframe(document, layer.id, key)
    else:
        after = edits.remove_keyframe(document, layer.id, key).layers[0]
        assert after.keyframes == layer.keyframes[:key] + layer.keyframes[key + 1 :]


@pytest.mark.parametrize("key", [-1, 2])
def test_a_keyframe_that_is_not_there_cannot_be_edited(key: int) -> None:
    layer = Layer(1, "", (Keyframe(1, TRIANGLE), Keyframe(9, TRIANGLE)))
    document = Document((layer,))
    for edit, args in (
        (edits.set_easing, (Easing(hold=True),)),
        (edits.move_keyframe, (5,)),
        (edits.remove_keyframe, ()),
        (edits.move_nodes, (0, [0], (1, 1))),
    ):
        with pytest.raises(EditError, match="no such keyframe"):
            edit(document, 1, key, *args)


def test_a_keyframe_must_place_every_mark() -> None:
    layer = Layer(1, "", (Keyframe(1, TRIANGLE, (RingPoint(0, 0.0),)),), ("a",))
    document = Document((layer,))
    with pytest.raises(EditError, match="every mark"):
        edits.insert_keyframe(document, 1, Keyframe(5, TRIANGLE))
    with pytest.raises(EditError, match="every mark"):
        edits.replace_outline(document, 1, 0, TRIANGLE, ())


# -- nodes -------------------------------------------------------------------------------------


def one_key(outline: Outline, marks: Sequence[RingPoint]) -> Document:
    labels = tuple("abcdefgh"[: len(marks)])
    return Document((Layer(1, "", (Keyframe(1, outline, tuple(marks)),), labels),))


def cyclic_order(marks: Sequence[RingPoint]) -> list[int]:
    """Indices of the marks of ring 0 as they are met going round, starting at the lowest index."""
    met = sorted((mark.at, i) for i, mark in enumerate(marks) if mark.ring == 0)
    order = [i for _, i in met]
    start = order.index(min(order)) if order else 0
    return order[start:] + order[:start]


def assert_on_outline(key: Keyframe) -> None:
    for mark in key.marks:
        assert 0 <= mark.at < len(key.outline.rings[mark.ring])


@given(outlines, st.data())
def test_a_new_node_lies_where_it_was_asked_for_and_marks_stay_where_they_were(
    outline: Outline, data: st.DataObject
) -> None:
    marks = data.draw(st.lists(places(outline), max_size=4))
    place = data.draw(places(outline))
    after = edits.insert_node(one_key(outline, marks), 1, 0, place).layers[0].keyframes[0]
    assert_on_outline(after)
    for old, new in zip(marks, after.marks, strict=True):
        np.testing.assert_allclose(after.outline.position(new), outline.position(old), atol=1e-6)
    ring = after.outline.rings[place.ring]
    if len(ring) > len(outline.rings[place.ring]):
        node = int(place.at) + 1
        np.testing.assert_allclose(ring.points[node], outline.position(place), atol=1e-9)


@given(outlines, st.data())
def test_deleting_nodes_keeps_the_marks_in_their_order_round_the_ring(
    outline: Outline, data: st.DataObject
) -> None:
    n = len(outline.rings[0])
    grid = st.integers(0, 8 * n - 1).map(lambda i: RingPoint(0, i / 8))
    marks = data.draw(st.lists(grid, max_size=5, unique=True))
    gone = data.draw(st.sets(st.integers(0, n - 1), max_size=n - MIN_NODES))
    document = one_key(outline, marks)
    after = edits.delete_nodes(document, 1, 0, 0, list(gone)).layers[0].keyframes[0]
    assert len(after.outline.rings[0]) == n - len(gone)
    assert_on_outline(after)
    assert cyclic_order(after.marks) == cyclic_order(marks)
    assert len({mark.at for mark in after.marks}) == len(marks)


@pytest.mark.parametrize("at", [1 - 2.0**-53, 1 - 2.0**-52, 1 - 2.0**-51, 4 - 2.0**-51])
def test_a_mark_a_rounding_error_before_the_first_node_stays_on_the_ring(at: float) -> None:
    outline = Outline.polygon([[0, 0], [9, 0], [9, 9], [0, 9]])
    document = one_key(outline, [RingPoint(0, at)])
    assert_on_outline(edits.delete_nodes(document, 1, 0, 0, [0]).layers[0].keyframes[0])
    assert_on_outline(edits.insert_node(document, 1, 0, RingPoint(0, 3.25)).layers[0].keyframes[0])


@given(outlines, st.data())
def test_deleting_nodes_leaves_marks_on_other_segments_alone(
    outline: Outline, data: st.DataObject
) -> None:
    n = len(outline.rings[0])
    gone = data.draw(st.sets(st.integers(0, n - 1), max_size=n - MIN_NODES))
    untouched = [i for i in range(n) if not {i, (i + 1) % n} & gone]
    marks = [RingPoint(0, i + 0.3) for i in untouched]
    document = one_key(outline, marks)
    after = edits.delete_nodes(document, 1, 0, 0, list(gone)).layers[0].keyframes[0]
    for old, new in zip(marks, after.marks, strict=True):
        np.testing.assert_allclose(after.outline.position(new), outline.position(old), atol=1e-6)


@given(outlines, st.data())
def test_deleting_the_node_just_inserted_restores_the_places_of_all_marks_off_it(
    outline: Outline, data: st.DataObject
) -> None:
    place = data.draw(places(outline))
    segment = RingPoint(place.ring, float(int(place.at)))
    marks = [
        mark
        for mark in data.draw(st.lists(places(outline), max_size=4))
        if (mark.ring, int(mark.at)) != (segment.ring, int(segment.at))
    ]
    document = one_key(outline, marks)
    with_node = edits.insert_node(document, 1, 0, place)
    if with_node is document:
        return
    back = edits.delete_nodes(with_node, 1, 0, place.ring, [int(place.at) + 1])
    for old, new in zip(marks, back.layers[0].keyframes[0].marks, strict=True):
        assert new.ring == old.ring
        assert new.at == pytest.approx(old.at, abs=1e-9)


@given(outlines)
def test_a_ring_keeps_at_least_three_nodes(outline: Outline) -> None:
    n = len(outline.rings[0])
    with pytest.raises(EditError, match="at least 3 nodes"):
        edits.delete_nodes(one_key(outline, ()), 1, 0, 0, range(n - 2))


@given(outlines, st.data())
def test_moving_nodes_moves_them_with_their_handles_and_nothing_else(
    outline: Outline, data: st.DataObject
) -> None:
    ring = outline.rings[0]
    nodes = data.draw(st.sets(st.integers(0, len(ring) - 1)))
    document = edits.move_nodes(one_key(outline, ()), 1, 0, 0, sorted(nodes), (7.0, -2.0))
    moved = document.layers[0].keyframes[0].outline
    expected = np.array([(7.0, -2.0) if i in nodes else (0.0, 0.0) for i in range(len(ring))])
    np.testing.assert_allclose(moved.rings[0].points - ring.points, expected, atol=1e-9)
    np.testing.assert_array_equal(moved.rings[0].handles_in, ring.handles_in)
    np.testing.assert_array_equal(moved.rings[0].handles_out, ring.handles_out)
    assert moved.rings[1:] == outline.rings[1:]


# -- marks -------------------------------------------------------------------------------------


@given(documents())
def test_every_keyframe_places_every_mark_whatever_is_added_or_removed(document: Document) -> None:
    layer = document.layers[0]
    before = layer.labels
    document = edits.add_mark(document, layer.id, [RingPoint(0, 0.5)] * len(layer.keyframes))
    labels = document.layers[0].labels
    assert labels[:-1] == before
    assert labels[-1] not in before
    document = edits.remove_marks(document, layer.id, [0])
    assert document.layers[0].labels == labels[1:]
    assert all(len(key.marks) == len(labels) - 1 for key in document.layers[0].keyframes)


def test_the_first_free_letter_is_taken() -> None:
    document = one_key(TRIANGLE, [RingPoint(0, 0.0), RingPoint(0, 1.0), RingPoint(0, 2.0)])
    document = edits.remove_marks(document, 1, [1])
    assert edits.add_mark(document, 1, [RingPoint(0, 0.5)]).layers[0].labels == ("a", "c", "b")


def test_a_mark_needs_a_place_on_every_keyframe() -> None:
    with pytest.raises(EditError, match="every keyframe"):
        edits.add_mark(one_key(TRIANGLE, ()), 1, [])


@given(outlines, st.data())
def test_moving_a_mark_moves_that_mark_on_that_keyframe_only(
    outline: Outline, data: st.DataObject
) -> None:
    marks = data.draw(st.lists(places(outline), min_size=1, max_size=4))
    mark = data.draw(st.integers(0, len(marks) - 1))
    place = data.draw(places(outline))
    after = edits.move_mark(one_key(outline, marks), 1, 0, mark, place).layers[0].keyframes[0]
    assert list(after.marks) == [*marks[:mark], place, *marks[mark + 1 :]]


def test_a_key_put_into_a_span_parts_its_turning():
    keys = Keyframe(1, TRIANGLE, turning=Turning("clockwise", 2)), Keyframe(9, TRIANGLE)
    earlier, later = Turning("clockwise", 1), Turning("clockwise")
    new = Keyframe(5, TRIANGLE, turning=later)
    after = edits.insert_keyframe(Document((Layer(1, "L", keys),)), 1, new, earlier).layers[0]
    assert [key.turning for key in after.keyframes[:2]] == [earlier, later]


def test_a_key_put_into_a_span_is_passed_where_an_end_of_that_span_is():
    keys = [Keyframe(frame, TRIANGLE, passes=True) for frame in (1, 9, 17, 25)]
    keys[2] = replace(keys[2], passes=False)
    document = Document((Layer(1, "L", tuple(keys)),))
    for frame, passes in ((5, True), (13, True), (20, False)):
        after = edits.insert_keyframe(document, 1, Keyframe(frame, TRIANGLE)).layers[0]
        assert after.keyframes[after.key_at(frame)].passes == passes
