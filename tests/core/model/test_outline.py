from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.model import Outline, Ring
from tests.core.model.shapes import coordinates, fractions, rings

SAMPLES = np.linspace(0, 1, 9)


@given(st.tuples(coordinates, coordinates), st.floats(1, 500), st.floats(1, 500), st.floats(0, 4))
def test_an_ellipse_is_round(
    centre: tuple[float, float], wide: float, high: float, at: float
) -> None:
    x, y = (Ring.ellipse(centre, (wide, high)).position(at) - centre) / (wide, high)
    assert np.hypot(x, y) == pytest.approx(1.0, abs=3e-4)


def test_an_ellipse_runs_through_its_ends_in_turn() -> None:
    ring = Ring.ellipse((10, 20), (3, 4))
    assert ring.points.tolist() == [[13, 20], [10, 24], [7, 20], [10, 16]]


@given(rings(), st.data())
def test_a_new_node_leaves_the_curve_as_it_was(ring: Ring, data: st.DataObject) -> None:
    segment = data.draw(st.integers(0, len(ring) - 1))
    u = data.draw(st.floats(0.01, 0.99))
    split = ring.with_node(segment + u)
    for v in SAMPLES:
        before = segment + v / u if v <= u else segment + 1 + (v - u) / (1 - u)
        np.testing.assert_allclose(split.position(before), ring.position(segment + v), atol=1e-6)


@given(rings(), st.data())
def test_a_new_node_leaves_every_other_segment_alone(ring: Ring, data: st.DataObject) -> None:
    segment = data.draw(st.integers(0, len(ring) - 1))
    split = ring.with_node(segment + data.draw(st.floats(0.01, 0.99)))
    assert len(split) == len(ring) + 1
    for other in set(range(len(ring))) - {segment}:
        np.testing.assert_array_equal(
            split.controls(other + (other > segment)), ring.controls(other)
        )


@given(rings())
def test_bounds_hold_the_whole_curve_and_no_more(ring: Ring) -> None:
    places = np.linspace(0, len(ring), 200 * len(ring), endpoint=False)
    points = np.array([ring.position(at) for at in places])
    sampled = np.concatenate([points.min(axis=0), -points.max(axis=0)])
    left, top, right, bottom = Outline((ring,)).bounds()
    exact = np.array([left, top, -right, -bottom])
    size = (
        1e-12
        + np.abs(ring.points).max()
        + np.abs(ring.handles_in).max()
        + np.abs(ring.handles_out).max()
    )
    assert (exact <= sampled + 1e-12 * size).all()
    assert (exact >= sampled - 1e-3 * size).all()


@given(rings())
def test_a_mirrored_outline_stays_in_its_bounds_and_mirrored_again_is_itself(ring: Ring) -> None:
    outline = Outline((ring,))
    mirrored = outline.mirrored()
    np.testing.assert_allclose(mirrored.bounds(), outline.bounds(), atol=1e-9)
    back = mirrored.mirrored().rings[0]
    np.testing.assert_allclose(back.points, ring.points, atol=1e-9)
    assert np.array_equal(back.handles_in, ring.handles_in)


@given(rings())
def test_a_ring_reversed_twice_is_itself(ring: Ring) -> None:
    assert ring.reversed().reversed() == ring


@given(rings(), st.data())
def test_a_reversed_ring_runs_through_the_same_points(ring: Ring, data: st.DataObject) -> None:
    at = data.draw(st.integers(0, len(ring) - 1)) + data.draw(fractions)
    back = (len(ring) - at) % len(ring)
    np.testing.assert_allclose(ring.reversed().position(back), ring.position(at), atol=1e-6)


@given(rings(), st.tuples(coordinates, coordinates), st.data())
def test_moving_a_ring_moves_every_point_on_it(
    ring: Ring, by: tuple[float, float], data: st.DataObject
) -> None:
    at = data.draw(st.integers(0, len(ring) - 1)) + data.draw(fractions)
    moved = ring.transformed(np.eye(2), by)
    np.testing.assert_allclose(moved.position(at), ring.position(at) + by, atol=1e-6)


@given(rings())
def test_rings_are_equal_by_value_and_then_hash_alike(ring: Ring) -> None:
    copy = Ring(ring.points.copy(), ring.handles_in.copy(), ring.handles_out.copy())
    assert copy == ring
    assert hash(copy) == hash(ring)
    assert ring != Ring(ring.points + 1, ring.handles_in, ring.handles_out)


@given(rings())
def test_an_outline_cannot_be_written_into(ring: Ring) -> None:
    with pytest.raises(ValueError, match="read-only"):
        ring.points[0] = 0.0


def test_an_outline_keeps_its_own_copy_of_the_points() -> None:
    points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    outline = Outline.polygon(points)
    points[0] = 9.0
    assert outline.rings[0].points[0].tolist() == [0.0, 0.0]


def test_points_of_the_wrong_shape_are_refused() -> None:
    with pytest.raises(ValueError, match="expected"):
        Ring.polygon([[0.0, 0.0, 0.0]])


def test_equal_rings_hash_alike_whatever_the_sign_of_nought():
    points = np.array([[0.0, 0], [1, 0], [1, 1]])
    ring, same = Ring.polygon(points), Ring.polygon(np.where(points == 0, -0.0, points))
    assert ring == same
    assert hash(ring) == hash(same)
