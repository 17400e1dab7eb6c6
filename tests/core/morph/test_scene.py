"""What shows at a frame, and what of it becomes a key."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from core.geometry.flatten import flatten
from core.model import Document, Easing, Keyframe, Layer, Outline, Recipe, RingPoint, Turning
from core.model.easing import HOLD, LINEAR
from core.model.edits import insert_keyframe
from core.morph.morph import Morph
from core.morph.scene import Span, keyframe_at, layer_rings, solve_span
from tests.core.shapes import letter_l, rotation

SOURCE = Outline.polygon(letter_l())
TARGET = SOURCE.transformed(rotation(1.0), [4, 2])
MARKS = (RingPoint(0, 1.0), RingPoint(0, 4.5))
SPAN = Span(SOURCE, TARGET, tuple(zip(MARKS, MARKS, strict=True)), ("a", "b"), Recipe())


@pytest.fixture(scope="module")
def morph() -> Morph:
    return solve_span(SPAN)


def layer(easing: Easing = LINEAR) -> Layer:
    keys = Keyframe(1, SOURCE, MARKS, easing), Keyframe(11, TARGET, MARKS)
    return Layer(1, "L", keys, ("a", "b"))


def unsolved(span: Span) -> None:
    return None


@pytest.mark.parametrize("easing", [LINEAR, HOLD, Easing(0.3, 0, 0.5, 2.5), Easing(0.3, -2, 1, 1)])
@pytest.mark.parametrize("frame", [-3, 1, 3, 6, 9, 11, 20])
def test_the_key_made_at_a_frame_is_what_shows_there(easing: Easing, frame: int, morph: Morph):
    shown = layer_rings(Document(), layer(easing), frame, lambda span: morph)
    key, _ = keyframe_at(Document(), layer(easing), frame, lambda span: morph)
    assert key.frame == frame
    drawn = [line.points for line in flatten(key.outline)]
    for ring, points in zip(drawn, shown, strict=True):
        assert apart(ring, points) < 1e-3 * np.ptp(points)


def test_a_key_made_between_has_the_marks_where_they_travelled(morph: Morph):
    key, _ = keyframe_at(Document(), layer(), 6, lambda span: morph)
    places = np.array([SOURCE.position(mark) for mark in MARKS])
    vertices = [int(np.argmin(np.hypot(*(morph.rest - place).T))) for place in places]
    found = np.array([key.outline.position(mark) for mark in key.marks])
    assert np.allclose(found, morph.at(0.5)[vertices], atol=1e-9)
    document = insert_keyframe(Document((layer(),)), 1, key)
    assert [k.frame for k in document.layers[0].keyframes] == [1, 6, 11]


@pytest.mark.parametrize(("frame", "key"), [(1, 0), (5, 0), (7, 1), (11, 1)])
def test_a_span_without_a_solution_shows_the_nearest_key(frame: int, key: int):
    [ring] = layer_rings(Document(), layer(), frame, unsolved)
    assert np.array_equal(ring, layer().keyframes[key].outline.rings[0].points)


@pytest.mark.parametrize("easing", [HOLD, Easing(0.6, 0, 0.9, 0.4), Easing(0.2, 1.4, 0.6, 1)])
def test_a_rigid_motion_is_the_same_with_a_key_made_of_an_in_between(easing: Easing, morph: Morph):
    before = layer(easing)
    assert_same_with_a_key_between(before, morph)


@pytest.mark.parametrize("direction", ["clockwise", "counter-clockwise"])
@pytest.mark.parametrize(("turns", "path"), [(0, "arc"), (1, "straight"), (2, "straight")])
def test_whole_turns_are_the_same_with_a_key_made_of_an_in_between(
    direction: str, turns: int, path: str, morph: Morph
):
    turning = Turning(direction, turns, path)
    keys = Keyframe(1, SOURCE, MARKS, turning=turning), Keyframe(11, TARGET, MARKS)
    assert_same_with_a_key_between(Layer(1, "L", keys, ("a", "b")), morph.along(turning))


def assert_same_with_a_key_between(before: Layer, morph: Morph) -> None:
    key, turning = keyframe_at(Document(), before, 5, lambda span: morph)
    after = insert_keyframe(Document((before,)), 1, key, turning).layers[0]
    for frame in (2, 4, 5, 8, 10):
        [was] = layer_rings(Document(), before, frame, lambda span: morph)
        [now] = layer_rings(Document(), after, frame, solve_span)
        assert apart(was, now) < 2e-3 * np.ptp(was)


def apart(one: np.ndarray, other: np.ndarray) -> float:
    """How far two closed polygons are from each other."""
    return float(shapely.hausdorff_distance(shapely.linearrings(one), shapely.linearrings(other)))
