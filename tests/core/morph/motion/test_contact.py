"""Boundaries that would cross in between, and the contact that keeps them apart."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

import core
from core.geometry.crossing import crosses_itself
from core.morph.motion.barrier import Gaps, barrier
from core.morph.motion.contact import REACH, Contact
from core.morph.quality import folds
from core.morph.soundness import check_frame
from tests.core.shapes import Array, ellipse, letter_l, rotation

TIMES = np.linspace(0, 1, 33)
CORNERS = [0, 1, 3, 26, 27, 51, 74, 75]
"""Places of the two prongs that are marked: their base, roots and tips."""


def prong(root: float, bend: float) -> Array:
    """Return a prong as a path up its right side and down its left, its upper part bent."""
    s = np.linspace(0, 1, 24)
    angle = np.pi / 2 + bend * np.clip((s - 0.4) / 0.6, 0, 1)
    ahead = np.column_stack([np.cos(angle), np.sin(angle)])
    middle = [root, 0] + np.cumsum(ahead, axis=0) * 5 / 23 - ahead[0] * 5 / 23
    aside = np.column_stack([-ahead[:, 1], ahead[:, 0]]) * 0.175
    return np.vstack([middle - aside, (middle + aside)[::-1]])


def prongs(left: float, right: float, gap: float = 3.8) -> Array:
    """Return a base with two prongs that stand ``gap`` apart and are bent by angles."""
    base = [[-0.6, -0.8], [gap + 0.6, -0.8], [gap + 0.6, 0]]
    return np.vstack([base, prong(gap, right), prong(0, left), [[-0.6, 0]]])


def solve(source: Array, target: Array) -> core.Morph:
    return core.solve(source, target, [(k, k) for k in CORNERS])


UNCURLING = prongs(-4.2, 4.2), prongs(-0.2, 0.5)
"""Curled up as well as stretched out they are clear of each other, but not on the way."""
SWAPPING = prongs(-4.2, 0, 3), prongs(0, 4.2, 3)
"""The left one reaches over the right one at first, under it at last: they must pass."""


def crossing(morph: core.Morph, frames: list[Array]) -> int:
    return sum(crosses_itself([frame[ring] for ring in morph.rings]) for frame in frames)


def plain_frames(morph: core.Morph) -> list[Array]:
    shape = morph.inbetween.shape
    return [shape.fit(shape.ideal(t)) for t in TIMES]


def test_limbs_that_would_cross_on_the_way_are_kept_apart():
    morph = solve(*UNCURLING)
    assert crossing(morph, plain_frames(morph)) >= 4
    frames = [morph.at(t) for t in TIMES]
    assert crossing(morph, frames) == 0
    assert not any(len(folds(frame, morph.triangles)) for frame in frames)


def test_contact_is_felt_at_neither_end():
    morph = solve(*UNCURLING)
    shape = morph.inbetween.shape
    for s, end in ((0.0, morph.rest), (1.0, morph.target)):
        x = shape(s)
        assert np.allclose(x, shape.fit(shape.ideal(s)), rtol=0, atol=1e-11)
        near = morph.at(abs(s - 1e-12))
        assert np.abs(near - end).max() < 1e-9 * np.ptp(end)


def test_where_nothing_is_near_frames_are_the_plain_fits():
    morph = core.solve(ellipse(), letter_l() @ rotation(0.4).T)
    shape = morph.inbetween.shape
    for t, fitted in zip(TIMES, plain_frames(morph), strict=True):
        assert np.allclose(shape(t), fitted, rtol=0, atol=1e-11)


def test_frames_in_contact_do_not_depend_on_the_order_they_are_asked_in():
    first, second = solve(*UNCURLING), solve(*UNCURLING)
    forward = [first.at(t) for t in TIMES]
    shuffled = np.random.default_rng(0).permutation(len(TIMES))
    for k in shuffled:
        assert np.array_equal(second.at(TIMES[k]), forward[k])


def speed(motion: Callable[[float], Array], steps: int) -> float:
    """Return that of the fastest vertex between neighbouring frames."""
    frames = [motion(t) for t in np.linspace(0, 1, steps + 1)]
    centred = [frame - frame.mean(axis=0) for frame in frames]
    return steps * max(np.abs(b - a).max() for a, b in pairwise(centred))


@pytest.mark.parametrize("ends", [UNCURLING, SWAPPING], ids=["uncurling", "swapping"])
def test_limbs_that_meet_move_without_a_jump(ends):
    morph = solve(*ends)
    shape = morph.inbetween.shape
    assert crossing(morph, plain_frames(morph)) >= 4
    plain = speed(lambda t: shape.fit(shape.ideal(t)), 256)
    coarse, fine = (speed(shape, steps) for steps in (256, 1024))
    assert coarse < 1.5 * plain
    assert fine < 1.1 * coarse  # a jump would be four times as fast


def test_limbs_that_must_pass_one_another_cross_and_it_is_told_where():
    morph = solve(*SWAPPING)
    crossed = 0
    for k, s in enumerate(TIMES):
        frame = morph.at(s)
        found = check_frame(k, morph, frame)
        assert found.folds == 0
        assert len(found.places) == found.crossings
        assert bool(found.crossings) == crosses_itself([frame[ring] for ring in morph.rings])
        crossed += found.crossings > 0
    assert 0 < crossed < len(TIMES) / 2
    assert morph.inbetween.shape.limbs_pass
    assert not solve(*UNCURLING).inbetween.shape.limbs_pass


def test_limbs_within_a_hole_are_kept_apart_too():
    def room(left: float, right: float) -> list[Array]:
        wall = np.array([[-2.5, -1], [6.3, -1], [6.3, 7], [-2.5, 7]])
        inside = [[-1.7, 6], [5.5, 6], [5.5, 0]]
        return [wall, np.vstack([inside, prong(3.8, right), prong(0, left), [[-1.7, 0]]])]

    marks = [((ring, k), (ring, k)) for ring, ks in ((0, range(4)), (1, CORNERS)) for k in ks]
    morph = core.solve(room(-4.2, 4.2), room(-0.2, 0.5), marks)
    assert crossing(morph, plain_frames(morph)) >= 4
    assert crossing(morph, [morph.at(t) for t in TIMES]) == 0


def contact_of(z: Array) -> Contact:
    return Contact([np.arange(len(z))], z, z)


def energy(gaps: Gaps, z: Array) -> float:
    return float(gaps.weights @ barrier(gaps(z)))


@settings(max_examples=20)
@given(st.integers(0, 10**6))
def test_near_pairs_are_those_within_reach(seed):
    rng = np.random.default_rng(seed)
    contact = contact_of(np.array(ellipse(24)) @ [1, 1j])
    z = rng.uniform(0, 0.2, 24) + 1j * rng.uniform(0, 0.2, 24)
    found = set(contact.near(z, 1.0).tolist())
    points = np.column_stack([z.real, z.imag])
    for vertex in range(24):
        for edge in range(24):
            if vertex in (edge, (edge + 1) % 24):
                continue
            ends = LineString([points[edge], points[(edge + 1) % 24]])
            near = ends.distance(Point(points[vertex])) < REACH  # the ellipse is far from itself
            assert (vertex * 24 + edge in found) == near


TOOTH = [1.5 + 1j, 0.4 + 1j, 0.4 + 0.7j, 0.5 + 0.4j, 0.6 + 0.7j, 1.2 + 0.7j]
WALL = [1.2, 0.8, 0.6, 0.4, 0.2, 0, -0.3j, 1.5 - 0.3j]
CLAMP = np.array([*TOOTH, *WALL])
"""A clamp with a tooth on its upper arm, above the wall of the lower one; counter-clockwise."""
TIP = 3


def felt_at_the_tip(z: Array) -> float:
    contact = contact_of(CLAMP)
    pairs = contact.near(z, 1.0)
    pairs = pairs[pairs // len(z) == TIP]
    return energy(contact.gaps(pairs, np.arange(len(z))), z)


def test_a_point_that_slides_along_a_wall_feels_the_same_all_along():
    felt = []
    for x in np.linspace(0.25, 0.75, 51):  # past two vertices of the wall
        z = CLAMP.copy()
        z[TIP] = x + 0.5j * REACH
        felt.append(felt_at_the_tip(z))
    assert min(felt) > 0
    assert np.ptp(felt) < 1e-9 * max(felt)


def test_the_closer_a_point_is_to_a_wall_the_more_it_feels():
    felt = []
    for height in (1.01, 0.8, 0.6, 0.4, 0.2, 0.1):
        z = CLAMP.copy()
        z[TIP] = 0.47 + 1j * height * REACH
        felt.append(felt_at_the_tip(z))
    assert felt[0] == 0
    assert (np.diff(felt) > 0).all()


def test_contact_that_leaves_a_frame_as_it_is_is_not_felt_there():
    z = CLAMP.copy()
    z[TIP] = 0.47 + 0.5j * REACH
    contact = contact_of(CLAMP)
    assert len(contact.near(z, 1.0))
    assert not len(contact.leaving(z).near(z, 1.0))
