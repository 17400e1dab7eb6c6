"""How shapes turn and travel as a whole."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import core
from core.fem.elements import Elements
from core.geometry.rotation import turn_and_mirror
from core.geometry.triangulation import adjacent_triangles
from core.model import Turning
from core.morph.motion.motion import Motion
from core.morph.quality import folds
from tests.core.morph.motion.test_guard import poor_map
from tests.core.shapes import letter_l, limb, rotation

TIMES = np.linspace(0, 1, 33)
ALL_MARKS = [(i, i) for i in range(6)]


def turned(angle: float, scale: float = 1.0, about: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Return the L turned and scaled about a point; its mean rotation is the angle."""
    return (letter_l() - about) @ (scale * rotation(angle)).T + about


def spun(points: np.ndarray, centre: np.ndarray, angle: float) -> np.ndarray:
    return (points - centre) @ rotation(angle).T + centre


def heading(frame: np.ndarray) -> complex:
    """Return where a rigid frame points."""
    return complex(*(frame[1] - frame[0]))


def angles(morph: core.Morph, times: np.ndarray = TIMES) -> np.ndarray:
    """Return how far a rigid motion has turned at each time, followed from frame to frame."""
    return np.unwrap([np.angle(heading(morph.at(t)) / heading(morph.rest)) for t in times])


@settings(max_examples=20, deadline=None)
@given(st.floats(-3, 3), st.floats(0.4, 2.5), st.floats(-60, 60), st.floats(-60, 60))
def test_a_shape_that_turns_and_grows_about_a_far_point_goes_round_it(angle, scale, x, y):
    pole = np.array([x, y])
    morph = core.solve(letter_l(), turned(angle, scale, (x, y)), ALL_MARKS)
    for t in TIMES:
        expected = (morph.rest - pole) @ (scale**t * rotation(t * angle)).T + pole
        assert np.abs(morph.at(t) - expected).max() < 1e-8 * (100 + abs(x) + abs(y))


def test_the_centre_runs_straight_and_evenly_where_that_is_chosen():
    morph = core.solve(letter_l(), turned(1.5, 2.0, (40, 10)), ALL_MARKS)
    morph = morph.along(Turning(path="straight"))
    centres = np.array([morph.inbetween.course.mass @ morph.at(t) for t in TIMES])
    even = np.outer(1 - TIMES, centres[0]) + np.outer(TIMES, centres[-1])
    assert np.abs(centres - even).max() < 1e-9


def test_a_shape_that_neither_turns_nor_grows_runs_straight():
    morph = core.solve(letter_l(), letter_l() + np.array([50, 20]), ALL_MARKS)
    for t in TIMES:
        assert np.allclose(morph.at(t), morph.rest + t * np.array([50, 20]), atol=1e-9)


@pytest.mark.parametrize("path", ["arc", "straight"])
@pytest.mark.parametrize("turns", [0, 1, 3])
@pytest.mark.parametrize("angle", [0.0, 1.0, 2.5, -2.0])
def test_a_shape_turns_as_often_and_the_way_it_is_told(path, turns, angle):
    morph = core.solve(letter_l(), turned(angle) + np.array([9, 0]), ALL_MARKS)
    clockwise = angles(morph.along(Turning("clockwise", turns, path)), np.linspace(0, 1, 99))
    back = angles(morph.along(Turning("counter-clockwise", turns, path)), np.linspace(0, 1, 99))
    assert clockwise[-1] == pytest.approx(angle % (2 * np.pi) + 2 * np.pi * turns)
    assert back[-1] == pytest.approx(-(-angle % (2 * np.pi)) - 2 * np.pi * turns)
    for way in (clockwise, back):
        assert np.diff(way) == pytest.approx(way[-1] / 98)  # evenly


def test_clockwise_is_clockwise_on_a_screen_whose_y_points_down():
    morph = core.solve(letter_l(), letter_l(), ALL_MARKS).along(Turning("clockwise", 1))
    right = int(np.argmax(morph.rest[:, 0]))
    assert morph.at(0.1)[right, 1] > morph.rest[right, 1] + 0.5  # what is right goes down


@pytest.mark.parametrize("turning", [Turning("clockwise", 2), Turning("counter-clockwise", 1)])
def test_guarded_frames_with_turns_are_the_guarded_frames_turned(turning):
    rest, target, triangles = poor_map()
    plain = Motion.of("arap", (rest, target), triangles, Turning(path="straight"))
    turning = Turning(turning.direction, turning.turns, "straight")
    whole = 2 * np.pi * round((plain.along(turning).course.angle - plain.course.angle) / 2 / np.pi)
    assert whole
    for t in TIMES:
        frame = plain(t)
        expected = spun(frame, plain.course.mass @ frame, t * whole)
        assert np.abs(plain.along(turning)(t) - expected).max() < 1e-12
        assert not len(folds(plain.along(turning)(t), triangles))


@pytest.mark.parametrize("turning", [Turning("clockwise", 5), Turning("counter-clockwise", 0)])
def test_both_ends_are_exact_however_a_shape_turns(turning):
    morph = core.solve(limb(0.0), limb(2.0) + 30, [(0, 0), (16, 16)]).along(turning)
    for t, end in ((0, morph.rest), (1, morph.target)):
        assert np.array_equal(morph.at(t), end)
        assert np.allclose(morph.at(abs(t - 1e-12)), end, atol=1e-8)


def test_straight_vertex_paths_stay_straight_however_they_are_told_to_turn():
    recipe = core.Recipe(method="linear")
    morph = core.solve(letter_l(), turned(1.0, 2.0, (30, 0)), ALL_MARKS, recipe=recipe)
    for turning in (Turning(), Turning("clockwise", 3)):
        frame = morph.along(turning).at(0.25)
        assert np.allclose(frame, 0.75 * morph.rest + 0.25 * morph.target)


def test_a_limb_that_bends_stays_where_it_hangs_better_on_an_arc():
    n = 16
    marks = [(0, 0), (n - 1, n - 1), (n, n), (2 * n - 1, 2 * n - 1)]
    morph = core.solve(limb(0.0, n), limb(1.2, n), marks)
    joint = [int(np.argmin(np.hypot(*(morph.rest - limb(0.0, n)[i]).T))) for i in (0, -1)]

    def drift(path):
        frames = [morph.along(Turning(path=path)).at(t)[joint].mean(axis=0) for t in TIMES]
        return np.abs(np.array(frames) - morph.rest[joint].mean(axis=0)).max()

    assert drift("arc") < 0.1 * drift("straight")


@pytest.mark.parametrize("turns", [0, 1])
def test_every_triangle_turns_as_far_as_its_neighbours_let_it_without_a_fold(turns):
    """Followed from frame to frame, each has turned by its unwrapped angle, and whole turns."""
    morph = core.solve(limb(0.0, 24), limb(5.0, 24, curl=2.0), [(0, 0), (23, 23), (24, 24)])
    morph = morph.along(Turning("clockwise", turns))
    elements = Elements.of(morph.rest, morph.triangles)
    frames = (morph.at(t) for t in np.linspace(0, 1, 65))
    angles = [np.angle(turn_and_mirror(elements.deformation_gradients(x))[0]) for x in frames]
    followed = np.unwrap(angles, axis=0)
    assert followed[-1] - followed[0] == pytest.approx(morph.inbetween.angles, abs=1e-6)
    i, j = adjacent_triangles(morph.triangles).T
    assert np.abs(followed[:, i] - followed[:, j]).max() < np.pi
