"""Through keys without a jolt, though the spans on both sides have meshes of their own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.location import Located
from core.model import Document, Easing, Keyframe, Layer, Outline, RingPoint
from core.model.easing import EASE_IN_OUT, HOLD, LINEAR
from core.morph import solved
from core.morph.morph import Morph
from core.morph.passage import between
from core.morph.quality import folds
from core.morph.scene import layer_rings, solve_span, span_of
from tests.core.shapes import letter_l, limb, rotation

STEP = 1e-6
CORNERS = tuple(RingPoint(0, float(i)) for i in range(6))
MARKS = (RingPoint(0, 0.0), RingPoint(0, 15.0), RingPoint(0, 16.0), RingPoint(0, 31.0))


def layer_of(*keys: tuple[int, np.ndarray], marks: tuple[RingPoint, ...], passes: bool) -> Layer:
    labels = tuple("abcdefgh"[: len(marks)])
    frames = (
        Keyframe(frame, Outline.polygon(points), marks, passes=passes) for frame, points in keys
    )
    return Layer(1, "L", tuple(frames), labels)


def waving(passes: bool, easing: Easing = LINEAR) -> Layer:
    """A limb that bends one way, further, and back, at uneven frames."""
    keys = (
        (1, limb(0.2)),
        (9, limb(1.0) + np.array([3, 1])),
        (13, limb(1.9) + np.array([4, 4])),
        (25, limb(0.5)),
    )
    layer = layer_of(*keys, marks=MARKS, passes=passes)
    eased = tuple(replace(key, easing=easing) for key in layer.keyframes)
    return replace(layer, keyframes=eased)


def turning(*poses: tuple[int, float]) -> Layer:
    """An L that turns about a far point, by so many radians at each frame, and passes its keys."""
    pole = np.array([20.0, 5.0])
    keys = ((frame, (letter_l() - pole) @ rotation(a).T + pole) for frame, a in poses)
    return layer_of(*keys, marks=CORNERS, passes=True)


def solve(layer: Layer) -> list[Morph]:
    return [solve_span(span_of(layer, index)) for index in range(layer.spans)]


def jolt(layer: Layer, key: int) -> float:
    """Return the change of velocity of boundary points at a key, relative to their speed."""
    before, after = solve(layer)[key - 1 : key + 1]
    lengths = np.diff([k.frame for k in layer.keyframes])[key - 1 : key + 1]
    arriving, leaving = (layer.easing_of(i) for i in (key - 1, key))
    s0, s1 = arriving(1 - STEP), leaving(STEP)
    earlier = (before.target - before.at(s0)) / (STEP * lengths[0])
    later = (after.at(s1) - after.rest) / (STEP * lengths[1])
    ring = np.concatenate(after.rings)
    earlier = Located.on(before.target, before.triangles, after.rest[ring]).interpolate(earlier)
    speed = np.hypot(*later[ring].T).max()
    return float(np.hypot(*(earlier - later[ring]).T).max() / speed)


@pytest.mark.parametrize("key", [1, 2])
def test_the_velocity_is_the_same_before_and_after_a_key_that_is_passed(key: int):
    assert jolt(waving(passes=False), key) > 0.5
    assert jolt(waving(passes=True), key) < 0.01


def test_easing_slows_nothing_at_a_key_that_is_passed():
    assert jolt(waving(passes=True, easing=EASE_IN_OUT), 1) < 0.01
    layer = waving(passes=True, easing=EASE_IN_OUT)
    assert layer.easing_of(0)(1 - STEP) == pytest.approx(1 - STEP, abs=1e-9)
    assert layer.easing_of(0)(STEP) < STEP / 10  # it does at the first key, which cannot be passed


def test_keys_are_exact_and_nothing_folds():
    layer = waving(passes=True)
    for index, morph in enumerate(solve(layer)):
        for s, key in ((0, index), (1, index + 1)):
            drawn = layer.keyframes[key].outline.rings[0].points
            assert {tuple(p) for p in drawn} <= {tuple(p) for p in morph.at(s)}
            near = morph.at(abs(s - 1e-12))
            assert near == pytest.approx(morph.at(s), abs=1e-8)
        assert not any(len(folds(morph.at(t), morph.triangles)) for t in np.linspace(0, 1, 33))


def test_a_shape_that_turns_evenly_about_a_point_goes_on_doing_so_through_its_keys():
    poses = (1, 0.0), (5, 0.4), (15, 1.4), (21, 2.0)
    layer, pole = turning(*poses), np.array([20.0, 5.0])
    for frame in np.linspace(1, 21, 41):
        [ring] = layer_rings(Document(), layer, float(frame), solve_span)
        [start] = layer_rings(Document(), layer, 1.0, solve_span)
        expected = (start - pole) @ rotation(0.1 * (frame - 1)).T + pole
        gaps = np.hypot(*(ring[:, None] - expected[None]).transpose(2, 0, 1)).min(axis=0)
        assert gaps.max() < 1e-7


@pytest.mark.parametrize("angles", [(0, 1.0, 1.1, 2.5), (0, 1.0, 0.2, 0.9), (0, 0.9, 0.9, 2)])
def test_no_span_turns_further_than_its_keys(angles: tuple[float, ...]):
    layer = turning(*zip((1, 5, 15, 21), angles, strict=True))
    for index, morph in enumerate(solve(layer)):
        edge = [complex(*(x[1] - x[0])) for x in map(morph.at, np.linspace(0, 1, 41))]
        turned = np.unwrap(np.angle(edge)) - np.angle(edge[0])
        assert (np.diff(turned) * np.sign(angles[index + 1] - angles[index]) > -1e-9).all()


def test_a_span_beyond_which_nothing_can_be_solved_moves_as_if_it_ended_there():
    layer = waving(passes=True)
    bow = Outline.polygon([[0, 0], [4, 4], [4, 0], [0, 4.1]])
    broken = replace(layer.keyframes[3], outline=bow, marks=tuple(RingPoint(0, 0.0) for _ in MARKS))
    layer = replace(layer, keyframes=(*layer.keyframes[:3], broken))
    alone = replace(span_of(layer, 1), after=None)
    assert np.array_equal(solve_span(span_of(layer, 1)).at(0.7), solve_span(alone).at(0.7))


def test_frames_do_not_depend_on_what_was_solved_before():
    layer = waving(passes=True)
    first = [morph.at(0.3) for morph in solve(layer)]
    solved._known.clear()
    second = [solve_span(span_of(layer, index)).at(0.3) for index in (2, 1, 0)][::-1]
    assert all(np.array_equal(a, b) for a, b in zip(first, second, strict=True))


def test_the_work_for_a_span_and_its_neighbours_is_told_as_one():
    layer = waving(passes=True)
    for index in range(layer.spans):
        solved._known.clear()
        told: list[float] = []
        solve_span(span_of(layer, index), lambda fraction, stage, told=told: told.append(fraction))
        assert told == sorted(told)
        assert told[0] == 0
        assert told[-1] == 1


def test_a_hold_is_no_motion_to_pass_to():
    layer = waving(passes=True)
    held = replace(layer.keyframes[1], easing=HOLD)
    layer = replace(layer, keyframes=(layer.keyframes[0], held, *layer.keyframes[2:]))
    assert span_of(layer, 0).after is None
    assert span_of(layer, 2).before is None
    assert layer.easing_of(1) == HOLD


VECTORS = st.lists(st.floats(-9, 9), min_size=2, max_size=2).map(lambda v: np.array([v]).T)
DURATIONS = st.tuples(st.floats(0.1, 9), st.floats(0.1, 9))


@given(VECTORS, DURATIONS)
def test_between_equal_rates_lies_that_rate_and_between_opposite_ones_none(rate, durations):
    assert between(rate, rate, durations) == pytest.approx(rate)
    assert between(rate, -3 * rate, durations) == pytest.approx(np.zeros((2, 1)))


@given(VECTORS, VECTORS, DURATIONS, st.floats(-3, 3))
def test_a_rate_between_turns_with_the_others_and_is_at_most_thrice_the_slower(
    first, second, durations, angle
):
    R, found = rotation(angle), between(first, second, durations)
    assert between(R @ first, R @ second, durations) == pytest.approx(R @ found, abs=1e-9)
    assert between(second, first, durations[::-1]) == pytest.approx(found, abs=1e-9)
    slower = min(np.linalg.norm(first), np.linalg.norm(second))
    assert np.linalg.norm(found) <= 3 * slower + 1e-9
