import itertools

import numpy as np
import pytest

from core.fem.elements import Elements
from core.fem.energies import FoldoverFree, StVenantKirchhoff, SymmetricDirichlet
from core.fem.newton import FreeVertices, energy, line_search, newton_step, step_to_flat
from core.geometry.triangulation import triangulate
from tests.core.shapes import ellipse

DENSITIES = [StVenantKirchhoff(1.3, 0.7), SymmetricDirichlet(), FoldoverFree(0.1)]


@pytest.fixture
def problem():
    mesh = triangulate([ellipse(40)], 0.05)
    vertices = FreeVertices(
        Elements.of(mesh.points, mesh.triangles), np.arange(mesh.boundary_size, len(mesh.points))
    )
    rng = np.random.default_rng(3)
    x = mesh.points @ np.array([[1.2, 0.3], [0.0, 0.9]])
    x[vertices.free] += 0.02 * rng.standard_normal((len(vertices.free), 2))
    return vertices, x


@pytest.mark.parametrize("density", DENSITIES, ids=lambda d: type(d).__name__)
def test_the_slope_is_the_derivative_of_the_energy_along_the_direction(problem, density):
    vertices, x = problem
    step = newton_step(vertices, density, x)
    h = 1e-6
    ahead, behind = (energy(vertices.elements, density, x + s * step.direction) for s in (h, -h))
    assert step.slope < 0
    assert (ahead - behind) / (2 * h) == pytest.approx(step.slope, rel=1e-3)


@pytest.mark.parametrize("density", DENSITIES, ids=lambda d: type(d).__name__)
def test_each_step_lowers_the_energy_and_leaves_the_boundary(problem, density):
    vertices, x = problem
    step = newton_step(vertices, density, x)
    after, value = line_search(vertices.elements, density, x, step)
    fixed = np.setdiff1d(np.arange(len(x)), vertices.free)
    assert value < step.energy
    assert value == pytest.approx(energy(vertices.elements, density, after))
    assert np.array_equal(after[fixed], x[fixed])


def test_newton_converges_quadratically_near_the_minimum(problem):
    vertices, x = problem
    slopes = []
    for _ in range(12):
        step = newton_step(vertices, StVenantKirchhoff(), x)
        x, _ = line_search(vertices.elements, StVenantKirchhoff(), x, step)
        slopes.append(abs(step.slope))
    assert slopes[-1] < 1e-18
    fast = [b / a**1.5 for a, b in itertools.pairwise(slopes) if 1e-12 < b < 1e-2]
    assert min(fast) < 1  # better than linear; the slope is the square of the distance


def test_a_step_to_flat_makes_the_first_triangle_flat(problem):
    vertices, x = problem
    direction = np.random.default_rng(5).standard_normal(x.shape)
    t = step_to_flat(vertices.elements, x, direction)
    J = vertices.elements.determinants(x + t * direction)
    assert J.min() == pytest.approx(0, abs=1e-9)
    before = vertices.elements.determinants(x + 0.99 * t * direction)
    assert before.min() > 0
