from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import points as shapely_points
from shapely.geometry import LinearRing, Polygon

from core.errors import OutlineError
from core.geometry.flatten import flatten_ring
from core.geometry.freehand import fit_stroke
from core.model import Ring
from core.model.outline import MIN_NODES

TOLERANCE = 2.0


def circle(turns: float = 1.0, radius: float = 100.0, count: int = 120) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi * turns, count)
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def rectangle(width: float = 200.0, height: float = 100.0) -> np.ndarray:
    corners = np.array([[0, 0], [width, 0], [width, height], [0, height], [0, 0]], dtype=float)
    u = np.linspace(0, 1, 30, endpoint=False)[:, None]
    sides = [(1 - u) * a + u * b for a, b in pairwise(corners)]
    return np.vstack(sides)


def farthest(ring: Ring, stroke: np.ndarray) -> float:
    outline = LinearRing(flatten_ring(ring, 0.01).points)
    return float(outline.distance(shapely_points(stroke)).max())


def kinks(ring: Ring) -> np.ndarray:
    """Sine of the turn between the two handles of each node."""
    before, after = -ring.handles_in, ring.handles_out
    lengths = np.hypot(*before.T) * np.hypot(*after.T)
    return np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]) / lengths


def test_a_drawn_circle_becomes_a_few_smooth_nodes():
    ring = fit_stroke(circle(), TOLERANCE)
    assert len(ring) <= 6
    assert kinks(ring).max() < 1e-6
    assert farthest(ring, circle()) < TOLERANCE


def test_corners_stay_corners_and_sides_stay_straight():
    ring = fit_stroke(rectangle(), TOLERANCE)
    assert len(ring) == 4
    assert not ring.curved.any()
    assert farthest(Ring.polygon([[0, 0], [200, 0], [200, 100], [0, 100]]), ring.points) < TOLERANCE


def test_a_stroke_that_runs_past_its_beginning_is_trimmed_there():
    stroke = circle(turns=1.06, count=150)
    stroke *= np.linspace(1.05, 0.9, len(stroke))[:, None]
    outline = Polygon(flatten_ring(fit_stroke(stroke, TOLERANCE), 0.01).points)
    assert outline.is_valid
    assert outline.area == pytest.approx(np.pi * 97.5**2, rel=0.05)


def test_ends_that_nearly_meet_are_drawn_together_without_a_kink():
    ring = fit_stroke(circle(turns=0.97), TOLERANCE)
    assert kinks(ring).max() < 1e-6


def test_ends_far_apart_are_closed_by_a_straight_line():
    ring = fit_stroke(circle(turns=0.5), TOLERANCE)
    straight = ~ring.curved
    assert straight.sum() == 1
    i = int(np.argmax(straight))
    ends = ring.points[[i, (i + 1) % len(ring)]]
    assert np.abs(ends[:, 1]).max() < TOLERANCE


@pytest.mark.parametrize(
    "stroke",
    [
        np.zeros((0, 2)),
        np.zeros((1, 2)),
        np.array([[0.0, 0.0], [300.0, 5.0]]),
        np.column_stack([np.linspace(0, 300, 80), np.zeros(80)]),
        circle(radius=1.0),
    ],
)
def test_a_stroke_around_nothing_says_what_to_do(stroke: np.ndarray):
    with pytest.raises(OutlineError) as error:
        fit_stroke(stroke, TOLERANCE)
    assert "Draw around" in error.value.hint


waves = st.lists(st.floats(-0.12, 0.12), min_size=2, max_size=8)


@settings(deadline=None, max_examples=40)
@given(waves, st.integers(40, 300))
def test_the_ring_stays_close_to_the_stroke(amplitudes: list[float], count: int):
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = 150.0 * (
        1 + sum(a / (k + 1) * np.sin((k + 1) * angle) for k, a in enumerate(amplitudes))
    )
    stroke = radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    ring = fit_stroke(stroke, TOLERANCE)
    assert len(ring) >= MIN_NODES
    assert farthest(ring, stroke) < 2 * TOLERANCE + 0.5 * 150 * 2 * np.pi / count


@settings(deadline=None, max_examples=15)
@given(st.floats(0.01, 1000), st.floats(-500, 500), st.floats(-500, 500))
def test_size_and_place_do_not_matter(scale: float, x: float, y: float):
    drawn = fit_stroke(rectangle(), TOLERANCE)
    offset = np.array([x, y])
    moved = fit_stroke(scale * (rectangle() + offset), scale * TOLERANCE)
    np.testing.assert_allclose(moved.points, scale * (drawn.points + offset), atol=scale * 1e-3)


def test_real_silhouettes_keep_their_shape_with_fewer_nodes(shared_data):
    outlines = np.load(shared_data / "mpeg7_outlines.npz")
    for name in ("horse-01", "camel-02", "deer-00", "key-00"):
        stroke = 300.0 * outlines[name].astype(float)
        ring = fit_stroke(stroke, TOLERANCE)
        kept = Polygon(flatten_ring(ring, 0.05).points).buffer(0)
        drawn = Polygon(stroke).buffer(0)
        assert kept.symmetric_difference(drawn).area < 0.03 * drawn.area
        assert len(ring) < len(stroke)
