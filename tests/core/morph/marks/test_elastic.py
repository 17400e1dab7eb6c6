"""The cheapest path, against the plain recursion it stands for."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.morph.marks.elastic import STEEPEST, STEPS, cheapest_paths

tables = st.tuples(st.integers(2, 9), st.integers(2, 9)).flatmap(
    lambda shape: arrays(float, shape, elements=st.floats(0, 3, width=32))
)


def step_cost(table, i, j, a, b):
    """What a step that ends at (i, j) costs, point by point."""
    length = max(a, b)
    along = [(i - round(a * k / length), j - round(b * k / length)) for k in range(length + 1)]
    along[-1] = i - a, j - b
    values = [table[cell] for cell in along]
    mean = (sum(values) - 0.5 * (values[0] + values[-1])) / length
    return a + b - 2 * np.sqrt(a * b) + np.sqrt(a * b) * mean


def cheapest_cost(table, slack=0):
    """The least cost of any path, by recursion from the end."""

    @cache
    def cost(i, j):
        if i == 0:
            return 0.0 if j <= slack else np.inf
        ways = [(a, b) for a, b in STEPS if a <= i and b <= j]
        return min(
            (cost(i - a, j - b) + step_cost(table, i, j, a, b) for a, b in ways), default=np.inf
        )

    n, m = table.shape
    return min(cost(n - 1, j) for j in range(m - 1 - slack, m))


@given(tables)
@settings(max_examples=60, deadline=None)
def test_no_path_is_cheaper_than_the_one_found(table):
    _, costs = cheapest_paths(table[None].astype(np.float32))
    assert costs[0] == pytest.approx(cheapest_cost(table), rel=1e-4, abs=1e-4)


@given(tables, st.integers(0, 2))
@settings(max_examples=30, deadline=None)
def test_slack_frees_both_ends(table, slack):
    slack = min(slack, table.shape[1] - 1)
    _, costs = cheapest_paths(table[None].astype(np.float32), slack=slack)
    assert costs[0] == pytest.approx(cheapest_cost(table, slack), rel=1e-4, abs=1e-4)


@given(tables)
@settings(max_examples=30, deadline=None)
def test_source_and_target_may_change_places(table):
    _, there = cheapest_paths(table[None].astype(np.float32))
    _, back = cheapest_paths(table.T[None].astype(np.float32))
    assert there[0] == pytest.approx(back[0], rel=1e-4, abs=1e-4)


def test_a_path_takes_allowed_steps_from_corner_to_corner():
    rng = np.random.default_rng(0)
    (path,), _ = cheapest_paths(rng.random((1, 41, 61)).astype(np.float32))
    assert path[0].tolist() == [0, 0]
    assert path[-1].tolist() == [40, 60]
    assert {*map(tuple, np.diff(path, axis=0).tolist())} <= {*STEPS}


def test_tables_are_solved_side_by_side_as_if_alone():
    rng = np.random.default_rng(1)
    several = rng.random((4, 31, 33)).astype(np.float32)
    paths, costs = cheapest_paths(several, (1.0, 0.9), 2)
    for table, path, cost in zip(several, paths, costs, strict=True):
        (alone,), alone_cost = cheapest_paths(table[None], (1.0, 0.9), 2)
        assert np.array_equal(path, alone)
        assert cost == alone_cost[0]


def test_without_misfits_the_path_is_straight_and_free():
    (path,), costs = cheapest_paths(np.zeros((1, 21, 21), dtype=np.float32))
    assert np.array_equal(path[:, 0], path[:, 1])
    assert costs[0] == 0


def test_the_path_keeps_to_where_all_fits():
    valley = np.interp(np.arange(61), [0, 20, 40, 60], [0, 40, 50, 60])
    misfits = np.abs(np.arange(61) - valley[:, None])
    (path,), _ = cheapest_paths(misfits[None].astype(np.float32))
    assert np.abs(path[:, 1] - valley[path[:, 0]]).max() <= 1


def test_more_than_the_steepest_slope_has_no_path():
    _, costs = cheapest_paths(np.zeros((1, 2, STEEPEST + 2), dtype=np.float32))
    assert np.isinf(costs[0])
