import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.fem.elements import Elements
from core.geometry.triangulation import triangulate
from tests.core.shapes import ellipse, letter_l

numbers = st.floats(-3, 3)


def mesh():
    return triangulate([letter_l()], 0.3)


@given(st.lists(numbers, min_size=6, max_size=6))
def test_an_affine_map_has_its_own_matrix_as_gradient_everywhere(entries):
    A, b = np.array(entries[:4]).reshape(2, 2), np.array(entries[4:])
    m = mesh()
    elements, x = Elements.of(m.points, m.triangles), m.points @ A.T + b
    assert np.allclose(elements.deformation_gradients(x), A, atol=1e-9)
    assert np.allclose(elements.determinants(x), np.linalg.det(A), atol=1e-9)


def test_areas_sum_to_the_polygon():
    m = mesh()
    assert np.isclose(Elements.of(m.points, m.triangles).areas.sum(), 7)


def test_linear_functions_are_harmonic_inside():
    m = triangulate([ellipse(60)], 0.02)
    residual = Elements.of(m.points, m.triangles).laplacian @ (m.points @ [2.0, -3.0])
    assert np.abs(residual[m.boundary_size :]).max() < 1e-10
