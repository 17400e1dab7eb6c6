from contextlib import suppress

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from shapely import Polygon

from core.errors import OutlineError
from core.geometry.mending.meetings import separate
from core.geometry.mending.mend import HAIRS
from core.geometry.polyline import arc_lengths, points_at
from core.geometry.validate import clean
from tests.core.shapes import ellipse, rotation

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
TOUCHING = {
    "an hourglass": [[[0, 0], [10, 0], [5, 5], [10, 10], [0, 10], [5, 5]]],
    "tips that meet": [
        [
            *([0, 0], [10, 0], [10, 10], [6, 10], [5, 6], [9, 9]),
            *([9, 1], [1, 1], [1, 9], [5, 6], [4, 10], [0, 10]),
        ]
    ],
    "a vertex on an edge": [[[0, 0], [10, 0], [10, 10], [0, 10], [0, 6], [10, 5], [0, 4]]],
    "edges that meet": [
        [
            *([0, 0], [10, 0], [10, 4], [5, 4], [5, 3], [8, 3]),
            *([8, 1], [2, 1], [2, 3], [5, 3], [5, 4], [0, 4]),
        ]
    ],
    "a keyhole": [
        [
            *([0, 0], [10, 0], [10, 10], [5, 10], [5, 7], [7, 7]),
            *([7, 3], [3, 3], [3, 7], [5, 7], [5, 10], [0, 10]),
        ]
    ],
    "a bridge without width": [
        [
            *([0, 0], [3, 0], [3, 2], [7, 2], [7, 0], [10, 0]),
            *([10, 4], [7, 4], [7, 2], [3, 2], [3, 4], [0, 4]),
        ]
    ],
    "three leaves": [[[0, 0], [4, -2], [5, 0], [0, 0], [1, 4], [-1, 4], [0, 0], [-5, 0], [-4, -2]]],
    "a hole at an edge": [SQUARE, [[0, 5], [3, 3], [3, 7]]],
    "a hole along an edge": [SQUARE, [[0, 4], [3, 3], [3, 7], [0, 6]]],
    "a hole in a corner": [SQUARE, [[0, 0], [3, 2], [2, 3]]],
    "a hole from edge to edge": [SQUARE, [[0, 5], [5, 0], [10, 5], [5, 10]]],
    "holes that meet": [SQUARE, [[2, 2], [5, 5], [2, 8]], [[8, 2], [5, 5], [8, 8]]],
    "holes along an edge": [
        SQUARE,
        [[2, 2], [5, 2], [5, 8], [2, 8]],
        [[5, 3], [8, 3], [8, 7], [5, 7]],
    ],
}
placed = st.tuples(
    st.floats(0, 6.3), st.floats(-6, 9), st.floats(-1e3, 1e3), st.integers(0, 11), st.booleans()
)


@pytest.mark.parametrize("name", TOUCHING)
@given(placed)
def test_what_touches_is_opened_by_a_hair_wherever_and_however_it_is_drawn(name, placing):
    angle, power, offset, turn, backwards = placing
    rings = [
        np.roll((np.array(r, float) @ rotation(angle).T + offset) * 10.0**power, turn, axis=0)
        for r in TOUCHING[name]
    ]
    if backwards:
        rings = [ring[::-1] for ring in rings]
    result = clean(rings, "source")
    size = np.hypot(*np.ptp(rings[0], axis=0))
    near = [(ring - rings[0][0]) / size for ring in result.rings]
    assert Polygon(near[0], near[1:]).is_valid
    assert separate(near)
    assert any("opened" in str(repair) for repair in result.repairs)
    assert 0 < result.repairs[-1].moved <= HAIRS[0]
    for i, (ring, drawn) in enumerate(zip(result.rings, rings, strict=True)):
        at = np.array([result.length_of(i, vertex) for vertex in range(len(drawn))])
        away = points_at(ring, arc_lengths(ring), at) - drawn
        assert np.hypot(*away.T).max() <= 1.01 * HAIRS[0] * size


@pytest.mark.parametrize(
    ("points", "left"),
    [
        ([*SQUARE[:3], [5, 10], [5, 15], [5, 10], SQUARE[3]], SQUARE),
        ([*SQUARE[:3], [5, 10], [5, 5], [5, 10], SQUARE[3]], SQUARE),
        ([*SQUARE[:3], [5, 10], [5, 15], [7, 15], [5, 15], [5, 10], SQUARE[3]], SQUARE),
        ([*SQUARE[:3], [5, 10], [5, 15], [5, 8], [0, 8]], [*SQUARE[:3], [5, 10], [5, 8], [0, 8]]),
    ],
)
@given(st.integers(0, 9))
def test_what_goes_forth_and_back_is_cut_off(points, left, turn):
    result = clean([np.roll(np.array(points, float), turn, axis=0)], "source")
    assert Polygon(result.rings[0]).equals(Polygon(left))
    assert "without area" in str(result.repairs[-1])
    assert result.repairs[-1].where.point in {(5, 15), (7, 15), (5, 5)}


def test_two_balls_that_touch_stay_one_outline():
    ball = ellipse(80, 1.0, 1.0)
    result = clean([np.vstack([ball, [1, 0], [2, 0] - ball])], "source")
    assert result.area == pytest.approx(2 * Polygon(ball).area, rel=1e-3)
    assert np.ptp(result.rings[0][:, 0]) == pytest.approx(4)


@given(st.integers(0, 6), st.floats(0.01, 9.99), st.floats(-1e-8, 1e-8))
def test_a_vertex_a_trace_beside_or_across_an_edge_counts_as_on_it(turn, y, beside):
    points = np.array([*SQUARE, [0, 6], [10 + beside, y], [0, 4]])
    result = clean([np.roll(points, turn, axis=0)], "source")
    assert "opened" in str(result.repairs[0])
    assert separate([result.rings[0] / 15])


@settings(max_examples=300)
@given(
    st.lists(st.tuples(st.integers(0, 30), st.integers(0, 30)), min_size=3, max_size=9),
    st.lists(st.tuples(st.integers(0, 8), st.integers(-1, 1), st.integers(-1, 1)), max_size=4),
)
@example([(0, 0), (30, 0), (30, 30), (13, 30), (15, 30), (15, 29), (13, 31), (0, 30)], [])
def test_what_is_drawn_on_a_grid_comes_out_simple_or_is_refused(corners, spikes):
    points = [np.array(corner, float) for corner in corners]
    for at, x, y in spikes:
        here, aside = points[at % len(points)], np.array([x, y])
        points[at % len(points) : at % len(points)] = [here, here + aside, here - aside[::-1]]
    with suppress(OutlineError):
        (ring,) = clean([np.array(points)], "source").rings
        assert Polygon(ring).is_valid


@pytest.mark.parametrize("points", [np.random.default_rng(1).random((3000, 2)), "bow tie"])
def test_scribbles_and_bow_ties_are_refused(points):
    if isinstance(points, str):
        points = np.array([[0, 0], [5, 5], [10, 10], [10, 0], [5, 5], [0, 10]])
    with pytest.raises(OutlineError, match="crosses itself"):
        clean([points], "source")
