"""Suggested marks: right at the first try, few, at corners, and between those that are set."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.geometry.places import measured
from core.geometry.polyline import arc_lengths
from core.model import Outline, RingPoint
from core.model.outline import Ring
from core.morph.marks.rings import match_rings, mirror_is_better
from core.morph.pipeline import solve_outlines
from core.morph.suggest import match_outlines, mate, snap
from tests.core.shapes import comb, ellipse, letter_l, limb, rotation, star_shaped

SEEN = {
    # vertices that a person looking at both pictures would pair: muzzle, ears, hooves, tail …
    ("horse", 0): [(95, 82), (0, 87), (18, 1), (28, 13), (47, 30), (60, 43), (72, 60)],
    ("dog", 6): [(0, 0), (14, 17), (22, 22), (26, 28), (38, 40), (65, 61), (69, 65)],
    ("guitar", 0): [(0, 0), (17, 19), (31, 32), (77, 78), (96, 97)],
    ("guitar", 4): [(23, 78), (75, 41), (95, 60)],
}


@pytest.fixture(scope="module")
def real(shared_data):
    """Real shapes by class and number."""
    shapes = np.load(shared_data / "mpeg7_outlines.npz")
    return lambda name, number: shapes[f"{name}-{number:02d}"].astype(float)


def turns(values):
    """How often a cyclic sequence falls."""
    return int(np.sum(np.roll(values, -1) <= values))


def best(source, target, fixed=()):
    """The best match that is not mirrored."""
    return next(match for match in match_rings(source, target, fixed) if not match.mirrored)


# -- what belongs together -----------------------------------------------------------------------


@pytest.mark.parametrize("case", SEEN, ids=lambda case: f"{case[0]}-{case[1]:02d}")
def test_a_click_proposes_what_the_eye_sees(real, case):
    name, number = case
    source, target = (Outline.polygon(real(name, k)) for k in (number, number + 1))
    for vertex, expected in SEEN[case]:
        at = mate(source, target, RingPoint(0, float(vertex))).at
        assert abs((at - expected + 50) % 100 - 50) <= 2.5


def test_the_corners_of_a_shape_are_mated_with_themselves():
    shape = Outline.polygon(letter_l())
    assert [mate(shape, shape, RingPoint(0, float(k))).at for k in range(6)] == [*range(6)]


def test_a_mirror_is_offered_for_a_mirrored_shape_only():
    assert mirror_is_better(match_rings(letter_l(), letter_l() * [-1, 1]))
    for ring in (letter_l(), limb(1.0), comb(4), ellipse(60)):
        assert not mirror_is_better(match_rings(ring, ring @ rotation(1.0).T))


@pytest.mark.parametrize("name", ["horse", "bird", "crown", "teddy", "watch"])
def test_real_shapes_map_without_folds_and_with_little_distortion(real, name):
    ends = Outline.polygon(real(name, 8)), Outline.polygon(real(name, 9))
    proposed = match_outlines(*ends).proposals()
    report = solve_outlines(*ends, [(a, b) for a, b, _ in proposed]).report
    assert not report.folds_target
    assert report.distortion_mean < 1.5


# -- the marks ------------------------------------------------------------------------------------


@given(star_shaped(), star_shaped())
@settings(max_examples=20, deadline=None)
def test_marks_run_in_the_same_order_around_both(source, target):
    for match in match_rings(source, target):
        here, there, confidence = match.marks()
        there = there[::-1] if match.mirrored else there
        assert (np.diff(here) > 0).all()
        assert len(there) == 1 or turns(there) == 1
        assert ((confidence >= 0) & (confidence <= 1)).all()


def test_matches_differ_and_the_best_is_first(real):
    found = match_rings(real("flower6", 0), real("flower6", 1))
    assert len(found) > 1
    assert found[0].cost <= min(match.cost for match in found) + 0.02
    there = [float(match.images(np.zeros(1))[0]) for match in found]
    assert all(a != b for a, b in pairwise(there))


def test_marks_lie_on_corners_where_both_have_them():
    stretched = letter_l() * [2, 1]
    marks = match_outlines(Outline.polygon(letter_l()), Outline.polygon(stretched)).proposals()
    corners = [(a.at, b.at) for a, b, confidence in marks if confidence > 0.5]
    assert len(corners) >= 4
    assert all(a == b == int(a) for a, b in corners)


def test_corners_are_surer_than_smooth_arcs():
    _, _, corners = best(letter_l(), letter_l()).marks()
    _, _, arcs = best(ellipse(80, 1, 1), ellipse(60, 1, 1)).marks()
    assert corners.max() > 0.8
    assert arcs.max() < 0.1


def test_few_marks_suffice_where_lengths_tell_the_rest():
    here, _, _ = best(letter_l(), 3 * letter_l()).marks()
    assert len(here) == 1


def test_an_edge_that_takes_another_share_of_the_length_gets_marks_at_its_ends():
    longer = letter_l() + np.array([[0, 0]] * 4 + [[0, 4]] * 2)
    marks = match_outlines(Outline.polygon(letter_l()), Outline.polygon(longer)).proposals()
    assert {3.0, 4.0, 5.0} <= {a.at for a, b, _ in marks if a.at == b.at}


# -- between marks that are set -------------------------------------------------------------------


@given(star_shaped(), star_shaped(), st.sets(st.integers(0, 39), min_size=1, max_size=4))
@settings(max_examples=20, deadline=None)
def test_marks_that_are_set_are_kept_and_never_crossed(source, target, shares):
    lengths = arc_lengths(source)[-1], arc_lengths(target)[-1]
    fixed = [(k / 40 * lengths[0], (0.02 * k + 0.1) * lengths[1]) for k in shares]
    for match in match_rings(source, target, fixed):
        here, there, _ = match.marks()
        marks = sorted([*fixed, *zip(here, there, strict=True)])
        assert not match.mirrored
        assert len(marks) == 1 or turns(np.array(marks)[:, 1]) == 1
        assert len({s for s, _ in marks}) == len(marks)


def test_a_mate_keeps_between_its_neighbours_even_against_the_shape():
    shape = Outline.polygon(letter_l())
    marks = [(RingPoint(0, 0.5), RingPoint(0, 2.5)), (RingPoint(0, 2.5), RingPoint(0, 4.5))]
    at = mate(shape, shape, RingPoint(0, 1.0), marks).at
    assert 2.5 < at < 4.5


def test_a_mark_that_contradicts_earlier_ones_is_passed_over():
    marks = [(0.0, 0.0), (5.0, 5.0), (6.0, 3.0)]
    assert best(letter_l(), letter_l(), marks).cost == pytest.approx(
        best(letter_l(), letter_l(), marks[:2]).cost
    )


def test_accepted_marks_do_not_change_the_others(real):
    ends = Outline.polygon(real("dog", 6)), Outline.polygon(real("dog", 7))
    found = match_outlines(*ends).proposals()
    accepted = [(a, b) for a, b, _ in found[::2]]
    others = match_outlines(*ends, accepted).proposals()
    assert {(a, b) for a, b, _ in others} <= {(a, b) for a, b, _ in found}


# -- whole outlines -------------------------------------------------------------------------------


def test_holes_get_marks_on_the_holes_that_lie_where_they_do():
    holes = [0.3 * letter_l() / 5 + at for at in ([0.3, 0.3], [2.2, 0.4], [0.3, 3.9])]
    turned = [ring @ rotation(1.0).T for ring in (letter_l(), *holes)]
    source = Outline.polygon(letter_l(), *holes)
    target = Outline.polygon(turned[0], turned[3], turned[1], turned[2])
    assert {(a.ring, b.ring) for a, b, _ in match_outlines(source, target).proposals()} == {
        (0, 0),
        (1, 2),
        (2, 3),
        (3, 1),
    }
    for k in range(6):
        assert mate(source, target, RingPoint(2, float(k))) == RingPoint(3, float(k))


def test_round_holes_turn_with_the_shape():
    hole = 0.3 * ellipse(40, 1, 1) + [0.5, 0.5]
    source = Outline.polygon(letter_l(), hole)
    target = Outline.polygon(letter_l() @ rotation(1.2).T, np.roll(hole @ rotation(1.2).T, 7, 0))
    for k in (0, 11, 30):
        assert mate(source, target, RingPoint(1, float(k))).at == pytest.approx(
            (k + 7) % 40, abs=0.6
        )


def test_curves_and_either_direction_will_do():
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    curved = Ring(square, np.full((4, 2), 0.0), 0.2 * (np.roll(square, -1, 0) - square))
    source, target = Outline((curved,)), Outline((curved.reversed(),))
    for k in range(4):
        assert mate(source, target, RingPoint(0, float(k))).at == (4 - k) % 4


def test_a_click_on_what_encloses_nothing_still_has_an_answer():
    line, shape = Outline.polygon([[0, 0], [1, 0], [2, 0]]), Outline.polygon(letter_l())
    for source, target in ((line, shape), (shape, line)):
        assert match_outlines(source, target).proposals() == []
        place = mate(source, target, RingPoint(0, 1.0))
        assert 0 <= place.at < measured(target)[0].nodes


def test_a_place_snaps_to_the_node_within_reach():
    shape = Outline.polygon(letter_l())
    assert snap(shape, RingPoint(0, 0.9), 0.5) == RingPoint(0, 1.0)
    assert snap(shape, RingPoint(0, 0.5), 0.5) == RingPoint(0, 0.5)
