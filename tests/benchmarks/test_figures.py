"""Each figure shows what it claims, in numbers; and all of them can be written."""

import numpy as np
import pytest

from core.geometry.polyline import signed_area

pytest.importorskip("PySide6.QtGui", reason="figures are painted with Qt", exc_type=ImportError)

from tests.benchmarks import figures
from tests.benchmarks.sheet import draw_row, save, stack


def areas(row):
    return np.array([signed_area(panel.points[panel.rings[0]]) for panel in row])


def test_under_a_large_rotation_straight_paths_collapse_and_rigid_ones_keep_the_area():
    straight, rigid = (areas(row) for row in figures.figure_1_and_3())
    assert straight.min() < 0.1 * straight[0]
    assert rigid == pytest.approx(rigid[0])


def test_mirrored_triangles_turn_inside_out_and_are_refused_with_the_reason():
    (row,) = figures.figure_2()
    assert [len(panel.folded) for panel in row] == [0, 0, 1, 1, 1]
    assert "turned inside out" in figures.figure_2_refusal()


def test_beyond_a_full_turn_principal_angles_fold_and_unwrapped_ones_do_not():
    principal, unwrapped = figures.figure_3_angles()
    assert max(len(panel.folded) for panel in principal) > 0
    assert all(len(panel.folded) == 0 for panel in unwrapped)


def test_at_four_fifths_the_rigid_frame_has_its_area_and_the_straight_one_has_lost_half():
    _, straight, rigid, _ = areas(figures.figure_7()[0])
    assert rigid == pytest.approx(6, rel=0.02)
    assert straight < 0.6 * rigid


def test_the_sequence_of_simple_shapes_has_no_fold():
    assert all(len(panel.folded) == 0 for row in figures.figure_8() for panel in row)


def test_the_figures_are_written_as_pictures(tmp_path, qapp):
    image = stack([draw_row(row) for row in figures.figure_8()])
    save(image, tmp_path / "figures" / "8.png")
    assert (tmp_path / "figures" / "8.png").stat().st_size > 5000
    assert image.width() > image.height() > 100
