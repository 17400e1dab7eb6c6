"""Unfolding a map whose boundary is fixed."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from core.fem.elements import Elements
from core.fem.newton import FreeVertices
from core.geometry.triangulation import split_chords, triangulate
from core.model.outline import Array
from core.morph.placement import folded, harmonic
from core.morph.untangle import MAX_STEPS, VALID, untangle
from tests.core.morph.polygons import at_unit_area
from tests.core.shapes import limb


@pytest.fixture(scope="module")
def bent() -> tuple[FreeVertices, Array]:
    """A straight limb's mesh with the boundary of a bent one, and folds inside."""
    mesh = split_chords(triangulate([at_unit_area(limb(0.0))], 0.004))
    elements = Elements.of(mesh.points, mesh.triangles)
    boundary = at_unit_area(np.roll(limb(3.0), 8, axis=0))
    free = FreeVertices(elements, np.arange(mesh.boundary_size, len(mesh.points)))
    start = harmonic(free, boundary)
    assert folded(elements, start) > 0
    return free, start


def test_what_a_harmonic_map_folds_is_unfolded(bent: tuple[FreeVertices, Array]) -> None:
    free, start = bent
    x = untangle(free, start, lambda energy, x: None)
    assert folded(free.elements, x) == 0
    assert free.elements.determinants(x).min() > VALID


def test_the_boundary_stays_where_it_is(bent: tuple[FreeVertices, Array]) -> None:
    free, start = bent
    x = untangle(free, start, lambda energy, x: None)
    moved = np.flatnonzero((x != start).any(axis=1))
    assert len(moved)
    assert moved.min() >= len(limb(0.0))


def test_every_step_is_seen_and_the_last_one_returned(bent: tuple[FreeVertices, Array]) -> None:
    seen: list[Array] = []
    x = untangle(*bent, lambda energy, x: seen.append(x))
    assert 0 < len(seen) <= MAX_STEPS
    assert seen[-1] is x
    assert not any(np.array_equal(a, b) for a, b in itertools.pairwise(seen))


def test_a_map_without_folds_is_left_as_it_is(bent: tuple[FreeVertices, Array]) -> None:
    free, start = bent
    x = untangle(free, start, lambda energy, x: None)
    assert untangle(free, x, lambda energy, x: pytest.fail("a step was made")) is x
