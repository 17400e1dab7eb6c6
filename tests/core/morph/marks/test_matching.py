"""Matching is a matter of shape: not of where, how large, or how it happens to be listed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.geometry.polyline import arc_lengths, nearest_length, points_at
from core.morph.marks.rings import match_rings
from tests.core.shapes import comb, ellipse, letter_l, limb, rotation, star_shaped

CLASSES = ["horse", "dog", "bird", "guitar", "key", "camel", "beetle", "hat"]


def images(source, target, points):
    """Where points of the source belong, by the best match that is not mirrored."""
    match = next(m for m in match_rings(source, target) if not m.mirrored)
    at = np.array([nearest_length(source, arc_lengths(source), p)[0] for p in points])
    return points_at(target, arc_lengths(target), match.images(at))


def apart(found, expected, target):
    """The greatest distance, as a fraction of the target's perimeter."""
    return np.abs(found - expected).max() / arc_lengths(target)[-1]


def denser(ring, parts):
    after = np.roll(ring, -1, axis=0)
    return np.concatenate(
        [p + np.arange(parts)[:, None] / parts * (q - p) for p, q in zip(ring, after, strict=True)]
    )


@pytest.fixture(params=CLASSES)
def pair(request, shared_data):
    shapes = np.load(shared_data / "mpeg7_outlines.npz")
    return tuple(shapes[f"{request.param}-{k:02d}"].astype(float) for k in (6, 7))


@pytest.fixture
def reference(pair):
    return images(*pair, pair[0][::3])


def test_it_does_not_matter_where_the_lists_start_or_which_way_they_run(pair, reference):
    source, target = pair
    again = np.roll(source, 17, axis=0), np.roll(target, 58, axis=0)[::-1]
    assert apart(images(*again, source[::3]), reference, target) < 1e-9


def test_place_size_and_turn_of_the_pair_do_not_matter(pair, reference):
    source, target = pair
    turn = 40 * rotation(2.0)
    there = images(source @ turn.T + [300, -5], target @ turn.T, source[::3] @ turn.T + [300, -5])
    assert apart(there @ np.linalg.inv(turn).T, reference, target) < 1e-9


def test_size_and_place_of_either_do_not_matter(pair, reference):
    source, target = pair
    there = images(1e-5 * source, 1e4 * target + 1e5, 1e-5 * source[::3])
    assert apart((there - 1e5) / 1e4, reference, target) < 1e-6


def test_more_vertices_on_the_same_outlines_change_little(pair, reference):
    source, target = pair
    there = images(denser(source, 3), denser(target, 5), source[::3])
    assert apart(there, reference, target) < 0.025


def test_a_small_edit_changes_little(pair, reference):
    source, target = pair
    edited = target.copy()
    edited[10:13] += 0.004 * arc_lengths(target)[-1]
    there = images(source, edited, source[::3])
    assert np.median(np.hypot(*(there - reference).T)) / arc_lengths(target)[-1] < 0.002


def test_an_outline_matches_itself_exactly(pair):
    source, _ = pair
    assert apart(images(source, source, source), source, source) < 1e-9
    assert match_rings(source, source)[0].cost < 1e-6


@given(star_shaped(least=7), st.floats(-3, 3), st.floats(0.01, 100), st.integers(0, 23))
@settings(max_examples=25, deadline=None)
def test_a_similar_copy_matches_its_original(ring, angle, size, start):
    copy = size * np.roll(ring, start, axis=0) @ rotation(angle).T + [3, -2]
    best = match_rings(ring, copy)[0]
    found = points_at(copy, arc_lengths(copy), best.images(arc_lengths(ring)[:-1]))
    expected = size * ring @ rotation(angle).T + [3, -2]
    assert best.cost < 1e-3  # symmetric shapes match in several ways
    if not np.allclose(found, expected, atol=1e-3 * arc_lengths(copy)[-1]):
        assert sum(match.cost < 2e-2 for match in match_rings(ring, copy)) > 1


@given(star_shaped(), star_shaped())
@settings(max_examples=25, deadline=None)
def test_every_match_runs_once_around_both_rings(source, target):
    for match in match_rings(source, target):
        route = match.route.match
        for side in (route.source, route.target):
            assert (np.diff(side) > 0).all()
            assert side[-1] - side[0] == pytest.approx(1)


@given(star_shaped(least=8))
@settings(max_examples=25, deadline=None)
def test_a_mirrored_copy_is_found_as_a_mirror(ring):
    matches = match_rings(ring, ring * [-1, 1])
    plain = min(match.cost for match in matches if not match.mirrored)
    if plain > 0.1:  # else the shape is much like its own mirror image
        assert matches[0].mirrored
        assert matches[0].cost < 0.02


def test_a_mirrored_copy_is_matched_vertex_by_vertex():
    mirror = letter_l() * [-1, 1]
    best = match_rings(letter_l(), mirror)[0]
    found = points_at(mirror, arc_lengths(mirror), best.images(arc_lengths(letter_l())[:-1]))
    assert best.mirrored
    assert found == pytest.approx(mirror)


@pytest.mark.parametrize("bend", [0.8, 1.6, 2.5, 3.5])
def test_a_limb_that_bends_is_matched_end_to_end(bend):
    straight, bent = limb(0.0, 24), limb(bend, 24)
    ends = [0, 23, 24, 47]
    found = images(straight, bent, straight[ends])
    turned = np.roll(bent[ends], 2, axis=0)  # a bar has two ends
    assert min(apart(found, bent[ends], bent), apart(found, turned, bent)) < 1e-9


def test_a_slit_that_one_shape_lacks_does_not_shift_the_rest():
    square = np.array([[0, 0], [4, 0], [4, 4], [0, 4]], dtype=float)
    slit = np.array([[0, 0], [1.8, 0], [1.9, 2], [2, 0], [4, 0], [4, 4], [0, 4]], dtype=float)
    assert apart(images(square, slit, square), square, slit) < 1e-9


def test_where_nothing_tells_the_shape_stays_upright():
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
    circle = np.roll(ellipse(80, 1, 1), 23, axis=0)
    corners = images(square, circle, square)
    assert apart(corners, square / np.sqrt(2), circle) < 0.02


@pytest.mark.parametrize("fixed", [[(0.0, 0.7)], [(0.4, 0.7), (3.1, 3.0), (9.0, 11.0)]])
def test_fixed_pairs_stay_together(fixed):
    source, target = comb(3), letter_l()
    fixed = [(s * arc_lengths(source)[-1] / 16, t) for s, t in fixed]
    for match in match_rings(source, target, fixed):
        s, t = np.array(fixed).T
        assert match.images(s) == pytest.approx(t)
        assert not match.mirrored


def test_a_fixed_pair_can_overrule_the_shape():
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
    turned = match_rings(square, square, [(0.0, 2.0)])[0]
    assert turned.images(np.array([0.0, 2, 4, 6])) == pytest.approx([2, 4, 6, 0])


def test_a_known_rotation_decides_between_equals():
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
    for quarter in range(4):
        match = match_rings(square, square, rotation=1j**quarter)[0]
        there = match.images(np.array([0.0, 2, 4, 6]))
        assert there == pytest.approx((np.array([0, 2, 4, 6]) + 2 * quarter) % 8)


@pytest.mark.parametrize(
    "ring",
    [
        np.zeros((0, 2)),
        np.zeros((5, 2)),
        np.array([[0.0, 0], [1, 0]]),
        np.array([[0.0, 0], [1, 0], [2, 0]]),
        np.array([[0.0, 0], [1, 0], [np.nan, 1]]),
        np.array([[0.0, 0], [1, 1], [1, 0], [0, 1]]),
    ],
    ids=["nothing", "a point", "two points", "a line", "not a number", "a bow without area"],
)
def test_rings_that_enclose_nothing_have_no_match(ring):
    assert match_rings(ring, letter_l()) == []
    assert match_rings(letter_l(), ring) == []


def test_among_the_matches_of_a_flower_is_the_one_that_does_not_turn_it():
    petals, angle = 7, np.linspace(0, 2 * np.pi, 180, endpoint=False)
    longer = [np.cos(angle - 2 * np.pi * k / petals) for k in (0, 3)]  # not the same petals
    radii = [1 + 0.35 * np.cos(petals * angle) + 0.08 * side for side in longer]
    rings = [np.column_stack([r * np.cos(angle), r * np.sin(angle)]) for r in radii]
    lengths = [arc_lengths(ring)[-1] for ring in rings]
    at = np.arange(50) / 50
    off = [
        np.mod(match.images(at * lengths[0]) / lengths[1] - at + 0.5, 1) - 0.5
        for match in match_rings(*rings)
        if not match.mirrored
    ]
    assert min(np.abs(each).max() for each in off) < 0.5 / petals
