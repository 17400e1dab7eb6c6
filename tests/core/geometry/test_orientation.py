"""The exact sign of a triangle's area."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.orientation import orientations

ONE = np.array([[0, 1, 2]])
number = st.one_of(
    st.floats(-1e9, 1e9),
    st.integers(-4, 4).map(float),
    st.integers(-3, 3).map(lambda k: 0.1 + k * 2.0**-55),
    st.floats(-1e-200, 1e-200),
)


@given(st.lists(number, min_size=6, max_size=6))
def test_it_is_the_sign_of_the_determinant_in_rational_numbers(numbers: list[float]) -> None:
    ax, ay, bx, by, cx, cy = map(Fraction, numbers)
    exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    found = orientations(np.reshape(numbers, (3, 2)), ONE)
    assert found.tolist() == [(exact > 0) - (exact < 0)]


def test_points_of_a_line_that_floats_cannot_tell_are_told_apart() -> None:
    step = 2.0**-53
    points = np.array([[0.5, 0.5], [12, 12], [24, 24], [0.5, 0.5 + step], [0.5, 0.5 - step]])
    triangles = np.array([[0, 1, 2], [3, 1, 2], [4, 1, 2], [4, 2, 1]])
    assert orientations(points, triangles).tolist() == [0, 1, -1, 1]


def test_a_triangle_whose_corners_are_no_numbers_has_no_orientation() -> None:
    points = np.array([[0, 0], [1, 0], [0, np.nan], [np.inf, 1], [0, 1]])
    triangles = np.array([[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    assert orientations(points, triangles).tolist() == [0, 0, 1]
