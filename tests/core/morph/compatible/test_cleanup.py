from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon

from core.errors import Cancelled
from core.geometry.polyline import resample
from core.geometry.triangulation import Mesh, split_edges, unique_edges
from core.model.outline import Array
from core.morph.compatible.cleanup import coarsen, improve
from core.morph.compatible.flips import flip
from core.morph.compatible.joint import JointMesh, quality
from core.morph.compatible.overlay import compatible_mesh
from core.morph.compatible.removal import remove
from core.morph.compatible.smoothing import GOOD, smooth
from core.morph.quality import smallest_angle
from tests.core.morph.compatible.test_overlay import HOLES, PAIRS, B, check_fits
from tests.core.morph.polygons import at_unit_area, comb, disc, needle, star_shaped, untangled

AREA = 1 / 200


def outlines(name: str) -> tuple[list[Array], list[Array]]:
    source, target = PAIRS[name]
    return [source], [target]


def cleaned(source: list[Array], target: list[Array]) -> tuple[Mesh, Array]:
    mesh, image = compatible_mesh(source, target)
    return improve(coarsen(JointMesh.of(mesh, image)), AREA).apart(mesh.rings)


def joint(name: str) -> JointMesh:
    return JointMesh.of(*compatible_mesh(*outlines(name)))


def check_joint(mesh: JointMesh, name: str) -> None:
    ring = np.arange(mesh.boundary_size)
    check_fits(Mesh(mesh.end(0), mesh.triangles, (ring,)), mesh.end(1), *outlines(name))


def corners(mesh: JointMesh) -> list[frozenset[complex]]:
    """Where each triangle's corners lie in the source."""
    return [frozenset(mesh.points[t, 0].tolist()) for t in mesh.triangles]


def worst(mesh: JointMesh) -> float:
    return float(mesh.quality.min())


@pytest.mark.parametrize("name", PAIRS)
def test_the_clean_mesh_fits_both_polygons(name: str) -> None:
    check_fits(*cleaned(*outlines(name)), *outlines(name))


@pytest.mark.parametrize("name", HOLES)
def test_the_clean_mesh_fits_outlines_with_holes(name: str) -> None:
    source, target = HOLES[name]
    check_fits(*cleaned(source, target), source, target)


@settings(max_examples=15, deadline=None)
@given(star_shaped(B), untangled(B), st.integers(0, B - 1))
def test_the_clean_mesh_fits_wild_polygons_at_any_shift(
    source: Array, target: Array, shift: int
) -> None:
    target = np.roll(target, shift, axis=0)
    check_fits(*cleaned([source], [target]), [source], [target])


@pytest.mark.sweep
@pytest.mark.parametrize("first", range(0, 40, 4))
def test_the_clean_mesh_fits_real_outlines_of_any_two_kinds(shared_data: Path, first: int) -> None:
    outlines = np.load(shared_data / "mpeg7_outlines.npz")
    names = sorted(outlines.files)
    for name, other in zip(names[first::40], names[first + 17 :: 40], strict=False):
        rings = [at_unit_area(resample(outlines[n].astype(float), 150)) for n in (name, other)]
        if all(Polygon(ring).is_valid for ring in rings):
            source, target = ([ring] for ring in rings)
            check_fits(*cleaned(source, target), source, target)


def test_a_polygon_and_its_copy_get_an_even_mesh_without_distortion() -> None:
    source = comb(4, 120)
    mesh, image = cleaned([source], [source])
    assert smallest_angle(mesh.points, mesh.triangles) > np.radians(20)
    assert np.abs(image - mesh.points).max() < 0.02


@pytest.mark.parametrize("name", ["spiral and disc", "comb and square", "spiral and comb"])
def test_the_typical_triangle_of_the_clean_mesh_is_better_than_that_of_the_overlay(
    name: str,
) -> None:
    before, after = joint(name), JointMesh.of(*cleaned(*outlines(name)))
    assert np.median(after.worse) > 1.1 * np.median(before.worse)


def test_coarsening_keeps_the_fit_and_leaves_few_inner_vertices() -> None:
    before = joint("spiral and comb")
    after = coarsen(before)
    check_joint(after, "spiral and comb")
    b = before.boundary_size
    assert len(after.points) - b < 0.5 * (len(before.points) - b)


def test_a_smaller_area_gives_more_triangles() -> None:
    mesh = JointMesh.of(*compatible_mesh([disc(60)], [np.roll(disc(60), 20, axis=0)]))
    counts = [len(improve(mesh, area).triangles) for area in (1 / 50, 1 / 200, 1 / 800)]
    assert all(few < many for few, many in pairwise(counts))


def test_triangles_too_thin_for_floating_point_are_left_alone() -> None:
    source = needle(12, 1e-20)
    mesh, image = cleaned([source], [source])
    assert np.isfinite(mesh.points).all()
    assert np.array_equal(image[:12], source)


def test_the_clean_up_can_be_cancelled() -> None:
    def cancel(stage: str) -> None:
        raise Cancelled

    mesh = JointMesh.of(*compatible_mesh([disc(9)], [disc(9)]))
    with pytest.raises(Cancelled):
        coarsen(mesh, cancel)
    with pytest.raises(Cancelled):
        improve(mesh, AREA, cancel)


@pytest.mark.parametrize("name", PAIRS)
def test_flips_keep_the_fit_and_never_lower_the_worst_triangle(name: str) -> None:
    mesh = joint(name)
    flipped = flip(mesh, passes=50)
    check_joint(flipped, name)
    assert worst(flipped) >= worst(mesh)
    assert flip(flipped, passes=1) is flipped


@pytest.mark.parametrize("name", PAIRS)
def test_smoothing_keeps_the_fit_and_never_lowers_the_worst_triangle(name: str) -> None:
    mesh = joint(name)
    smoothed = smooth(mesh)
    check_joint(smoothed, name)
    assert worst(smoothed) >= min(GOOD, worst(mesh)) - 1e-15


@pytest.mark.parametrize("name", PAIRS)
def test_removal_keeps_the_fit_and_takes_inner_vertices_only(name: str) -> None:
    mesh = joint(name)
    everywhere = np.ones(len(mesh.tail), bool)
    thinner = remove(mesh, everywhere, np.zeros(len(everywhere)))
    check_joint(thinner, name)
    assert len(thinner.points) <= len(mesh.points)


def test_removal_leaves_nothing_worse_than_fair() -> None:
    mesh = joint("spiral and comb")
    fair = 0.5 * np.median(mesh.quality)
    thinner = remove(mesh, np.ones(len(mesh.tail), bool), np.full(len(mesh.tail), fair))
    known = corners(mesh)
    new = [i for i, places in enumerate(corners(thinner)) if places not in known]
    assert len(thinner.points) < len(mesh.points)
    assert new
    assert thinner.quality[new].min() >= min(fair, worst(mesh))


def test_nothing_is_removed_that_is_wanted() -> None:
    mesh = joint("spiral and comb")
    nowhere = np.zeros(len(mesh.tail), bool)
    assert remove(mesh, nowhere, np.zeros(len(nowhere))) is mesh


def test_splitting_inner_edges_keeps_the_fit() -> None:
    mesh = joint("spiral and comb")
    _, _, count = unique_edges(mesh.triangles)
    split = JointMesh(*split_edges(mesh.points, mesh.triangles, count == 2), mesh.boundary_size)
    check_joint(split, "spiral and comb")
    assert len(split.points) == len(mesh.points) + np.count_nonzero(count == 2)


def test_quality_is_one_for_equilateral_falls_towards_flat_and_is_negative_when_folded() -> None:
    heights = np.array([np.sqrt(0.75), 0.1, 1e-6, 0, -0.1])
    points = np.concatenate([[0, 1], 0.5 + 1j * heights])[:, None]
    found = quality(points, np.array([[0, 1, 2 + k] for k in range(len(heights))]))[:, 0]
    assert found[0] == pytest.approx(1)
    assert (np.diff(found) < 0).all()
    assert found[3] == 0
    assert found[4] < 0


def test_lengths_are_the_root_mean_square_of_both_ends() -> None:
    mesh = JointMesh(np.array([[0, 0], [3, 1j], [0, 1]]), np.array([[0, 1, 2]]), 3)
    assert mesh.lengths(np.array([0]), np.array([1])) == pytest.approx([np.sqrt((9 + 1) / 2)])
