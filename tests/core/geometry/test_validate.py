import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Polygon

from core.errors import OutlineError
from core.geometry.polyline import signed_area
from core.geometry.validate import clean
from tests.core.shapes import ellipse, letter_l, square_ring, star_shaped


@given(star_shaped(), st.booleans())
def test_what_comes_out_is_simple_and_positively_oriented(points, backwards):
    result = clean([points[::-1] if backwards else points], "source")
    (ring,) = result.rings
    assert Polygon(ring).is_valid
    assert signed_area(ring) > 0
    assert result.repairs == ()
    assert {tuple(p) for p in ring} == {tuple(p) for p in points}


def test_holes_run_against_the_exterior():
    exterior, hole = clean(square_ring(), "source").rings
    assert signed_area(exterior) > 0 > signed_area(hole)


def test_repeated_points_are_dropped_and_reported():
    result = clean([np.repeat(letter_l(), 2, axis=0)], "source")
    assert np.array_equal(result.rings[0], letter_l())
    assert result.repairs == ("source outline: 6 repeated points dropped",)


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_a_number_that_is_not_finite_is_refused_with_its_node(number):
    points = letter_l()
    points[4, 1] = number
    with pytest.raises(OutlineError, match="Node 4 of the target outline") as caught:
        clean([points], "target")
    assert (caught.value.where.side, caught.value.where.node) == ("target", 4)


@pytest.mark.parametrize("scale", [1e200, 1e-200])
def test_a_size_beyond_what_can_be_computed_is_refused(scale):
    with pytest.raises(OutlineError, match="wide"):
        clean([scale * letter_l()], "source")


@pytest.mark.parametrize("points", [[], [[1, 2]], [[0, 0], [1, 1]], [[0, 0], [1, 1], [0, 0]]])
def test_fewer_than_three_distinct_points_are_refused(points):
    with pytest.raises(OutlineError):
        clean([np.array(points, dtype=float).reshape(-1, 2)], "source")


def test_points_on_a_line_enclose_nothing():
    with pytest.raises(OutlineError, match="encloses no area"):
        clean([np.array([[0, 0], [1, 1], [2, 2], [3, 3]])], "source")


def test_a_bow_tie_is_refused_where_it_crosses():
    with pytest.raises(OutlineError, match="crosses itself") as caught:
        clean([np.array([[0, 0], [2, 2], [2, 0], [0, 2]])], "source")
    assert caught.value.where.point == pytest.approx((1, 1))


def test_a_small_loop_is_cut_off_and_reported():
    points = np.vstack([ellipse(60), [[2.05, 0.02], [2.05, -0.02]]])[::1]
    points = np.vstack([ellipse(60)[:30], [[-2.02, -0.02], [-2.02, 0.02]], ellipse(60)[30:]])
    result = clean([points], "source")
    assert Polygon(result.rings[0]).is_valid
    assert "cut off" in result.repairs[0]
    assert result.area == pytest.approx(signed_area(ellipse(60)), rel=0.01)


def test_a_hole_outside_is_refused():
    square, hole = square_ring()
    with pytest.raises(OutlineError, match="rings"):
        clean([square, hole + 10], "source")


@pytest.mark.parametrize("order", [1, -1])
def test_a_repair_leaves_the_holes_in_their_order(order):
    loop = [[0.1, 10], [-0.1, 10.3], [0.1, 10.3], [-0.1, 10]]
    square = [[-10, -10], [10, -10], [10, 10], *loop, [-10, 10]]
    holes = [ellipse() - np.array([5, 0]), ellipse() + np.array([5, 0])][::order]
    result = clean([np.array(square), *holes], "source")
    assert result.repairs
    for ring, hole in zip(result.rings[1:], holes, strict=True):
        assert ring.mean(axis=0) == pytest.approx(hole.mean(axis=0))


def test_lines_drawn_to_and_fro_are_refused():
    with pytest.raises(OutlineError, match="crosses itself"):
        clean([np.array([[1, 3], [2, 3], [1, 1], [3, 0], [1, 1], [2, 3]])], "source")
