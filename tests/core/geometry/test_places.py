import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.places import measured, nearest_place
from core.model import Outline
from tests.core.geometry.test_flatten import circle
from tests.core.shapes import square_ring, star_shaped


@given(star_shaped(), st.floats(0, 0.999))
def test_place_to_arc_length_and_back_is_the_same_place(points, fraction):
    (measure,) = measured(Outline.polygon(points))
    at = fraction * len(points)
    assert measure.place_of(measure.length_of(at)) == pytest.approx(at, abs=1e-9)


def test_the_nearest_place_is_on_the_ring_that_is_closer():
    outline = Outline.polygon(*square_ring())
    assert nearest_place(outline, (1.1, 0))[0].ring == 1
    place, distance = nearest_place(outline, (1.9, 0))
    assert (place.ring, distance) == (0, pytest.approx(0.1))


def test_the_nearest_place_on_a_curve_lies_on_the_curve():
    outline = Outline((circle(),))
    place, distance = nearest_place(outline, (3, 3))
    assert np.allclose(outline.position(place), np.sqrt(0.5), atol=1e-3)
    assert distance == pytest.approx(np.hypot(3, 3) - 1, abs=1e-3)


@pytest.mark.parametrize("place", [(0.0, 0.0), (7.0, -2.0)])
def test_all_places_of_a_ring_drawn_into_one_point_are_that_point(place):
    outline = Outline.polygon([place] * 4)
    (measure,) = measured(outline)
    found, distance = nearest_place(outline, (place[0] + 3, place[1] + 4))
    assert tuple(outline.position(found)) == place
    assert distance == 5
    assert measure.place_of(measure.length_of(2.0) + 9) in range(4)
    assert tuple(measure.point_at(1.5)) == place
