import itertools

import numpy as np
import pytest

from core.errors import Cancelled
from core.fem.elements import Elements
from core.fem.newton import FreeVertices
from core.geometry.triangulation import Mesh, split_chords, triangulate
from core.model import Recipe
from core.morph.placement import harmonic, place
from tests.core.morph.polygons import at_unit_area
from tests.core.shapes import ellipse, limb, rotation


def limb_mesh(bend: float) -> Mesh:
    return split_chords(triangulate([at_unit_area(limb(bend))], 0.004))


def test_a_harmonic_map_of_an_affine_boundary_is_that_affine_map():
    mesh = triangulate([at_unit_area(ellipse(60))], 0.01)
    A = np.array([[1.3, 0.4], [-0.2, 0.8]])
    b = mesh.boundary_size
    elements = Elements.of(mesh.points, mesh.triangles)
    vertices = FreeVertices(elements, np.arange(b, elements.vertices))
    x = harmonic(vertices, mesh.points[:b] @ A.T)
    assert np.allclose(x, mesh.points @ A.T)


@pytest.mark.parametrize("material", ["symmetric-dirichlet", "st-venant-kirchhoff"])
def test_a_turned_boundary_turns_the_inside(material):
    mesh = limb_mesh(0.8)
    turned = mesh.points @ rotation(2.5).T
    placed = place(mesh, turned[: mesh.boundary_size], Recipe(material=material))
    assert np.allclose(placed.target, turned, atol=1e-6)


def test_the_energy_of_the_material_never_rises():
    placed = place(limb_mesh(0.0), at_unit_area(limb(3.0)), Recipe())
    energies = [i.energy for i in placed.iterations if i.stage == "symmetric-dirichlet"]
    assert len(energies) > 1
    assert all(b <= a for a, b in itertools.pairwise(energies))
    assert placed.iterations[-1].folds == 0


def test_mu_and_lambda_change_where_the_inside_goes():
    ends = [
        place(
            limb_mesh(0.0),
            at_unit_area(limb(2.0)),
            Recipe(material="st-venant-kirchhoff", mu=1.0, lam=lam),
        ).target
        for lam in (0.0, 50.0)
    ]
    assert np.abs(ends[0] - ends[1]).max() > 1e-3


def test_it_can_be_stopped_between_steps():
    seen = []

    def watch(stage):
        seen.append(stage)
        if len(seen) == 3:
            raise Cancelled

    with pytest.raises(Cancelled):
        place(limb_mesh(0.0), at_unit_area(limb(5.5)), Recipe(), watch)
    assert len(seen) == 3
