"""Layers that hang on others: where they are carried, and that they stay joined."""

from __future__ import annotations

import gc
from collections.abc import Sequence
from functools import cache
from weakref import ref

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.location import Located
from core.model import Document, Easing, Keyframe, Layer, Outline, RingPoint, Turning
from core.model.easing import EASE_IN_OUT, HOLD
from core.model.edits import insert_keyframe
from core.model.turning import AS_DRAWN
from core.morph.hanging.joint import hinge
from core.morph.scene import Span, carrying, keyframe_at, layer_rings, solve_span, span_of
from tests.core.shapes import Array, ellipse, letter_l, limb, rotation

solved = cache(solve_span)
Pose = tuple[float, tuple[float, float]]
"""An angle about the origin, and then an offset."""
HUB = np.array([3.0, 0.5])
FRAMES = np.linspace(1, 25, 33)


def placed(points: Array, pose: Pose) -> Array:
    angle, offset = pose
    return points @ rotation(angle).T + offset


def layer(
    number: int, points: Sequence[tuple[int, Array]], carrier: int | None = None, **key: object
) -> Layer:
    """Return a layer whose marks are all its corners, with these keys (frame, points)."""
    count = len(points[0][1])
    marks = tuple(RingPoint(0, float(i)) for i in range(count))
    labels = tuple(f"m{i}" for i in range(count))
    keys = tuple(Keyframe(f, Outline.polygon(x), marks, **key) for f, x in points)
    return Layer(number, f"L{number}", keys, labels, carrier=carrier)


def cross(width: float = 0.3, length: float = 1.5) -> Array:
    """Return a propeller with four blades about the hub."""
    quarter = np.array([[width, -width], [length, -width], [length, width]])
    return np.concatenate([quarter @ rotation(k * np.pi / 2).T for k in range(4)]) + HUB


def shown(document: Document, number: int, frame: float) -> Array:
    """Return a layer's vertices at a frame: its mesh's in a span, or else a key's."""
    layer = document.layer(number)
    if not layer.spans or layer.easing_of(0).hold or not 1 <= frame <= 25:
        [ring] = layer_rings(document, layer, frame, solved)
        return ring
    _, s = layer.progress_at(frame)
    return carrying(document, solved)(layer, frame)(solved(span_of(layer, 0)).at(s))


def pose_of(document: Document, number: int, frame: float) -> Pose:
    """Return the pose of a rigid layer at a frame, its first key being the one unmoved."""
    start, here = (shown(document, number, f) for f in (1, frame))
    z, w = (x @ [1, 1j] for x in (start, here))
    turn = np.vdot(z - z.mean(), w - w.mean())
    assert np.abs((w - w.mean()) - turn / abs(turn) * (z - z.mean())).max() < 1e-7
    offset = w.mean() - turn / abs(turn) * z.mean()
    return float(np.angle(turn)), (offset.real, offset.imag)


BODY = letter_l()
POSES: list[Pose] = [(0.0, (0.0, 0.0)), (1.2, (9.0, -4.0))]


def body(turning: Turning = AS_DRAWN, easing: Easing = EASE_IN_OUT) -> Layer:
    keys = [(f, placed(BODY, pose)) for f, pose in zip((1, 25), POSES, strict=True)]
    return layer(1, keys, turning=turning, easing=easing)


def assert_carried(document: Document, number: int, frames: Sequence[float] | Array = FRAMES):
    """A layer is where the body takes it, as if it were painted on."""
    start = shown(document, number, 1)
    for frame in frames:
        expected = placed(start, pose_of(document, 1, frame))
        assert shown(document, number, frame) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("turning", [Turning(), Turning("clockwise", 2), Turning(path="straight")])
@pytest.mark.parametrize("easing", [EASE_IN_OUT, Easing(0.3, -0.5, 0.5, 1.6)])
def test_what_is_drawn_on_a_body_at_both_keys_stays_there_however_the_body_turns(turning, easing):
    keys = [(f, placed(cross(), pose)) for f, pose in zip((1, 25), POSES, strict=True)]
    document = Document((body(turning), layer(2, keys, 1, easing=easing)))
    assert_carried(document, 2)


@pytest.mark.parametrize("drawn", [1, 25])
def test_a_layer_with_one_key_is_carried_from_there_in_both_directions(drawn):
    pose = POSES[drawn == 25]
    document = Document((body(), layer(2, [(drawn, placed(cross(), pose))], 1)))
    assert_carried(document, 2)
    assert np.array_equal(shown(document, 2, drawn), placed(cross(), pose))
    assert shown(document, 2, 99) == pytest.approx(shown(document, 2, 25))  # the body has stopped


def test_a_layer_that_is_held_is_carried_until_its_next_key():
    moved = placed(cross(), POSES[1]) + np.array([0, 1])
    document = Document((body(), layer(2, [(1, cross()), (25, moved)], 1, easing=HOLD)))
    assert_carried(document, 2, FRAMES[:-1])
    assert np.array_equal(shown(document, 2, 25), moved)


@pytest.mark.parametrize("turns", [0, 2, 5])
def test_a_propeller_turns_about_its_hub_while_the_body_does_not_and_its_hub_is_carried(turns):
    """Drawn alike at both keys, it turns as seen from the body."""
    keys = [(f, placed(cross(), pose)) for f, pose in zip((1, 25), POSES, strict=True)]
    spinning = layer(2, keys, 1, turning=Turning("clockwise", turns))
    document = Document((body(easing=Easing()), spinning))
    mass = solved(span_of(spinning, 0)).inbetween.course.mass
    tips, angles = [], []
    for frame in np.linspace(1, 25, 201):
        pose = pose_of(document, 1, frame)
        blades = shown(document, 2, frame)
        hub = placed(HUB[None], pose)[0]
        [centre] = mass @ blades[None]
        assert centre == pytest.approx(hub, abs=1e-6)
        tips.append(complex(*(blades[0] - hub)))
        angles.append(pose[0])
    seen = np.unwrap(np.angle(tips) - angles)
    assert seen[-1] - seen[0] == pytest.approx(2 * np.pi * turns, abs=1e-6)
    assert np.diff(seen) == pytest.approx(2 * np.pi * turns / 200, abs=1e-6)  # evenly


def swinging(angles: Sequence[float], carrier: int | None) -> Document:
    """A limb that bends, and a bar that swings about a pin in it near its end."""
    trunk = [limb(bend) for bend in (0.2, 1.5)]
    bar = np.array([[-0.3, -0.2], [3.0, -0.2], [3.0, 0.2], [-0.3, 0.2]])
    keys = [
        (f, bar @ rotation(angle).T + pin_of(x))
        for f, angle, x in zip((1, 25), angles, trunk, strict=True)
    ]
    return Document((layer(1, list(zip((1, 25), trunk, strict=True))), layer(2, keys, carrier)))


def pin_of(trunk: Array) -> Array:
    return (trunk[12] + trunk[-13]) / 2


@pytest.mark.parametrize("angles", [(0.3, 1.6), (2.0, -0.5), (0.5, 0.6)])
def test_what_swings_about_a_pin_stays_pinned(angles):
    def drift(document: Document) -> float:
        pins = []
        for number in (1, 2):
            morph = solved(span_of(document.layer(number), 0))
            start = pin_of(document.layer(1).keyframes[0].outline.rings[0].points)
            there = Located.on(morph.rest, morph.triangles, start[None])
            frames = [there.interpolate(shown(document, number, frame)) for frame in FRAMES]
            pins.append(np.concatenate(frames))
        return float(np.hypot(*(pins[0] - pins[1]).T).max())

    assert drift(swinging(angles, 1)) < 0.02
    assert drift(swinging(angles, 1)) < 0.2 * drift(swinging(angles, None))


@pytest.mark.parametrize("turns", [0, 1, 3])
def test_the_hand_of_a_clock_turns_as_often_as_told_about_its_pin(turns):
    face = [placed(6 * ellipse(24, 1, 1), pose) for pose in POSES]
    hand = np.array([[-0.3, 1], [-0.3, -5], [0.3, -5], [0.3, 1]])
    hands = [
        placed(hand @ rotation(angle).T, pose)
        for angle, pose in zip((0.0, np.pi / 2), POSES, strict=True)
    ]
    turning = Turning("clockwise", turns, about="joint")
    document = Document(
        (
            layer(1, list(zip((1, 25), face, strict=True))),
            layer(2, list(zip((1, 25), hands, strict=True)), 1, turning=turning),
        )
    )
    tips, pins = [], []
    pin = [
        Located.on(m.rest, m.triangles, np.zeros((1, 2)))
        for m in (solved(span_of(drawn, 0)) for drawn in document.layers)
    ]
    for frame in np.linspace(1, 25, 97):
        ends = [place.interpolate(shown(document, i, frame)) for i, place in enumerate(pin, 1)]
        pins.append(np.hypot(*(ends[0] - ends[1])[0]))
        dial, tip = (shown(document, i, frame)[0] - ends[0][0] for i in (1, 2))
        tips.append(complex(*tip) / complex(*dial))
    seen = np.unwrap(np.angle(tips))
    assert max(pins) < 0.02
    assert seen[-1] - seen[0] == pytest.approx(np.pi / 2 + 2 * np.pi * turns, abs=1e-6)


def test_a_layer_turns_the_way_the_place_turns_that_it_hangs_on():
    """The tip of a tail that curls by five radians has turned so far, though it looks like less."""
    tail = [limb(0.0, 24), limb(5.0, 24, curl=2.0)]
    tips = [np.concatenate([x[21:24], x[24:27]]) for x in tail]
    keys = [list(zip((1, 25), poses, strict=True)) for poses in (tail, tips)]
    document = Document((layer(1, keys[0]), layer(2, keys[1], 1)))
    first, middle = (complex(*(x[2] - x[0])) for x in (shown(document, 2, f) for f in (1, 13)))
    assert np.angle(middle / first) == pytest.approx(2.4, abs=0.3)
    free = Document((layer(2, keys[1]),))
    first, middle = (complex(*(x[2] - x[0])) for x in (shown(free, 2, f) for f in (1, 13)))
    assert np.angle(middle / first) < 0


def test_a_layer_hangs_on_one_that_hangs_on_another():
    keys = [(f, placed(cross(), pose)) for f, pose in zip((1, 25), POSES, strict=True)]
    small = (cross() - HUB) / 3 + HUB
    document = Document((body(), layer(2, keys, 1), layer(3, [(1, small)], 2)))
    assert_carried(document, 3)


def test_a_layer_is_carried_through_the_keys_of_its_carrier():
    poses = [(0.0, (0.0, 0.0)), (1.2, (9.0, -4.0)), (3.0, (5.0, 5.0))]
    keys = [(f, placed(BODY, pose)) for f, pose in zip((1, 9, 25), poses, strict=True)]
    ends = [(f, placed(cross(), pose)) for f, pose in ((1, poses[0]), (25, poses[2]))]
    one, two = layer(2, ends[:1], 1), layer(3, ends, 1)
    document = Document((layer(1, keys), one, two))
    ride = [layer_rings(document, one, frame, solved)[0] for frame in (1, 5, 9, 20, 25)]
    assert ride[2] == pytest.approx(placed(cross(), poses[1]), abs=1e-6)
    assert ride[4] == pytest.approx(placed(cross(), poses[2]), abs=1e-6)
    for frame, expected in zip((5, 9, 20), ride[1:], strict=False):
        ring = layer_rings(document, two, frame, solved)[0]
        near = np.hypot(*(ring[:, None] - expected[None]).transpose(2, 0, 1)).min(axis=0)
        assert near.max() < 1e-6


def test_keys_are_shown_as_they_are_drawn_wherever_the_carrier_is():
    keys = [(f, cross() + np.array([f, 0])) for f in (4, 13, 22)]
    document = Document((body(), layer(2, keys, 1)))
    for frame, points in keys:
        [ring] = layer_rings(document, document.layer(2), frame, solved)
        assert np.array_equal(ring, points)
        [near] = layer_rings(document, document.layer(2), frame + 1e-9, solved)
        gaps = np.hypot(*(near[:, None] - points[None]).transpose(2, 0, 1)).min(axis=0)
        assert gaps.max() < 1e-6


@pytest.mark.parametrize("frame", [9, 25, 40])
def test_a_key_inserted_where_a_layer_is_carried_is_what_shows_there(frame):
    document = Document((body(), layer(2, [(1, cross())], 1)))
    before = shown(document, 2, frame)
    key, turning = keyframe_at(document, document.layer(2), frame, solved)
    assert key.outline.rings[0].points == pytest.approx(before)
    after = insert_keyframe(document, 2, key, turning)
    poses = [(f, pose_of(after, 1, f)) for f in (3, 7)]
    for f, pose in poses:
        morph = solved(span_of(after.layer(2), 0))
        _, s = after.layer(2).progress_at(f)
        found = carrying(after, solved)(after.layer(2), f)(morph.at(s))
        assert found == pytest.approx(placed(morph.rest, pose), abs=1e-6)


def test_what_is_remembered_of_joints_keeps_no_solution_alive():
    keys = [(f, placed(cross(), pose)) for f, pose in zip((1, 25), POSES, strict=True)]
    document = Document((body(), layer(2, keys, 1), layer(3, [(1, cross())], 1)))
    solutions = {
        span: solve_span(span) for span in (span_of(each, 0) for each in document.layers[:2])
    }
    alive = [ref(morph) for morph in solutions.values()]
    for drawn in document.layers:
        layer_rings(document, drawn, 9, solutions.get)
    assert len(alive) == 2
    solutions.clear()
    gc.collect()
    assert not any(morph() for morph in alive)


def test_nothing_is_carried_where_nothing_is_solved():
    keys = [(f, placed(cross(), pose)) for f, pose in zip((1, 25), POSES, strict=True)]
    document = Document((body(), layer(2, keys, 1)))

    def unsolved(span: Span) -> None:
        return None

    for frame, key in ((5, 0), (20, 1)):
        [ring] = layer_rings(document, document.layer(2), frame, unsolved)
        assert np.array_equal(ring, keys[key][1])


def waving(passes: tuple[bool, bool]) -> Document:
    """A limb that bends and swings, and a finger on it that wags; each passes its keys, or not."""
    frames = 1, 9, 13, 25
    limbs = [limb(bend) + np.array([i, i * i]) for i, bend in enumerate((0.2, 1.0, 1.9, 0.5))]
    fingers = []
    for bend, x in zip((0.3, -0.8, 0.2, 0.9), limbs, strict=True):
        tip = (x[14:16] + x[16:18][::-1]) / 2
        along = complex(*(tip[1] - tip[0]))
        fingers.append(limb(bend, 6, 3.0, 0.5) @ rotation(np.angle(along)).T + tip[0])
    layers = []
    for number, points, passing in zip((1, 2), (limbs, fingers), passes, strict=True):
        keys = list(zip(frames, points, strict=True))
        drawn = layer(number, keys, 1 if number == 2 else None, passes=passing)
        layers.append(drawn)
    return Document(tuple(layers))


def jolt(document: Document, number: int, key: int) -> float:
    """Return the change of velocity of a layer's points at a key, relative to their speed."""
    drawn, step = document.layer(number), 1e-5
    frame, velocities = drawn.keyframes[key].frame, []
    before, after = (solved(span_of(drawn, span)) for span in (key - 1, key))
    for morph, end, moment in ((before, 1, frame - step), (after, 0, frame + step)):
        _, s = drawn.progress_at(moment)
        x = carrying(document, solved)(drawn, moment)(morph.at(s))
        velocities.append((x - morph.at(end)) / (moment - frame))
    ring = np.concatenate(after.rings)
    there = Located.on(before.target, before.triangles, after.rest[ring])
    gap = there.interpolate(velocities[0]) - velocities[1][ring]
    return float(np.hypot(*gap.T).max() / np.hypot(*velocities[1].T).max())


@pytest.mark.parametrize("key", [1, 2])
def test_what_passes_through_a_key_with_its_carrier_does_so_without_a_jolt(key):
    assert jolt(waving((True, True)), 2, key) < 0.01
    assert jolt(waving((True, False)), 2, key) > 0.1


def test_what_passes_through_a_key_stays_joined_where_its_carrier_does_not_pass():
    document = waving((False, True))
    for frame in (5, 11, 19):
        places = []
        for drawn in document.layers:
            span, s = drawn.progress_at(frame)
            morph = solved(span_of(drawn, span))
            root = document.layer(2).keyframes[span].outline.rings[0].points[[0, -1]].mean(axis=0)
            there = Located.on(morph.rest, morph.triangles, root[None])
            moved = carrying(document, solved)(drawn, frame)(morph.at(s))
            places.append(there.interpolate(moved)[0])
        assert np.hypot(*(places[0] - places[1])) < 0.1


@given(st.floats(0.5, 3), st.floats(-0.8, 0.8), st.floats(-0.8, 0.8))
def test_a_hinge_is_where_nothing_slides_though_no_vertex_lies_there(angle, x, y):
    points = 2 * np.stack(np.meshgrid(*[np.linspace(-1, 1, 7)] * 2), axis=-1).reshape(-1, 2)
    pin = np.array([x, y])
    slid = (points - pin) @ (rotation(angle) - np.eye(2)).T
    weights = hinge(points, slid, 0.03 * 5)
    assert weights.sum() == pytest.approx(1)
    assert weights @ points == pytest.approx(pin, abs=0.05)


def test_what_slides_as_a_whole_is_joined_evenly():
    points = np.array([[0, 0], [2, 0], [2, 1], [0, 1]], dtype=float)
    assert hinge(points, np.ones((4, 2)), 0.1) == pytest.approx(np.full(4, 0.25))
