"""Inner vertices come to rest at both ends."""

from __future__ import annotations

import numpy as np
import pytest

from core.errors import Cancelled
from core.fem.elements import Elements
from core.fem.energies import SymmetricDirichlet
from core.fem.newton import energy
from core.geometry.triangulation import triangulate
from core.morph.compatible.cleanup import coarsen, improve
from core.morph.compatible.joint import JointMesh
from core.morph.compatible.overlay import compatible_mesh
from core.morph.compatible.settling import settle_both
from tests.core.morph.compatible.test_overlay import PAIRS
from tests.core.morph.compatible.test_widening import check_joint
from tests.core.morph.polygons import disc

FITTING = ["comb and square", "two combs, shifted", "spiral and disc"]


def cleaned(name: str) -> JointMesh:
    source, target = PAIRS[name]
    return improve(coarsen(JointMesh.of(*compatible_mesh([source], [target]))), 1 / 200)


def distortion(mesh: JointMesh) -> float:
    return energy(Elements.of(mesh.end(0), mesh.triangles), SymmetricDirichlet(), mesh.end(1))


@pytest.mark.parametrize("name", FITTING)
def test_a_mesh_at_rest_still_fits_and_is_less_distorted(name: str) -> None:
    before = cleaned(name)
    after = settle_both(before)
    check_joint(after, name)
    assert distortion(after) < distortion(before)


def test_a_copy_of_a_fair_mesh_stays_a_copy() -> None:
    mesh = triangulate([disc(60)], 1 / 200)
    after = settle_both(JointMesh.of(mesh, mesh.points))
    assert np.abs(after.end(0) - mesh.points).max() < 1e-9
    assert np.abs(after.end(1) - mesh.points).max() < 1e-9


def test_a_mesh_without_inner_vertices_is_left_as_it_is() -> None:
    mesh = JointMesh.of(*compatible_mesh([disc(3)], [disc(3)]))
    assert settle_both(mesh) is mesh


def test_settling_can_be_cancelled() -> None:
    def cancel(stage: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        settle_both(cleaned("comb and square"), watch=cancel)


def test_only_vertices_near_the_triangles_that_are_told_move() -> None:
    before = cleaned("comb and square")
    around = np.zeros(len(before.triangles), bool)
    around[before.worse.argmin()] = True
    after = settle_both(before, around)
    moved = (after.points != before.points).any(axis=1)
    assert 0 < np.count_nonzero(moved) < 60
    assert moved[before.triangles[around]][before.triangles[around] >= before.boundary_size].all()
    check_joint(after, "comb and square")
