"""The direct map, and what mends it."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from core.errors import Cancelled
from core.model import Recipe
from core.model.outline import Array
from core.morph.compatible.joint import JointMesh
from core.morph.compatible.overlay import compatible_mesh
from core.morph.compatible.widening import FAIR
from core.morph.mapping import COSTLY, Map, direct_map, polished_map, refitted_map
from core.morph.quality import folds
from core.progress import unwatched
from tests.core.morph.polygons import comb, disc, spiral, square

COUNT = 72
RECIPE = Recipe(density=64)
HARD = {
    "two combs out of step": (comb(4, COUNT), np.roll(comb(5, COUNT), 20, axis=0)),
    "a comb and a spiral": (comb(4, COUNT), spiral(1.0, COUNT)),
    "two spirals out of step": (spiral(1.0, COUNT), np.roll(spiral(2.0, COUNT), 20, axis=0)),
}


@cache
def direct(name: str) -> Map:
    source, target = HARD[name]
    return direct_map([source], [target], RECIPE, unwatched)


@cache
def mended(name: str) -> Map:
    source, target = HARD[name]
    return polished_map(refitted_map([source], [target], RECIPE, unwatched), RECIPE, unwatched)


@pytest.mark.parametrize("name", HARD)
def test_a_refitted_map_has_no_fold_where_the_direct_one_has(name: str) -> None:
    assert not direct(name).sound
    found = mended(name)
    assert found.sound
    assert not len(folds(found.mesh.points, found.mesh.triangles))
    assert not len(folds(found.target, found.mesh.triangles))


@pytest.mark.parametrize("name", HARD)
def test_the_boundary_goes_exactly_where_it_is_told(name: str) -> None:
    source, target = HARD[name]
    for mapped in (direct(name), mended(name)):
        b = len(source)
        assert np.allclose(mapped.mesh.points[:b], source, atol=1e-9)
        assert np.allclose(mapped.target[:b], target, atol=1e-9)


def test_a_map_without_faults_is_left_as_it_is() -> None:
    ends: tuple[list[Array], list[Array]] = [disc(COUNT)], [square(COUNT)]
    found = direct_map(*ends, RECIPE, unwatched)
    assert JointMesh.of(found.mesh, found.target).worse.min() >= FAIR
    assert polished_map(found, RECIPE, unwatched) is found


def test_poor_triangles_are_made_fair_for_hardly_more_distortion() -> None:
    ends = [disc(COUNT)], [disc(COUNT) * [2.2, 1 / 2.2]]
    found = direct_map(*ends, RECIPE, unwatched)
    wide = polished_map(found, RECIPE, unwatched)
    assert JointMesh.of(found.mesh, found.target).worse.min() < FAIR
    assert JointMesh.of(wide.mesh, wide.target).worse.min() >= FAIR
    assert wide.mean < COSTLY * found.mean


def test_an_isometry_has_a_mean_distortion_of_one() -> None:
    found = direct_map([disc(COUNT)], [disc(COUNT) + np.array([3, 1])], RECIPE, unwatched)
    assert found.mean == pytest.approx(1)


@pytest.mark.parametrize("step", [0, 1])
def test_making_a_joint_mesh_can_be_stopped_between_its_steps(step: int) -> None:
    source, target = HARD["two combs out of step"]
    seen: list[str] = []

    def watch(stage: str) -> None:
        seen.append(stage)
        if len(seen) > step:
            raise Cancelled

    with pytest.raises(Cancelled):
        compatible_mesh([source], [target], watch)
    assert len(seen) == step + 1
