"""Frames of a solved morph: pure functions of s, in whichever thread they are made."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import core
from tests.core.morph.motion.test_guard import ragged

MOMENTS = np.linspace(0, 1.5, 49)
"""Past the end, too, as an easing that overshoots goes: only there frames of this must be held."""


@pytest.fixture(scope="module")
def morph() -> core.Morph:
    """Two ragged stars, marked crosswise."""
    return core.solve(ragged(2), ragged(1002), [(i, (i + 1) % 14) for i in range(14)])


def test_a_plain_frame_is_the_frame_itself_and_one_that_must_be_held_is_none(morph: core.Morph):
    plain = [morph.plain(s) for s in MOMENTS]
    assert 0 < sum(frame is None for frame in plain) < len(MOMENTS) - 2
    for s, frame in zip(MOMENTS, plain, strict=True):
        assert frame is None or np.array_equal(frame, morph.at(s))


def test_frames_that_many_threads_make_at_once_are_those_of_one(morph: core.Morph):
    alone = [morph.at(s) for s in MOMENTS]
    with ThreadPoolExecutor(8) as pool:
        for frame, expected in zip(pool.map(morph.at, [*MOMENTS] * 4), alone * 4, strict=True):
            assert np.array_equal(frame, expected)


def test_frames_cannot_be_written_to(morph: core.Morph):
    for frame in (morph.at(0.5), morph.plain(0), morph.at(1)):
        with pytest.raises(ValueError, match="read-only"):
            frame += 1


def test_a_swapped_pair_moves_in_units_of_the_same_size():
    small, large = ragged(2), 30 * ragged(1002)
    marks = [(i, i) for i in range(14)]
    there, back = core.solve(small, large, marks), core.solve(large, small, marks)
    assert there.unit == pytest.approx(back.unit)
