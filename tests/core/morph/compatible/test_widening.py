"""Poor triangles at either end are made fair by changing the mesh around them."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LinearRing

from core.errors import Cancelled
from core.geometry.triangulation import triangulate
from core.morph.compatible.joint import JointMesh
from core.morph.compatible.nudging import nudge
from core.morph.compatible.overlay import compatible_mesh
from core.morph.compatible.widening import FAIR, widen
from core.morph.quality import smallest_angle
from tests.core.morph.compatible.test_overlay import PAIRS, check_fits
from tests.core.morph.polygons import at_unit_area, disc

SQUEEZE = np.diag([2.5, 0.4])


def squeezed() -> JointMesh:
    mesh = triangulate([disc(60)], 1 / 200)
    return JointMesh.of(mesh, mesh.points @ SQUEEZE)


def overlaid(name: str) -> JointMesh:
    source, target = PAIRS[name]
    return JointMesh.of(*compatible_mesh([source], [target]))


def check_joint(mesh: JointMesh, name: str) -> None:
    """Check the fit. On the border, vertices may have been added: they must lie on it."""
    drawn = PAIRS[name]
    b = len(drawn[0])
    cut, _ = mesh.apart((np.arange(b),))
    [ring] = cut.rings
    assert ring[ring < b].tolist() == list(range(b))
    inner = np.arange(len(ring), len(mesh.points))
    order = np.concatenate([ring, inner])
    points, triangles = mesh.points[order], np.argsort(order)[mesh.triangles]
    around = JointMesh(points, triangles, len(ring))
    ends = [around.end(end)[: len(ring)] for end in (0, 1)]
    for end, polygon in zip(ends, drawn, strict=True):
        assert np.array_equal(end[ring < b], polygon)
        assert shapely.distance(LinearRing(polygon), shapely.points(end)).max() < 1e-14
    check_fits(*around.apart((np.arange(len(ring)),)), [ends[0]], [ends[1]])


def test_a_squeezed_mesh_gets_fair_triangles_at_both_ends() -> None:
    before = squeezed()
    after = widen(before)
    assert before.worse.min() < 0.8 * FAIR
    assert after.worse.min() >= FAIR
    for end in (0, 1):
        assert np.degrees(smallest_angle(after.end(end), after.triangles)) > 10
        assert np.array_equal(after.end(end)[:60], before.end(end)[:60])


def test_a_fair_mesh_is_left_as_it_is() -> None:
    mesh = widen(squeezed())
    assert widen(mesh) is mesh


@pytest.mark.parametrize("name", PAIRS)
def test_widening_keeps_the_fit_and_never_lowers_the_worst_triangle(name: str) -> None:
    before = overlaid(name)
    after = widen(before)
    check_joint(after, name)
    assert after.worse.min() >= before.worse.min()


def test_the_long_side_of_a_lopsided_corner_is_split_on_the_border() -> None:
    """No inner vertex helps there: the corner's only triangle has two sides on the border."""
    lopsided = np.array([[0, 0], [4, -0.2], [4, 3], [1, 3], [1, 0.3]])
    mesh = triangulate([at_unit_area(lopsided)], 1 / 50)
    before = JointMesh.of(mesh, mesh.points)
    after = widen(before)
    assert before.worse.min() < FAIR <= after.worse.min()
    assert after.boundary_size > before.boundary_size


def test_widening_can_be_cancelled() -> None:
    def cancel(stage: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        widen(squeezed(), watch=cancel)


@pytest.mark.parametrize("name", PAIRS)
def test_nudging_keeps_the_fit_and_never_lowers_the_worst_triangle(name: str) -> None:
    before = overlaid(name)
    after = nudge(before, FAIR, passes=6)
    check_joint(after, name)
    assert after.worse.min() >= before.worse.min()


def test_a_nudge_lowers_the_worst_triangle_around_no_vertex_that_it_moves() -> None:
    before = squeezed()
    after = nudge(before, FAIR, passes=1)
    moved = np.flatnonzero((after.points != before.points).any(axis=1))
    assert len(moved)
    around = [mesh.worst_around(mesh.quality)[moved] for mesh in (before, after)]
    assert (around[1] >= around[0]).all()


@settings(max_examples=30, deadline=None)
@given(st.floats(0, 2 * np.pi), st.floats(0.5, 0.97))
def test_one_vertex_alone_finds_a_place_that_is_fair(angle: float, out: float) -> None:
    ring = np.exp(2j * np.pi * np.arange(6) / 6)
    apothem = np.cos(np.pi / 6)
    points = np.append(ring, out * apothem * np.exp(1j * angle))[:, None] * [1, 1]
    fan = np.array([[k, (k + 1) % 6, 6] for k in range(6)])
    mesh = nudge(JointMesh(points, fan, 6), 0.7, passes=20)
    assert mesh.worse.min() >= 0.7


def test_where_all_is_fair_nothing_is_nudged() -> None:
    mesh = squeezed()
    assert nudge(mesh, mesh.worse.min(), passes=3) is mesh
