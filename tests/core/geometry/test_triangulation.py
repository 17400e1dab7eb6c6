import numpy as np
import pytest
from hypothesis import given, settings
from shapely import Polygon

from core.fem.elements import Elements
from core.geometry.triangulation import (
    adjacent_triangles,
    split_chords,
    triangulate,
    unique_edges,
)
from core.geometry.validate import clean
from core.morph.quality import smallest_angle
from tests.core.shapes import comb, ellipse, letter_l, square_ring, star_shaped


@settings(max_examples=40, deadline=None)
@given(star_shaped())
def test_the_triangles_tile_the_outline(points):
    rings = clean([points], "source").rings
    for mesh in (coarse := triangulate(rings, 0.05), split_chords(coarse)):
        areas = Elements.of(mesh.points, mesh.triangles).areas
        assert (areas > 0).all()
        assert areas.sum() == pytest.approx(Polygon(points).area)
        assert np.array_equal(mesh.points[: len(points)], rings[0])


@pytest.mark.parametrize("rings", [[comb()], [letter_l()], square_ring()])
def test_no_interior_edge_joins_two_boundary_vertices_after_splitting(rings):
    mesh = split_chords(triangulate(clean(rings, "source").rings, 100.0))
    edges, _, count = unique_edges(mesh.triangles)
    assert not ((count == 2) & (edges < mesh.boundary_size).all(axis=1)).any()
    assert (count <= 2).all()


def test_a_hole_stays_empty():
    mesh = triangulate(clean(square_ring(), "source").rings, 0.5)
    centres = mesh.points[mesh.triangles].mean(axis=1)
    assert (np.abs(centres).max(axis=1) > 1).all()
    assert [len(ring) for ring in mesh.rings] == [4, 4]


def test_inner_triangles_meet_the_quality_bound():
    mesh = triangulate(clean([ellipse(128)], "source").rings, 0.01)
    assert np.degrees(smallest_angle(mesh.points, mesh.triangles)) > 20


def test_each_pair_of_neighbours_shares_an_edge():
    mesh = triangulate(clean([ellipse(40)], "source").rings, 0.05)
    pairs = adjacent_triangles(mesh.triangles)
    shared = [len(set(mesh.triangles[i]) & set(mesh.triangles[j])) for i, j in pairs]
    assert set(shared) == {2}
    # Euler: interior edges of a disc
    assert len(pairs) == (3 * len(mesh.triangles) - mesh.boundary_size) // 2
