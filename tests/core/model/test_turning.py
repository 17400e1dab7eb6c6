"""How far a span turns, from the nearest angle and what the artist chose."""

from __future__ import annotations

from math import pi, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.model import Turning
from core.model.turning import SLACK

ANGLES = st.floats(-pi, pi, exclude_max=True)
DIRECTIONS = st.sampled_from(["automatic", "clockwise", "counter-clockwise"])
TURNS = st.integers(0, 5)


@given(ANGLES, DIRECTIONS, TURNS)
def test_every_choice_ends_where_the_key_is(nearest: float, direction: str, turns: int):
    whole = (Turning(direction, turns).angle(nearest) - nearest) / tau
    assert whole == pytest.approx(round(whole))


@given(ANGLES, TURNS)
def test_clockwise_is_positive_and_the_other_way_its_mirror_image(nearest: float, turns: int):
    clockwise = Turning("clockwise", turns).angle(nearest)
    assert tau * turns - SLACK <= clockwise <= tau * (turns + 1) - SLACK
    if nearest > -pi:
        assert Turning("counter-clockwise", turns).angle(-nearest) == pytest.approx(-clockwise)


@given(ANGLES)
def test_without_a_choice_a_span_takes_the_shorter_way(nearest: float):
    assert Turning().angle(nearest) == nearest


@pytest.mark.parametrize("nearest", [-0.01, 0.0, 0.01])
@pytest.mark.parametrize("turns", [0, 1, 3])
def test_a_hand_that_shook_does_not_add_a_turn(nearest: float, turns: int):
    assert Turning("clockwise", turns).angle(nearest) == pytest.approx(nearest + tau * turns)
    assert Turning("automatic", turns).angle(nearest) == pytest.approx(nearest + tau * turns)
    assert Turning("counter-clockwise", turns).angle(nearest) == pytest.approx(
        nearest - tau * turns
    )


@given(ANGLES, DIRECTIONS, TURNS, st.floats(0.01, 0.99))
def test_the_parts_of_a_span_turn_as_far_as_the_whole(
    nearest: float, direction: str, turns: int, s: float
):
    whole = Turning(direction, turns)
    angle = whole.angle(nearest)
    for part, share in zip(whole.split(angle, s), (s, 1 - s), strict=True):
        wrapped = (share * angle + pi) % tau - pi
        off = abs(part.angle(wrapped) - share * angle) / tau
        assert off == pytest.approx(round(off), abs=1e-9)
        edge = abs((abs(share * angle) + SLACK) / tau % 1 - 0.5) > 0.499 or abs(wrapped) > 3.14
        assert off < 1e-9 or edge  # at the edge of a turn rounding decides
