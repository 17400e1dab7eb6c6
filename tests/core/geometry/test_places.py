import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.places import nearest_place, tracks
from core.model import Outline
from tests.core.geometry.test_flatten import circle
from tests.core.shapes import square_ring, star_shaped


@given(star_shaped(), st.floats(0, 0.999))
def test_place_to_arc_length_and_back_is_the_same_place(points, fraction):
    (track,) = tracks(Outline.polygon(points))
    at = fraction * len(points)
    assert track.place_of(track.length_of(at)) == pytest.approx(at, abs=1e-9)


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
