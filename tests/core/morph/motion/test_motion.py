"""The laws of the in-betweens, on solved morphs."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import core
from core.model import Turning
from core.morph.certificate import Certificate
from core.morph.motion.motion import Motion
from tests.core.shapes import ellipse, letter_l, limb, rotation, star_shaped

TIMES = [0.1, 0.25, 0.5, 0.8, 0.95]
STRAIGHT = Turning(path="straight")


def size(points):
    return np.hypot(*np.ptp(points, axis=0))


GROWTH = {
    "arap": lambda t, k: k**t,
    "plain arap": lambda t, k: 1 - t + t * k,
    "intrinsic": lambda t, k: 1 - t + t * k,
}


@pytest.mark.parametrize("method", GROWTH)
@settings(max_examples=25, deadline=None)
@given(star_shaped(), st.floats(-3, 3), st.floats(0.3, 3), st.floats(-50, 50))
def test_a_similarity_is_reproduced_at_every_t(method, points, angle, scale, shift):
    M = scale * rotation(angle)
    target = points @ M.T + shift
    marks = [(0, 0), (2, 2)]
    morph = core.solve(points, target, marks, recipe=core.Recipe(method=method)).along(STRAIGHT)
    centre = morph.at(0.0).T @ _mass(morph)
    goal = M @ centre + shift
    for t in TIMES:
        blend = rotation(t * angle) * GROWTH[method](t, scale)
        expected = (morph.rest - centre) @ blend.T + (1 - t) * centre + t * goal
        assert np.abs(morph.at(t) - expected).max() < 1e-9 * (size(target) + size(points) + 50)


def _mass(morph):
    """Each vertex's share of the area at rest."""
    corners = morph.rest[morph.triangles]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    mass = np.bincount(morph.triangles.ravel(), np.repeat(area, 3), len(morph.rest))
    return mass / mass.sum()


@pytest.mark.parametrize("method", ["arap", "plain arap", "linear", "intrinsic"])
def test_both_ends_are_exactly_what_was_drawn(method):
    source, target = limb(0.0) + 300, limb(2.5, n=11) * 7 - 40
    morph = core.solve(source, target, [(0, 0), (15, 10)], recipe=core.Recipe(method=method))
    for end, s, drawn in ((morph.rest, 0.0, source), (morph.target, 1.0, target)):
        assert np.array_equal(morph.at(s), end)
        assert {tuple(p) for p in drawn} <= {tuple(p) for p in end}
        near = morph.at(abs(s - 1e-12))  # and the frames run into them without a jump
        assert np.abs(near - end).max() < 1e-9 * size(end)


def test_a_half_turn_keeps_its_area_where_straight_paths_collapse():
    source = letter_l()
    target = source @ rotation(3.0).T
    rigid, straight = (
        core.solve(source, target, [(0, 0), (2, 2)], recipe=core.Recipe(method=method))
        for method in ("arap", "linear")
    )
    areas = [_area(morph.at(0.5)[morph.rings[0]]) for morph in (rigid, straight)]
    assert areas[0] == pytest.approx(7, rel=1e-6)
    assert areas[1] < 0.2


def _area(points):
    from core.geometry.polyline import signed_area

    return signed_area(points)


def test_a_limb_bends_through_arcs_and_keeps_its_length():
    morph = core.solve(limb(0.0), limb(2.6), [(0, 0), (15, 15), (16, 16), (31, 31)])
    from core.geometry.polyline import arc_lengths

    lengths = [arc_lengths(morph.at(t)[morph.rings[0]])[-1] for t in np.linspace(0, 1, 9)]
    assert max(lengths) / min(lengths) < 1.03


@pytest.mark.parametrize("shift", [1, 7, 20])
def test_another_start_vertex_gives_the_same_frames(shift):
    source, target = limb(0.3), limb(2.2, n=13)
    first = core.solve(source, target, [(0, 0), (15, 12), (31, 25)])
    rolled = np.roll(source, -shift, axis=0)
    marks = [((i - shift) % len(source), j) for i, j in ((0, 0), (15, 12), (31, 25))]
    second = core.solve(rolled, target, marks)
    for t in TIMES:
        a, b = (m.at(t)[m.rings[0]] for m in (first, second))
        assert np.abs(a - b).max() < 1e-7 * size(source)


def test_without_marks_the_start_vertex_does_not_matter_either():
    source, target = letter_l(), letter_l() * [1.2, 0.9] @ rotation(0.6).T
    first = core.solve(source, target)
    second = core.solve(np.roll(source, 2, axis=0), np.roll(target, -1, axis=0)[::-1])
    for t in TIMES:
        a, b = (m.at(t)[m.rings[0]] for m in (first, second))
        assert np.abs(a - b).max() < 1e-7 * size(source)


def test_frames_do_not_depend_on_the_order_they_are_asked_in():
    morph = core.solve(ellipse(), letter_l())
    forward = [morph.at(t) for t in TIMES]
    backward = [morph.at(t) for t in reversed(TIMES)][::-1]
    assert all(np.array_equal(a, b) for a, b in zip(forward, backward, strict=True))


def test_where_a_shape_is_drawn_and_how_large_changes_nothing_but_that():
    source, target = limb(0.0), limb(2.0)
    near = core.solve(source, target, [(0, 0), (16, 16)])
    far = core.solve(source * 1e-6 + 1e-3, target * 1e-6 + 1e-3, [(0, 0), (16, 16)])
    for t in TIMES:
        a, b = (m.at(t)[m.rings[0]] for m in (near, far))
        assert np.abs((b - 1e-3) * 1e6 - a).max() < 1e-6


@pytest.mark.filterwarnings("error")
def test_a_triangle_that_is_barely_one_has_frames():
    rest = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    target = np.array([[0, 0], [1, 0.1], [3, 0.3 + 4e-16], [0, 1]])
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    assert Certificate.of(triangles, (np.arange(4),), rest, target).holds
    assert np.isfinite(Motion.of("arap", (rest, target), triangles)(0.5)).all()
