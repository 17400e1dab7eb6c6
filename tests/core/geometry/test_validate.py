import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Polygon

from core.errors import OutlineError
from core.geometry.extent import check_together
from core.geometry.polyline import arc_lengths, points_at, signed_area
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
    (repair,) = result.repairs
    assert str(repair) == "The source outline has 6 repeated points: left out."
    assert repair.moved == 0


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


@pytest.mark.parametrize("size", [1.0, 0.999])
def test_a_hole_that_takes_up_all_of_the_outline_leaves_nothing(size):
    exterior, _ = square_ring()
    hole = exterior * [1, size]
    with pytest.raises(OutlineError, match="encloses no area"):
        clean([exterior, hole], "source")


def test_points_on_a_line_enclose_nothing():
    with pytest.raises(OutlineError, match="encloses no area"):
        clean([np.array([[0, 0], [1, 1], [2, 2], [3, 3]])], "source")


def test_a_bow_tie_is_refused_where_it_crosses():
    with pytest.raises(OutlineError, match="crosses itself") as caught:
        clean([np.array([[0, 0], [2, 2], [2, 0], [0, 2]])], "source")
    assert caught.value.where.point == pytest.approx((1, 1))


def test_a_small_loop_is_cut_off_and_reported():
    points = np.vstack([ellipse(60)[:30], [[-2.02, -0.02], [-2.02, 0.02]], ellipse(60)[30:]])
    result = clean([points], "source")
    assert Polygon(result.rings[0]).is_valid
    assert "cut off" in str(result.repairs[0])
    assert result.area == pytest.approx(signed_area(ellipse(60)), rel=0.01)


@pytest.mark.parametrize(
    ("others", "what", "ring"),
    [
        ([ellipse(20) + 20], "Hole 1 of the source lies outside the outline", 1),
        ([ellipse(20), ellipse(20) / 2], "Hole 2 of the source lies inside another hole", 2),
        ([ellipse(20) + 9], "The outline crosses hole 1 of the source", 1),
        ([ellipse(20), ellipse(20) + 1], "Hole 1 crosses hole 2 of the source", 2),
    ],
)
def test_a_hole_in_the_wrong_place_is_refused_by_its_number(others, what, ring):
    with pytest.raises(OutlineError, match=what) as caught:
        clean([10 * square_ring()[0] / 2, *others], "source")
    assert caught.value.where.ring == ring
    assert caught.value.where.point is not None
    assert caught.value.hint


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
    with pytest.raises(OutlineError, match="encloses no area"):
        clean([np.array([[1, 3], [2, 3], [1, 1], [3, 0], [1, 1], [2, 3]])], "source")


def test_numbers_too_coarse_for_the_shape_are_refused_with_how_coarse_they_are():
    clean([letter_l() + 2.0**32], "source")
    with pytest.raises(OutlineError, match=r"numbers are 0\.1 apart"):
        clean([letter_l() + 1e15], "source")


@given(star_shaped(), st.integers(0, 30), st.booleans(), st.floats(0, 0.999))
def test_a_place_is_at_the_arc_length_of_its_own_vertex(points, turn, backwards, fraction):
    drawn = np.repeat(np.roll(points, turn, axis=0), 2, axis=0)[:: -1 if backwards else 1]
    result = clean([drawn], "source")
    lengths = arc_lengths(result.rings[0])
    vertices = np.arange(len(drawn))
    at = np.array([result.length_of(0, vertex) for vertex in vertices])
    assert np.array_equal(points_at(result.rings[0], lengths, at), drawn)
    length = fraction * lengths[-1]
    assert result.length_of(0, result.vertex_of(0, length)) == pytest.approx(length, abs=1e-9)


def test_an_outline_too_small_beside_where_the_other_lies_is_refused():
    small, far = clean([1e-6 * letter_l()], "source"), clean([letter_l() + 1e6], "target")
    check_together([small, small])
    check_together([far, far])
    with pytest.raises(OutlineError, match="too coarse for frames between them"):
        check_together([small, far])
