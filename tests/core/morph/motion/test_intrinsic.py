"""The laws of the comparator that blends edge lengths and turning angles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import core
from core.geometry.polyline import signed_area
from core.geometry.triangulation import boundary_rings, triangulate
from core.morph.motion.intrinsic import Intrinsic
from tests.core.shapes import limb, rotation, square_ring, star_shaped

TIMES = [0.0, 0.15, 0.4, 0.5, 0.8, 1.0]
ONE_TRIANGLE = np.array([[0, 1, 2]])


def edges(ring):
    return (np.roll(ring, -1, axis=0) - ring) @ [1, 1j]


def solved(source, target, marks):
    return core.solve(source, target, marks, recipe=core.Recipe(method="intrinsic"))


def fan(polygon):
    """A mesh around the origin, which sees the whole polygon."""
    ring = np.arange(len(polygon))
    triangles = np.column_stack([ring, np.roll(ring, -1), np.full_like(ring, len(ring))])
    return np.vstack([polygon, [[0, 0]]]), triangles


@given(star_shaped(12, 12), star_shaped(12, 12), st.floats(-3, 3))
def test_the_polygon_closes_with_every_edge_in_its_interpolated_direction(source, target, angle):
    rest, triangles = fan(source)
    goal, _ = fan(target @ rotation(angle).T)
    motion = Intrinsic(rest, goal, triangles)
    first, last = (np.angle(np.roll(e, -1) / e) for e in (edges(rest[:-1]), edges(goal[:-1])))
    for t in TIMES:
        now = edges(motion(t)[:-1])
        turned = np.roll(now, -1) * np.exp(-1j * ((1 - t) * first + t * last))
        # one that gave way beyond its length points backwards, but along the same line
        assert np.abs(np.imag(turned * np.conj(now))).max() < 1e-9


def test_edges_of_equal_length_keep_it_where_angles_alone_change():
    """A rhombus that leans over: its angles close it by themselves."""
    upright, leaning = (
        np.array([[0, 0], [1, 0], [1 + np.cos(a), np.sin(a)], [np.cos(a), np.sin(a)]])
        for a in (1.8, 0.7)
    )
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    motion = Intrinsic(upright, leaning, triangles)
    for t in TIMES:
        assert np.abs(edges(motion(t))) == pytest.approx(1)


@pytest.mark.parametrize("angle", [-3.0, -1.0, 0.5, 2.9])
def test_a_shape_with_a_hole_off_its_centre_turns_as_a_whole(angle):
    source = [ring + k * np.array([0.5, 0.3]) for k, ring in enumerate(square_ring(0.3))]
    target = [ring @ rotation(angle).T + [7, -2] for ring in source]
    morph = solved(source, target, [(0, 0), (1, 1)])
    away = morph.rest - morph.rest[0]
    for t in TIMES:
        now = morph.at(t)
        assert np.abs(now - now[0] - away @ rotation(t * angle).T).max() < 1e-8


def test_lengths_and_angles_bend_a_limb_where_straight_paths_shorten_it():
    source, target = limb(0.0, 24), limb(2.9, 24)
    marks = [(0, 0), (23, 23), (24, 24), (47, 47)]
    lengths = {
        method: np.abs(edges(m.at(0.5)[m.rings[0]])).sum()
        for method in ("intrinsic", "linear")
        for m in [core.solve(source, target, marks, recipe=core.Recipe(method=method))]
    }
    assert lengths["intrinsic"] == pytest.approx(np.abs(edges(source)).sum(), rel=0.01)
    assert lengths["linear"] < 0.9 * lengths["intrinsic"]


def test_a_mesh_without_inner_vertices_has_its_ends_exactly():
    rest, target = np.array([[0.0, 0], [3, 0], [1, 2]]), np.array([[1.0, 1], [2, 4], [-1, 2]])
    motion = Intrinsic(rest, target, ONE_TRIANGLE)
    assert motion(0) == pytest.approx(rest, abs=1e-12)
    assert motion(1) == pytest.approx(target, abs=1e-12)


def test_the_rings_of_a_mesh_are_found_with_its_inside_to_their_left():
    rings = square_ring()
    mesh = triangulate(rings, 0.05)
    found = {frozenset(ring.tolist()): mesh.points[ring] for ring in boundary_rings(mesh.triangles)}
    assert set(found) == {frozenset(ring.tolist()) for ring in mesh.rings}
    assert sorted(map(signed_area, found.values())) == pytest.approx([-4, 16])
