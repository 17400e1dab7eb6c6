"""Each figure measures what its name says."""

from dataclasses import replace

import numpy as np
import pytest

from core.model import Outline, RingPoint
from tests.benchmarks.corners import allowed_angle
from tests.benchmarks.drift import Drift, deviation
from tests.benchmarks.given_marks import solve_given_marks, with_one_moved
from tests.benchmarks.measures import OWN, end_error, jolt, measure
from tests.benchmarks.pairs import Pair
from tests.benchmarks.worst import badness, complaints
from tests.core.shapes import ellipse, letter_l, rotation

TURN = 2.6


@pytest.fixture(scope="module")
def turned():
    """A pair, its row and its morph."""
    ends = letter_l(), letter_l() @ rotation(TURN).T + [50, -20]
    pair = Pair("letter → turned", *map(Outline.polygon, ends))
    return pair, *measure(pair, frames=9)


def test_a_turned_letter_is_measured_as_rigid_while_straight_paths_shrink_it(turned):
    _, row, morph = turned
    assert row.triangles == len(morph.triangles)
    assert row.certified
    assert row.end_error < 1e-12
    assert row.folds_source == row.folds_target == row.folded_frames == 0
    assert row.crossing == ()
    assert row.drifts[OWN].area < 1e-6
    least = np.cos(TURN / 2)  # halfway, by which lengths shrink
    assert row.drifts["straight paths"].area == pytest.approx(1 - least**2)
    assert row.drifts["straight paths"].perimeter == pytest.approx(1 - least)
    assert row.drifts["lengths and angles"].perimeter < 1e-6


def test_the_marks_of_the_automatic_run_give_the_same_map_when_they_are_given(turned):
    pair, row, morph = turned
    given = solve_given_marks(pair, morph.report, None)
    assert given.marks == len(morph.report.proposed)
    assert given.distortion_mean == pytest.approx(row.distortion_mean, abs=1e-6)


def test_a_moved_mark_goes_part_of_the_way_to_the_next_one_on_its_ring():
    target = Outline.polygon(letter_l(), ellipse(8, 0.2, 0.2) + 0.5)
    start = RingPoint(0, 0.0)
    images = [RingPoint(0, 5.0), RingPoint(1, 5.1), RingPoint(0, 3.0), RingPoint(0, 1.0)]
    moved = with_one_moved([(start, image) for image in images], target)
    assert [b.at for _, b in moved] == [pytest.approx(5.2), 5.1, 3.0, 1.0]  # 2 of 6 nodes to go
    assert [b.ring for _, b in moved] == [0, 1, 0, 0]


def test_the_sharpest_corner_bounds_the_angles_of_every_mesh():
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    sharp = np.array([[0.0, 0], [4, 0], [4, 4], [3.9, 0.05]])
    assert allowed_angle([square], [square]) == pytest.approx(45)
    beta, reflex = np.degrees(np.arctan2(0.05, 3.9)), 360 - np.degrees(np.arctan2(3.9, 0.1))
    assert reflex > 180  # the corner opposite needs two triangles
    assert allowed_angle([sharp], [sharp]) == pytest.approx(beta)
    # what is reflex at one end is shared by two triangles at the other
    assert allowed_angle([sharp], [np.roll(sharp, 1, axis=0)]) < beta


def test_the_end_error_sees_a_missed_vertex_and_one_that_left_the_outline():
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    split = np.array([[0.0, 0], [2, 0], [4, 0], [4, 4], [0, 4]])
    assert end_error([square], [split]) == 0
    for vertex, step in ((1, [0, 1]), (3, [0, -1])):
        moved = split.copy()
        moved[vertex] += step
        assert end_error([square], [moved]) == pytest.approx(0.25)


def test_the_jolt_is_the_change_of_velocity_where_a_vertex_turns_its_corner():
    times = np.linspace(0, 1, 5)
    steady = times[:, None, None] * np.array([[1.0, 0], [0, 3]])
    assert jolt(steady, times) == pytest.approx(0, abs=1e-12)
    corner = np.stack([times, np.maximum(0, times - 0.5)], axis=1)[:, None]
    assert jolt(corner, times) == pytest.approx(1)


@pytest.mark.parametrize("growth", [lambda t: 1 + 3 * t, lambda t: 4**t, lambda t: 1 - 0.7 * t])
def test_there_is_no_drift_while_a_figure_changes_in_even_steps_or_ratios(growth):
    times = np.linspace(0, 1, 9)
    assert deviation(growth(times), times) == pytest.approx(0, abs=1e-12)


def test_the_drift_is_how_far_a_frame_strays_and_a_crossing_is_told_with_its_moment():
    times = np.linspace(0, 1, 5)
    frames = [[scale * ellipse()] for scale in (1, 1, np.sqrt(0.9), 1.1, 1)]
    frames[1] = [np.array([[0.0, 0], [4, 4], [4, 0], [0, 4]])]
    drift = Drift.of(frames, times)
    assert drift.crossing == (0.25,)
    assert drift.area == pytest.approx(1)
    whole = Drift.of([frames[k] for k in (0, 2, 3, 4)], times[[0, 2, 3, 4]])
    assert (whole.area, whole.perimeter) == (pytest.approx(0.21), pytest.approx(0.1))


def test_what_is_wrong_with_a_pair_is_said_and_folds_weigh_most(turned):
    _, row, _ = turned
    distorted, folded = replace(row, distortion_mean=40.0), replace(row, folded_frames=1)
    assert complaints(row) == "nothing"
    assert complaints(distorted) == "SD 40.00"
    assert complaints(folded) == "1 frames folded"
    assert badness(row) < badness(distorted) < badness(folded)
