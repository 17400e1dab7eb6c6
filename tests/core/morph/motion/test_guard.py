"""Frames that would fold, and the guard that keeps them from it."""

from dataclasses import dataclass

import numpy as np
import pytest

import core
from core.errors import Cancelled
from core.fem.elements import Elements
from core.geometry.rotation import phasor
from core.geometry.triangulation import split_chords, triangulate
from core.morph.motion import hold
from core.morph.motion.contact import Contact
from core.morph.motion.fit import GradientFit
from core.morph.motion.gradients import determinant
from core.morph.motion.guard import REACH, FoldGuard
from core.morph.motion.hold import Hold, Wanted, to_complex
from core.morph.motion.motion import Motion
from core.morph.placement import place
from core.morph.quality import folds
from tests.core.morph.polygons import comb, square
from tests.core.shapes import limb

TIMES = np.linspace(0, 1, 49)


def ragged(seed: int) -> np.ndarray:
    """Return a ragged star: random radii at random angles."""
    rng = np.random.default_rng(seed)
    angle = 2 * np.pi * np.cumsum(gap := rng.uniform(0.5, 1.5, 14)) / gap.sum()
    return rng.uniform(0.35, 2, 14)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


def solve(seed: int, method: str) -> core.Morph:
    marks = [(i, (i + seed) % 14) for i in range(14)]
    recipe = core.Recipe(method=method)
    return core.solve(ragged(seed), ragged(seed + 1000), marks, recipe=recipe)


def poor_map() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a map without folds, but with triangles so ill shaped that frames come close."""
    mesh = split_chords(triangulate([comb(5, 72)], 1 / 400))
    target = place(mesh, np.roll(square(72), 5, axis=0), core.Recipe()).target
    assert not len(folds(target, mesh.triangles))
    return mesh.points, target, mesh.triangles


def folded_frames(morph: core.Morph) -> int:
    return sum(len(folds(morph.at(t), morph.triangles)) > 0 for t in TIMES)


def test_ragged_shapes_fold_in_the_plain_form_and_never_by_default():
    plain = [solve(seed, "plain arap") for seed in range(8)]
    sound = [seed for seed, morph in enumerate(plain) if not morph.report.folds_target]
    assert sum(folded_frames(plain[seed]) for seed in sound) > 20
    assert sum(folded_frames(solve(seed, "arap")) for seed in sound) == 0


@pytest.mark.parametrize("s", [-0.4, -0.2, 1.2, 1.4])
def test_a_motion_carried_on_past_its_ends_does_not_fold(s):
    angle = 2 * np.pi * np.arange(60) / 60
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    flower = (1 + 0.7 * np.cos(5 * angle))[:, None] * circle
    for ends in ((circle, flower), (flower, circle)):
        morph = core.solve(*ends)
        assert not len(folds(morph.at(s), morph.triangles))


def turned_by(angle: np.ndarray) -> np.ndarray:
    """Return rotations as turns and mirrors."""
    return np.stack([phasor(angle), np.zeros(len(angle))])


@dataclass(frozen=True, eq=False)
class Bar:
    """A bar as a mesh, and what is needed to hold it."""

    elements: Elements
    rest: np.ndarray
    fit: GradientFit
    hold: Hold

    def held(self, angle: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Return the frame for triangles turned by angles."""
        return self.hold(self.wanted(angle), start)

    def wanted(self, angle: np.ndarray) -> Wanted:
        """Return the plain fit for triangles turned by angles."""
        ideal = turned_by(angle)
        return Wanted(to_complex(self.fit(ideal)), determinant(ideal))

    def margin(self, z: np.ndarray) -> float:
        """Return the smallest area, relative to rest."""
        x = np.column_stack([z.real, z.imag])
        return self.elements.determinants(x).min()


@pytest.fixture
def bar() -> Bar:
    morph = core.solve(limb(0.0), limb(0.4), [(0, 0), (16, 16)])
    rest = (morph.rest - morph.origin) / morph.unit
    elements = Elements.of(rest, morph.triangles)
    fit = GradientFit(elements, elements.areas[:, None, None] * np.eye(2))
    z = rest[:, 0] + 1j * rest[:, 1]
    contact = Contact(morph.rings, z, z)
    return Bar(elements, z, fit, Hold(fit, FoldGuard(elements, elements), contact))


@pytest.fixture
def twist(bar: Bar) -> np.ndarray:
    """Angles that no fit follows without a fold."""
    centre = bar.rest[bar.elements.triangles].mean(axis=1)
    angle = 2.5 * np.sin(20 * centre.real) * (np.abs(centre.real) < 0.3)
    fitted = bar.fit(turned_by(angle))
    assert bar.elements.determinants(fitted).min() < 0
    return angle


def test_what_is_held_has_no_fold_even_where_the_ideal_twists(bar, twist):
    assert 0 < bar.margin(bar.held(twist, bar.rest)) < REACH


def test_a_sound_frame_is_never_exchanged_for_one_that_folds(bar, twist, monkeypatch):
    monkeypatch.setattr(hold, "ROUNDS", 1)  # too few to hold all that would fold
    start = bar.rest * np.exp(0.3j)
    assert bar.margin(bar.held(2 * twist, start)) > 0


def test_a_frame_can_be_cancelled_while_it_settles(bar, twist):
    def stop(stage: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        bar.hold(bar.wanted(twist), bar.rest, watch=stop)


def test_where_nothing_nears_a_fold_nothing_is_held(bar):
    wanted = bar.wanted(np.full(len(bar.elements.areas), 0.7))
    assert bar.hold.free(wanted)
    turned = bar.rest * np.exp(0.7j)
    assert np.allclose(wanted.fitted - wanted.fitted[0], turned - turned[0], atol=1e-9)


def test_a_held_frame_does_not_depend_on_where_it_settles_from(bar, twist):
    rng = np.random.default_rng(1)
    other = bar.rest + 0.002 * rng.standard_normal((len(bar.rest), 2)) @ [1, 1j]
    assert bar.margin(other) > 0
    one, two = (bar.held(twist, start) for start in (bar.rest, other))
    assert np.abs(one - two).max() < 1e-6


def test_a_hold_that_leaves_a_frame_as_it_is_does_not_touch_it(bar, twist):
    wanted, frame = bar.wanted(twist), bar.held(twist, bar.rest)
    assert not bar.hold.free(Wanted(frame, wanted.determinants))
    assert bar.hold.leaving([(frame, wanted)]).free(Wanted(frame, wanted.determinants))


def test_guarded_motion_is_smooth_and_exact_at_both_ends():
    rest, target, triangles = poor_map()
    motion = Motion.of("arap", (rest, target), triangles)
    shape, elements = motion.shape, Elements.of(rest, triangles)
    times = np.linspace(0, 1, 201)
    ideals = [shape.ideal(t) for t in times]
    margins = [elements.determinants(shape.fit(B)) / determinant(B) for B in ideals]
    assert np.min(margins) < REACH  # so the guard is at work here
    frames = np.array([motion(t) for t in times])
    assert not any(len(folds(frame, triangles)) for frame in frames)
    speed = np.abs(np.diff(frames, axis=0)).max(axis=(1, 2))
    jolt = np.abs(np.diff(frames, n=2, axis=0)).max(axis=(1, 2))
    assert jolt.max() < 0.25 * speed.max()
    assert np.allclose(frames[0], rest)
    assert np.allclose(frames[-1], target)


def test_guarded_frames_do_not_depend_on_the_order_they_are_asked_in():
    rest, target, triangles = poor_map()
    first, second = (Motion.of("arap", (rest, target), triangles) for _ in range(2))
    forward = [first(t) for t in TIMES]
    backward = [second(t) for t in TIMES[::-1]][::-1]
    assert all(np.array_equal(a, b) for a, b in zip(forward, backward, strict=True))
