"""Where points lie on a mesh."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.location import Located
from core.geometry.triangulation import triangulate
from tests.core.shapes import square_ring

MESH = triangulate(square_ring(), 0.05)


@given(st.integers(0, 2**32 - 1), st.floats(-3, 3), st.floats(-3, 3))
def test_what_is_linear_on_the_mesh_is_carried_over_exactly_inside_and_out(seed, a, b):
    places = np.random.default_rng(seed).uniform(-3, 3, (20, 2))
    values = np.column_stack([MESH.points @ [a, b], MESH.points @ [b, -a] + 1])
    found = Located.on(MESH.points, MESH.triangles, places).interpolate(values)
    expected = np.column_stack([places @ [a, b], places @ [b, -a] + 1])
    assert found == pytest.approx(expected, abs=1e-9)


def test_a_point_in_a_triangle_is_found_there_and_one_outside_at_the_nearest():
    middles = MESH.points[MESH.triangles].mean(axis=1)
    found = Located.on(MESH.points, MESH.triangles, middles)
    assert np.array_equal(found.triangle, np.arange(len(MESH.triangles)))
    assert np.allclose(found.weights, 1 / 3)
    far = Located.on(MESH.points, MESH.triangles, np.array([[2.5, 0.3]]))
    assert MESH.points[far.corners[0], 0].max() == 2  # on the right side of the square


def test_vertices_have_their_own_values():
    values = np.random.default_rng(3).standard_normal((len(MESH.points), 2))
    found = Located.on(MESH.points, MESH.triangles, MESH.points).interpolate(values)
    assert found == pytest.approx(values, abs=1e-9)
