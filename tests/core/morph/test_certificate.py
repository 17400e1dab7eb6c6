"""A map is proved to be one to one, or what is wrong with it is named."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import core
from core.geometry.triangulation import Mesh, triangulate
from core.morph.certificate import Certificate
from tests.core.morph.polygons import comb, disc, hole, spiral


def certificate(mesh: Mesh, target: np.ndarray) -> Certificate:
    return Certificate.of(mesh.triangles, mesh.rings, mesh.points, target)


@pytest.fixture
def mesh() -> Mesh:
    return triangulate([disc(40), hole(0.2, 0)], 1 / 100)


def test_what_the_solver_finds_is_certified() -> None:
    for source, target in ((comb(4, 60), spiral(1.0, 60)), (disc(30), np.roll(comb(3, 50), 9, 0))):
        assert core.solve(source, target).report.certificate.holds


def test_an_affine_map_is_certified(mesh: Mesh) -> None:
    assert certificate(mesh, mesh.points @ [[2, 0.3], [0.1, 1]]).holds


def test_folds_are_named(mesh: Mesh) -> None:
    inner = mesh.boundary_size
    target = mesh.points.copy()
    target[inner] = [3, 3]
    found = certificate(mesh, target)
    assert found.folds[0] == ()
    assert set(found.folds[1]) <= set(np.flatnonzero((mesh.triangles == inner).any(axis=1)))
    assert found.folds[1]
    assert found.simple == (True, True)
    assert not found.holds


def test_an_outline_that_covers_itself_is_no_one_to_one_image_though_nothing_folds() -> None:
    """A ring of triangles that goes round twice: each is sound, but they overlap."""
    count = 12
    k, along = np.arange(count - 1), np.arange(count)
    turn = np.exp(4j * np.pi * along / (count - 1))
    source = np.concatenate([along, along + 1j])
    target = np.concatenate([2 * turn, turn])
    halves = [[k, k + 1, k + count], [k + 1, k + 1 + count, k + count]]
    triangles = np.concatenate([np.stack(half, axis=1) for half in halves])
    rings = (np.concatenate([along, along[::-1] + count]),)
    source, target = (np.column_stack([end.real, end.imag]) for end in (source, target))
    assert Certificate.of(triangles, rings, source, source).holds
    found = Certificate.of(triangles, rings, source, target)
    assert found.folds == ((), ())
    assert found.simple == (True, False)
    assert not found.holds


def test_a_missing_or_repeated_triangle_is_noticed(mesh: Mesh) -> None:
    for triangles in (mesh.triangles[1:], np.concatenate([mesh.triangles, mesh.triangles[:1]])):
        found = certificate(replace(mesh, triangles=triangles), mesh.points)
        assert found.folds == ((), ())
        assert not found.bordered
        assert not found.holds
