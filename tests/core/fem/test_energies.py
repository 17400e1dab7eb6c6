import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.fem.elements import Elements
from core.fem.energies import (
    Dirichlet,
    Fairness,
    FoldoverFree,
    InverseDirichlet,
    StVenantKirchhoff,
    SymmetricDirichlet,
)
from core.fem.newton import energy

DENSITIES = [
    Dirichlet(),
    StVenantKirchhoff(1.3, 0.7),
    SymmetricDirichlet(),
    InverseDirichlet(),
    Fairness(0.3, 2.0),
    FoldoverFree(0.1),
]
singular = st.tuples(st.floats(0.3, 3), st.floats(0.1, 1)).map(lambda p: (p[0], p[0] * p[1]))


@pytest.mark.parametrize("density", DENSITIES, ids=lambda d: type(d).__name__)
@given(singular, st.booleans())
def test_derivatives_are_those_of_the_value(density, sigma, mirrored):
    s1, s2 = (np.array([s]) for s in sigma)
    if mirrored and not density.barrier:
        s2 = -s2
    h = 1e-5

    def value(i, j):
        return density.value(s1 + i * h, s2 + j * h)[0]

    d = density.derivatives(s1, s2)
    scale = 1 + abs(value(0, 0))
    assert d.d1[0] == pytest.approx((value(1, 0) - value(-1, 0)) / (2 * h), abs=1e-4 * scale)
    assert d.d2[0] == pytest.approx((value(0, 1) - value(0, -1)) / (2 * h), abs=1e-4 * scale)
    second = 3e-2 * scale + 1e-3 * max(abs(d.d11[0]), abs(d.d22[0]))
    for found, differences in (
        (d.d11, value(1, 0) - 2 * value(0, 0) + value(-1, 0)),
        (d.d22, value(0, 1) - 2 * value(0, 0) + value(0, -1)),
        (d.d12, (value(1, 1) - value(1, -1) - value(-1, 1) + value(-1, -1)) / 4),
    ):
        assert found[0] == pytest.approx(differences / h**2, abs=second)


@pytest.mark.parametrize("density", [StVenantKirchhoff(), SymmetricDirichlet()])
def test_an_isometry_costs_least(density):
    one = np.ones(1)
    best = density.value(one, one)[0]
    grid = np.linspace(0.3, 3, 50)
    s1, s2 = (s.ravel() for s in np.meshgrid(grid, grid))
    assert (density.value(s1, s2) >= best).all()
    d = density.derivatives(one, one)
    assert (d.d1[0], d.d2[0]) == (0, 0)


def test_a_flat_triangle_costs_infinitely_only_under_a_barrier():
    one, flat = np.ones(1), np.zeros(1)
    assert np.isinf(SymmetricDirichlet().value(one, flat))
    assert np.isinf(SymmetricDirichlet().value(one, -one))
    assert np.isinf(InverseDirichlet().value(one, flat))
    assert np.isinf(Fairness(0.3, 1.0).value(one, flat))
    assert np.isfinite(StVenantKirchhoff().value(one, flat))
    assert np.isfinite(FoldoverFree(0.1).value(one, -one))


def test_the_papers_material_cannot_tell_a_mirrored_triangle_at_lambda_zero():
    material = StVenantKirchhoff(1.0, 0.0)
    s1, s2 = np.array([1.4]), np.array([0.8])
    assert material.value(s1, s2) == material.value(s1, -s2)


def test_distortion_is_the_same_whichever_end_is_taken_for_the_rest_shape():
    random = np.random.default_rng(3)
    source, target = (
        np.array([[0, 0], [1, 0], [0, 1]]) + 0.3 * random.random((3, 2)) for _ in "ab"
    )
    triangle = np.array([[0, 1, 2]])
    here, there = Elements.of(source, triangle), Elements.of(target, triangle)
    forth = energy(here, SymmetricDirichlet(), target)
    assert forth > 1.01 * here.areas[0]
    assert energy(there, InverseDirichlet(), source) == pytest.approx(forth)


def test_fairness_costs_nothing_above_the_quality_asked_for_and_grows_below():
    fairness = Fairness(0.5, 1.0)
    ratio = np.array([1.0, 3.0, 3.8, 5.0, 9.0])
    quality = 2 * ratio / (ratio**2 + 1)
    cost = fairness.value(7 * ratio, np.full(5, 7.0))
    assert ((cost == 0) == (quality >= 0.5)).all()
    assert (np.diff(cost[quality < 0.5]) > 0).all()
