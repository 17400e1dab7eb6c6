"""Gaps, their derivatives, and what settles between them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.morph.motion.barrier import barrier, settle, steps_worth
from core.morph.motion.contact import Distances
from core.morph.motion.guard import TriangleGaps

COUNT = 20


def gaps(kind: str, rng: np.random.Generator) -> Distances | TriangleGaps:
    corners = np.arange(3 * COUNT).reshape(-1, 3)
    weights, felt = rng.uniform(0.1, 1, COUNT), rng.uniform(0.5, 2, COUNT)
    return {"distances": Distances, "areas": TriangleGaps}[kind](corners, weights, felt)


def places(rng: np.random.Generator) -> np.ndarray:
    return rng.normal(size=3 * COUNT) + 1j * rng.normal(size=3 * COUNT)


@pytest.mark.parametrize("kind", ["distances", "areas"])
@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6))
def test_slopes_and_bends_are_those_of_the_gaps(kind, seed):
    rng = np.random.default_rng(seed)
    found, z, h = gaps(kind, rng), places(rng), 1e-6
    every = np.arange(COUNT)
    at = found.derivatives(z, every)
    assert np.allclose(at.gaps, found(z))
    scale = 1 + np.abs(at.bends).max(axis=(1, 2))  # a point close to another bends sharply
    for i in range(6):
        step = np.zeros(3 * COUNT, dtype=complex)
        step[i // 2 :: 3] = h * (1, 1j)[i % 2]
        after, before = (found.derivatives(z + sign * step, every) for sign in (1, -1))
        slopes = (after.gaps - before.gaps) / (2 * h)
        bends = (after.slopes - before.slopes) / (2 * h)
        assert (np.abs(slopes - at.slopes[:, i]) < 1e-6 * scale).all()
        steady = np.abs(bends - at.bends[:, :, i]).max(axis=1) < 1e-3 * scale**2
        assert steady.sum() >= COUNT - 1  # one may pass from beside an edge to beyond its end


@pytest.mark.parametrize("kind", ["distances", "areas"])
@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6))
def test_no_gap_closes_within_the_free_way_and_one_does_right_after(kind, seed):
    rng = np.random.default_rng(seed)
    found, z, step = gaps(kind, rng), places(rng), 20 * places(rng)
    z[2::3] = z[::3] + (z[1::3] - z[::3]) * 1j  # all areas positive
    free = found.free_way(z, step)
    shares = np.linspace(0, 1, 200)
    if kind == "areas":
        assert all(found(z + share * free * step).min() > 0 for share in shares)
        assert found(z + 1.01 / 0.9 * free * step).min() < 0
    else:
        assert found(z + free / 0.9 * step).min() < 1e-6
        assert min(found(z + share * free * step).min() for share in shares) > 1e-6


def test_the_barrier_sets_in_smoothly_and_never_lets_a_gap_close():
    assert barrier(np.array([1.0, 2.0])).tolist() == [0, 0]
    assert np.isinf(barrier(np.array([0.0, -1.0]))).all()
    assert barrier(np.array([1 - 1e-3]))[0] < 1e-8
    assert (np.diff(barrier(np.linspace(0.01, 1, 99))) < 0).all()


def test_where_no_gap_is_felt_nothing_departs_from_the_fit():
    corners = np.array([[0, 1, 2]])
    fitted = np.array([2j, -1, 1])
    start = fitted + 0.1
    z = settle(fitted, np.eye(3), [Distances(corners, np.ones(1), np.ones(1))], start)
    assert np.allclose(z, fitted, atol=1e-12)


def test_a_point_that_is_to_pass_through_an_edge_stays_on_its_side():
    corners = np.array([[0, 1, 2]])
    start, fitted = np.array([1j, -1, 1]), np.array([-1j, -1, 1])
    z = settle(fitted, np.eye(3), [Distances(corners, np.ones(1), np.full(1, 0.5))], start)
    assert 0 < z[0].imag - z[1].imag < 0.5
    assert z.imag.sum() == pytest.approx(-1)  # all share the way that is missing
    assert np.abs(z.real - fitted.real).max() < 1e-9


@pytest.mark.parametrize("height", [0.0, -1e-3])
def test_a_start_with_a_closed_gap_is_left_as_it_is(height):
    start = np.array([0, 1, 0.5 + height * 1j])
    flat = TriangleGaps(np.array([[0, 1, 2]] * 2), np.array([1.0, -1.0]), np.ones(2))
    assert np.array_equal(settle(start + 1, np.eye(3), [flat], start), start)


@pytest.mark.parametrize("seed", range(6))
def test_triangles_all_but_flat_are_lifted_off_their_folds(seed):
    rng, k = np.random.default_rng(seed), 12
    lower, along = np.arange(k - 1), np.arange(k) / k
    start = np.concatenate([along, along + 0.5 / k + 1e-7j])
    corners = np.concatenate(
        [
            np.column_stack([lower, lower + 1, lower + k]),
            np.column_stack([lower + 1, lower + k + 1, lower + k]),
        ]
    )
    strip = TriangleGaps(corners, np.full(len(corners), 1e-3), np.full(len(corners), 1e-2))
    fitted = start.conj() + 1e-2 * rng.normal(size=(2 * k, 2)) @ [1, 1j]
    assert 0 < strip(start).min() < 1e-3
    assert strip(settle(fitted, np.eye(2 * k), [strip], start)).min() > 0.05


def test_the_more_is_held_the_fewer_steps_are_made():
    steps = [steps_worth(held) for held in (0, 100, 300, 1000, 3000)]
    assert steps == sorted(steps, reverse=True)
    assert steps[0] > steps[-1] > 1
