import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.flatten import flatten, flatten_ring
from core.model import Outline, Ring

KAPPA = 0.5522847498307936


def circle() -> Ring:
    points = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]], dtype=float)
    tangent = np.array([[0, 1], [-1, 0], [0, -1], [1, 0]], dtype=float)
    return Ring(points, -KAPPA * tangent, KAPPA * tangent)


def test_straight_rings_keep_just_their_nodes():
    ring = Ring.polygon([[0, 0], [4, 0], [4, 3]])
    line = flatten_ring(ring, 0.01)
    assert np.array_equal(line.points, ring.points)
    assert np.array_equal(line.at, [0, 1, 2])


@given(st.floats(1e-5, 1e-1))
def test_a_curve_stays_within_the_tolerance(distance):
    line = flatten_ring(circle(), distance)
    middles = (line.points + np.roll(line.points, -1, axis=0)) / 2
    for points in (line.points, middles):  # the cubic itself is off the circle by 2.7e-4
        assert np.abs(np.hypot(*points.T) - 1).max() <= distance + 3e-4


def test_every_vertex_knows_its_place_on_the_curve():
    ring = circle()
    line = flatten_ring(ring, 0.003)
    assert np.allclose([ring.position(at) for at in line.at], line.points, atol=1e-14)
    assert (np.diff(line.at) > 0).all()


def test_the_tolerance_follows_the_size_of_the_outline():
    small, large = (flatten(Outline((circle(),)).transformed(k * np.eye(2))) for k in (1e-3, 1e6))
    assert len(small[0].points) == len(large[0].points)
