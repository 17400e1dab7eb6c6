from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Polygon

from core.fem.elements import Elements
from core.geometry.polyline import signed_area
from core.geometry.triangulation import Mesh, unique_edges
from core.model.outline import Array
from core.morph.compatible.chords import chord_sets, crossing
from core.morph.compatible.overlay import compatible_mesh
from tests.core.morph.polygons import (
    comb,
    disc,
    hole,
    hole_within,
    needle,
    spiral,
    square,
    star_shaped,
    untangled,
)

B = 30
PAIRS = {
    "spiral and disc": (spiral(2.5, 120), disc(120)),
    "comb and square": (comb(5, 90), square(90)),
    "spiral and comb": (spiral(1.5, 100), comb(4, 100)),
    "two combs, shifted": (comb(4, 80), np.roll(comb(4, 80), 13, axis=0)),
    "needle and disc": (needle(40, 1e-4), disc(40)),
    "two needles, shifted": (needle(40, 1e-4), np.roll(needle(40, 1e-4), 5, axis=0)),
    "two triangles": (disc(3), np.roll(disc(3), 1, axis=0)),
    "two squares of 4, shifted": (square(4), np.roll(square(4), 1, axis=0)),
    "a square's edges shifted by half": (square(32), np.roll(square(32), 4, axis=0)),
}


HOLES = {
    "hole on the other side": ([disc(50), hole(0.3, 0)], [square(50), hole(-0.3, 2)]),
    "hole turned half round": ([disc(50), hole(0, 0)], [disc(50), hole(0, np.pi)]),
    "two holes that change places": (
        [disc(50), hole(0.3, 0), hole(-0.3, 0)],
        [disc(50), hole(-0.3, 0), hole(0.3, 0)],
    ),
    "hole at the end of a spiral": (
        [spiral(1.5, 100), hole(0, 0, spiral(1.5, 100)[[3, 96]].mean(axis=0), 0.01)],
        [disc(100), hole(-0.2, 1)],
    ),
    "three holes in a row and in a triangle": (
        [square(60), hole(-0.3, 0), hole(0, 0), hole(0.3, 0)],
        [square(60), hole(-0.3, 1), hole(0, 2, (0, 0.25)), hole(0.3, 3)],
    ),
}


def check_fits(mesh: Mesh, image: Array, source: Sequence[Array], target: Sequence[Array]) -> None:
    """What every mesh that fits two outlines must be."""
    b = sum(map(len, source))
    for points, rings in ((mesh.points, source), (image, target)):
        assert np.array_equal(points[:b], np.concatenate(rings))
        areas = Elements.of(points, mesh.triangles).areas
        assert areas.min() > 0
        assert areas.sum() == pytest.approx(sum(map(signed_area, rings)), rel=1e-9)
    edges, _, count = unique_edges(mesh.triangles)
    border = [np.column_stack([ring, np.roll(ring, -1)]) for ring in mesh.rings]
    assert np.array_equal(np.concatenate(mesh.rings), np.arange(b))
    assert [len(ring) for ring in mesh.rings] == [len(ring) for ring in source]
    assert set(count.tolist()) <= {1, 2}
    assert sorted(edges[count == 1].tolist()) == sorted(np.sort(np.concatenate(border)).tolist())
    assert len(np.unique(mesh.triangles)) == len(mesh.points) == len(image)
    assert len(mesh.points) - len(edges) + len(mesh.triangles) == 2 - len(source)


@pytest.mark.parametrize("name", PAIRS)
def test_the_overlay_fits_both_polygons(name: str) -> None:
    source, target = PAIRS[name]
    check_fits(*compatible_mesh([source], [target]), [source], [target])


@pytest.mark.parametrize("name", HOLES)
def test_the_overlay_fits_outlines_with_holes(name: str) -> None:
    source, target = HOLES[name]
    check_fits(*compatible_mesh(source, target), source, target)


@settings(max_examples=20, deadline=None)
@given(untangled(B), star_shaped(B), st.integers(0, B - 1), st.integers(0, 6))
def test_the_overlay_fits_wild_outlines_with_a_hole(
    source: Array, target: Array, shift: int, turn: int
) -> None:
    rings = [[polygon, hole_within(polygon)] for polygon in (source, target)]
    rings[1] = [np.roll(rings[1][0], shift, axis=0), np.roll(rings[1][1], turn, axis=0)]
    check_fits(*compatible_mesh(*rings), *rings)


@settings(max_examples=40, deadline=None)
@given(star_shaped(B), star_shaped(B), st.integers(0, B - 1))
def test_the_overlay_fits_star_shaped_polygons_at_any_shift(
    source: Array, target: Array, shift: int
) -> None:
    target = np.roll(target, shift, axis=0)
    check_fits(*compatible_mesh([source], [target]), [source], [target])


@settings(max_examples=60, deadline=None)
@given(untangled(B), untangled(B), st.integers(0, B - 1))
def test_the_overlay_fits_wild_polygons_with_straight_runs_at_any_shift(
    source: Array, target: Array, shift: int
) -> None:
    target = np.roll(target, shift, axis=0)
    check_fits(*compatible_mesh([source], [target]), [source], [target])


@settings(max_examples=20, deadline=None)
@given(untangled(B), st.floats(0, 6))
def test_a_turned_copy_needs_no_inner_vertex(source: Array, angle: float) -> None:
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    mesh, _ = compatible_mesh([source], [source @ turn])
    assert len(mesh.points) == len(source)


@settings(max_examples=30, deadline=None)
@given(untangled(B), untangled(B))
def test_shared_diagonals_lie_inside_both_polygons(source: Array, target: Array) -> None:
    chords = chord_sets(source, target)
    assert len(chords.source) == len(chords.target) == B - 3 - len(chords.shared)
    for polygon in (source, target):
        inside = Polygon(polygon).buffer(1e-9)
        assert all(inside.covers(LineString(polygon[pair])) for pair in chords.shared)


@settings(max_examples=30, deadline=None)
@given(untangled(B), untangled(B))
def test_diagonals_of_one_polygon_never_cross_and_unshared_ones_cross_the_others(
    source: Array, target: Array
) -> None:
    chords = chord_sets(source, target)
    for own, others in ((chords.source, chords.target), (chords.target, chords.source)):
        all_own = np.concatenate([chords.shared, own])
        assert not crossing(all_own, all_own).any()
        assert crossing(own, others).any(axis=1).all()


def test_the_same_polygons_give_the_same_mesh() -> None:
    source, target = PAIRS["spiral and comb"]
    (first, image), (second, again) = (compatible_mesh([source], [target]) for _ in range(2))
    assert np.array_equal(first.triangles, second.triangles)
    assert np.array_equal(image, again)
