import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.polyline import (
    arc_lengths,
    inner_angles,
    nearest_length,
    points_at,
    resample,
    signed_area,
)
from tests.core.shapes import ellipse, letter_l, star_shaped


def test_area_is_positive_when_x_turns_towards_y_and_negative_backwards():
    assert signed_area(letter_l()) == pytest.approx(7)
    assert signed_area(letter_l()[::-1]) == pytest.approx(-7)


def test_area_does_not_suffer_far_from_the_origin():
    assert signed_area(letter_l() + 1e9) == pytest.approx(7, rel=1e-6)


def test_the_inner_angles_of_an_l_are_right_but_one_is_reflex():
    assert np.degrees(inner_angles(letter_l())) == pytest.approx([90, 90, 90, 270, 90, 90])


@given(star_shaped())
def test_inner_angles_sum_up_to_half_a_turn_for_each_vertex_but_two(points):
    assert inner_angles(points).sum() == pytest.approx((len(points) - 2) * np.pi)


@given(star_shaped())
def test_a_vertex_arc_length_gives_that_vertex_to_the_last_bit(points):
    lengths = arc_lengths(points)
    assert np.array_equal(points_at(points, lengths, lengths[:-1]), points)


@given(star_shaped(), st.floats(0, 1))
def test_the_nearest_place_to_a_point_of_the_outline_is_that_point(points, fraction):
    lengths = arc_lengths(points)
    at = fraction * lengths[-1]
    point = points_at(points, lengths, np.array([at]))[0]
    found, distance = nearest_length(points, lengths, point)
    assert distance < 1e-12
    assert np.allclose(points_at(points, lengths, np.array([found]))[0], point, atol=1e-12)


def test_resampling_a_round_shape_keeps_its_area():
    assert signed_area(resample(ellipse(400), 300)) == pytest.approx(2 * np.pi, rel=1e-3)
