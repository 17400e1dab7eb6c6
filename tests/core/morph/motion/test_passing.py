"""Motions whose ends have velocities of their own."""

from __future__ import annotations

import numpy as np
import pytest

import core
from core.model import Turning
from core.morph.motion.motion import Motion
from core.morph.quality import folds
from tests.core.morph.motion.test_guard import poor_map
from tests.core.shapes import limb

STEP = 1e-6
TIMES = np.linspace(0, 1, 25)
Ends = tuple[np.ndarray, np.ndarray]


@pytest.fixture(scope="module")
def bent() -> tuple[Ends, np.ndarray]:
    """A limb that bends, stretches and turns: positions at both ends, and triangles."""
    morph = core.solve(limb(0.0), limb(2.6) * [1.0, 1.4], [(0, 0), (16, 16)])
    return (morph.inside(morph.rest), morph.inside(morph.target)), morph.triangles


def swirl(x: np.ndarray) -> np.ndarray:
    """Return velocities at positions x (n, 2): they turn, stretch and shear."""
    u, v = x.T
    return np.column_stack([0.5 * v + 0.3 * np.sin(2 * u), 0.2 * v * v - 0.4 * u])


def velocity(motion: Motion, end: int) -> np.ndarray:
    """Return the velocities of all vertices at an end, from inside."""
    inside = abs(end - STEP)
    return (motion(inside) - motion(end)) / (inside - end)


@pytest.mark.parametrize("turning", [Turning(), Turning("clockwise", 2), Turning(path="straight")])
@pytest.mark.parametrize("ends", [(0,), (1,), (0, 1)])
def test_the_ends_have_the_velocities_they_were_given(bent, turning, ends):
    (rest, target), triangles = bent
    motion = Motion.of("arap", (rest, target), triangles, turning)
    start = swirl(rest) if 0 in ends else None
    end = swirl(target) if 1 in ends else None
    passing = motion.passing((rest, target), triangles, (start, end))
    for at, given in ((0, start), (1, end)):
        expected = velocity(motion, at) if given is None else given
        assert velocity(passing, at) == pytest.approx(expected, abs=2e-3)


def test_both_ends_stay_exact(bent):
    (rest, target), triangles = bent
    motion = Motion.of("arap", (rest, target), triangles)
    passing = motion.passing((rest, target), triangles, (swirl(rest), swirl(target)))
    assert passing(0) == pytest.approx(rest, abs=1e-10)
    assert passing(1) == pytest.approx(target, abs=1e-10)


def test_a_motion_given_its_own_velocities_stays_as_it_is(bent):
    ends, triangles = bent
    motion = Motion.of("arap", ends, triangles)
    own = velocity(motion, 0), velocity(motion, 1)
    passing = motion.passing(ends, triangles, own)
    for t in TIMES:
        assert passing(t) == pytest.approx(motion(t), abs=1e-3)


@pytest.mark.parametrize("speed", [1.0, 4.0])
def test_no_frame_folds_however_the_ends_are_passed(speed):
    rest, target, triangles = poor_map()
    motion = Motion.of("arap", (rest, target), triangles)
    velocities = speed * swirl(rest), speed * swirl(target)
    passing = motion.passing((rest, target), triangles, velocities)
    assert not any(len(folds(passing(t), triangles)) for t in TIMES)
