from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.model import Easing
from core.model.easing import EASE_IN, EASE_OUT, HOLD, LINEAR, PRESETS, WILD
from tests.core.model.shapes import easings

times = st.floats(0, 1)
ROUNDING = 1e-12


@given(easings())
def test_every_easing_is_exact_at_both_ends(easing: Easing) -> None:
    assert easing(0.0) == 0.0
    assert easing(1.0) == 1.0


@given(easings(), st.floats(-10, 10))
def test_time_outside_the_span_is_held_at_its_ends(easing: Easing, t: float) -> None:
    assert easing(t) == easing(min(max(t, 0.0), 1.0))


@given(easings(), times, times)
def test_without_overshoot_progress_never_goes_back(easing: Easing, a: float, b: float) -> None:
    early, late = sorted((a, b))
    assert easing(early) <= easing(late) + ROUNDING


@given(easings(), times)
def test_without_overshoot_progress_stays_between_the_keys(easing: Easing, t: float) -> None:
    assert 0.0 <= easing(t) <= 1.0


@given(times)
def test_linear_is_the_identity(t: float) -> None:
    assert LINEAR(t) == t


@given(st.floats(0, 1, exclude_max=True))
def test_hold_waits_for_the_next_key(t: float) -> None:
    assert HOLD(t) == 0.0


@given(easings(), times)
def test_a_curve_turned_round_runs_backwards(easing: Easing, t: float) -> None:
    easing = replace(easing, hold=False)
    turned = Easing(1 - easing.x2, 1 - easing.y2, 1 - easing.x1, 1 - easing.y1)
    # x may be as flat as t³ at an end, where time resolves no finer than the cube root of rounding
    assert turned(1 - t) == pytest.approx(1 - easing(t), abs=1e-4)


@given(st.floats(0.05, 0.95))
def test_easing_in_starts_slowly_and_easing_out_ends_slowly(t: float) -> None:
    assert EASE_IN(t) < t < EASE_OUT(t)


def test_an_easing_may_overshoot_between_its_ends() -> None:
    assert max(Easing(0.3, 1.8, 0.6, 1.0)(t / 20) for t in range(21)) > 1.05


def test_presets_have_distinct_names_and_curves() -> None:
    assert len(set(PRESETS.values())) == len(PRESETS)


@given(easings(), st.floats(0.01, 0.99), times)
def test_the_parts_of_a_split_run_one_after_the_other_are_the_whole(
    easing: Easing, at: float, t: float
) -> None:
    early, late = sorted((easing.x1, easing.x2))
    easing = replace(easing, x1=early, x2=late)
    before, after = easing.split(at)
    s = easing(at)
    parts = s * before(t / at) if t < at else s + (1 - s) * after((t - at) / (1 - at))
    # as above, x may be too flat for time to tell parameters apart
    assert parts == pytest.approx(easing(t), abs=1e-4)


@given(
    easings(),
    st.floats(-2, 3),
    st.floats(-2, 3),
    st.floats(0, 1, exclude_min=True, exclude_max=True),
)
def test_the_parts_of_any_split_are_timing_curves(
    easing: Easing, y1: float, y2: float, at: float
) -> None:
    for part in replace(easing, y1=y1, y2=y2).split(at):
        assert 0 <= part.x1 <= 1
        assert 0 <= part.x2 <= 1
        assert abs(part.y1) <= WILD + 1
        assert abs(part.y2) <= WILD + 1


def test_an_overshoot_that_is_split_overshoots_as_before() -> None:
    whole = Easing(0.3, 1.8, 0.6, 1.0)
    before, after = whole.split(0.25)
    s = whole(0.25)
    for t in (0.3, 0.5, 0.9):
        assert s + (1 - s) * after((t - 0.25) / 0.75) == pytest.approx(whole(t))
    assert before(0.5) == pytest.approx(whole(0.125) / s)


def test_a_curve_split_where_it_has_not_risen_goes_on_evenly() -> None:
    flat = Easing(1.0, 0.0, 1.0, 0.0)
    assert flat.split(1e-4)[0] == LINEAR
    assert flat.split(1e-4)[1](0.5) == pytest.approx(flat(0.50005))


@pytest.mark.parametrize("easing", [HOLD, LINEAR])
def test_the_parts_of_a_hold_hold_and_those_of_an_even_motion_are_even(easing: Easing) -> None:
    assert easing.split(0.3) == (easing, easing)
