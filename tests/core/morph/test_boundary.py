import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import MarkError
from core.geometry.polyline import arc_lengths
from core.morph.boundary import STEEP, MatchedRing, correspond
from tests.core.shapes import ellipse, letter_l, star_shaped

LABELS = "abcdefgh"
SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)


def matched(source, target, source_marks, target_marks):
    return MatchedRing(
        np.asarray(source),
        np.asarray(target),
        np.asarray(source_marks, dtype=float),
        np.asarray(target_marks, dtype=float),
        tuple(range(len(source_marks))),
    )


def jagged(rng, count):
    """Return a star-shaped ring (count, 2) whose radius jumps at every vertex."""
    angle, radius = np.sort(rng.uniform(0, 2 * np.pi, count)), rng.uniform(0.3, 1, count)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


@given(star_shaped(), star_shaped(), st.integers(0, 4), st.floats(0.02, 1))
def test_every_drawn_vertex_of_both_outlines_is_there_exactly(source, target, start, spacing):
    ring = matched(source, target, [0.0], [arc_lengths(target)[start]])
    pair = correspond(ring, (spacing, spacing), LABELS)
    assert {tuple(p) for p in source} <= {tuple(p) for p in pair.source}
    assert {tuple(p) for p in target} <= {tuple(p) for p in pair.target}


def contains(pair, source, target):
    drawn = {tuple(p) for p in source} <= {tuple(p) for p in pair.source}
    return drawn and {tuple(p) for p in target} <= {tuple(p) for p in pair.target}


@given(st.integers(0, 10_000))
def test_no_drawn_vertex_is_lost_where_marks_are_rounded_beside_corners(seed):
    rng = np.random.default_rng(seed)
    source, target = jagged(rng, 60), jagged(rng, 12)
    here, there = (arc_lengths(ring) for ring in (source, target))
    i, j = (np.sort(rng.choice(count, 4, replace=False)) for count in (60, 12))
    beside = rng.uniform(-1e-14, 1e-14, (2, 4))
    marks = np.abs(here[i] + beside[0]), np.abs(there[j] + beside[1])
    pair = correspond(matched(source, target, *marks), (0.2, 0.2), LABELS)
    assert contains(pair, source, target)


@pytest.mark.parametrize("gap", [1e-6, 1e-4, 1e-2])
def test_no_drawn_vertex_is_lost_between_marks_that_are_close_on_the_other_outline(gap):
    source, target = np.insert(SQUARE, 2, [1, gap], axis=0), ellipse(400)
    marks = arc_lengths(source)[[1, 2]], arc_lengths(target)[[0, 200]]
    pair = correspond(matched(source, target, *marks), (0.1, 0.1), LABELS)
    assert contains(pair, source, target)


@given(star_shaped(), star_shaped(), st.floats(0.02, 1))
def test_both_boundaries_keep_their_length_and_no_step_is_longer_than_the_spacing(
    source, target, spacing
):
    pair = correspond(matched(source, target, [0.0], [0.0]), (spacing, spacing), LABELS)
    for drawn, points in ((source, pair.source), (target, pair.target)):
        lengths = arc_lengths(points)
        assert lengths[-1] == pytest.approx(arc_lengths(drawn)[-1])  # in order: no way back
        assert np.diff(lengths).max() <= spacing * (1 + 1e-6)
        assert np.diff(lengths).min() > 0


def test_between_marks_a_vertex_keeps_its_fraction_of_the_arc():
    square = np.array([[0, 0], [4, 0], [4, 4], [0, 4]], dtype=float)
    source = np.insert(square, 1, [1, 0], axis=0)  # a quarter of the way along the first side
    target = np.array([[0, 0], [8, 0], [8, 3], [0, 3]], dtype=float)
    lengths = arc_lengths(source)
    pair = correspond(
        matched(source, target, lengths[[0, 2, 3, 4]], arc_lengths(target)[:4]), (9, 9), LABELS
    )
    index = int(np.flatnonzero((pair.source == [1, 0]).all(axis=1))[0])
    assert np.allclose(pair.target[index], [2, 0])


@pytest.mark.parametrize("count", [41, 47, 61])
def test_vertices_that_nearly_meet_are_joined(count):
    source, target = ellipse(60), ellipse(count)
    pair = correspond(matched(source, target, [0.0], [0.0]), (1, 1), LABELS)
    for points in (pair.source, pair.target):
        step = np.diff(arc_lengths(points))
        assert step.min() > 0.15 * np.diff(arc_lengths(source)).max()


def spike(tip):
    """Return a square with a narrow spike on top, whose tip lies at x = ``tip``."""
    return np.array([[-2, 0], [2, 0], [2, 2], [0.2, 2], [tip, 4], [-0.2, 2], [-2, 2]], dtype=float)


@pytest.mark.parametrize(("spacing", "together"), [(1.0, True), (0.1, False)])
def test_narrow_corners_meet_where_they_are_near_each_other(spacing, together):
    source, target = spike(0), spike(0)
    source[3], target[5] = [0.2, 1.5], [-0.2, 1.5]  # by arc length the tips would miss each other
    marks = [arc_lengths(ring)[:2] for ring in (source, target)]
    pair = correspond(matched(source, target, *marks), (spacing, spacing), LABELS)
    here, there = ((points == [0, 4]).all(axis=1) for points in (pair.source, pair.target))
    assert np.array_equal(here, there) == together


@given(star_shaped(), star_shaped(), st.floats(1e-7, 1), st.floats(0.05, 1))
def test_no_step_is_much_longer_than_the_one_beside_it(source, target, at, spacing):
    source = np.insert(source, 1, (1 - at) * source[0] + at * source[1], axis=0)
    pair = correspond(matched(source, target, [0.0], [0.0]), (spacing, spacing), LABELS)
    for points in (pair.source, pair.target):
        step = np.diff(arc_lengths(points))
        assert (step <= STEEP * 1.001 * np.roll(step, 1)).all()
        assert (step <= STEEP * 1.001 * np.roll(step, -1)).all()


def test_marks_correspond_exactly():
    source, target = ellipse(30), letter_l()
    marks = arc_lengths(source)[[3, 11, 20]], arc_lengths(target)[[0, 2, 4]]
    pair = correspond(matched(source, target, *marks), (0.3, 0.3), LABELS)
    for i, j in ((3, 0), (11, 2), (20, 4)):
        index = int(np.flatnonzero((pair.source == source[i]).all(axis=1))[0])
        assert np.array_equal(pair.target[index], target[j])


def test_marks_in_another_cyclic_order_are_refused_by_name():
    source = ellipse(30)
    with pytest.raises(MarkError, match="another order") as caught:
        correspond(matched(source, source, [0, 1, 2, 3, 4], [0, 3.5, 2, 3, 4]), (1, 1), LABELS)
    assert caught.value.where.marks == (1,)
    assert "mark b" in caught.value.hint


def test_a_whole_turn_of_the_order_is_no_disorder():
    source = ellipse(30)
    correspond(matched(source, source, [0, 1, 2, 3], [2, 3, 0.5, 1]), (1, 1), LABELS)


def test_marks_on_top_of_each_other_are_refused_by_name():
    source = ellipse(30)
    with pytest.raises(MarkError, match="Marks a and c lie on the same point of the target"):
        correspond(matched(source, source, [0, 1, 2], [0, 1, 0]), (1, 1), LABELS)


@pytest.mark.parametrize(
    ("places", "name"),
    [
        ([0, 1, 0], "1 and 3 lie on the same point"),
        ([0, 2, 1, 3], "another order"),
        ([3, 2, 1, 0], "backwards"),
    ],
)
def test_proposals_that_contradict_each_other_are_named_by_their_numbers(places, name):
    source, own = ellipse(30), np.arange(len(places), dtype=float)
    ring = MatchedRing(source, source, own, np.array(places, dtype=float))
    with pytest.raises(MarkError, match=name) as caught:
        correspond(ring, (1, 1), [])
    assert caught.value.where.marks == ()
