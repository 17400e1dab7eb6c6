"""What is compared: the same for every way of drawing the same ring."""

from __future__ import annotations

import numpy as np
import pytest

from core.geometry.polyline import arc_lengths
from core.morph.marks.contour import HAIR, Contour, Samples, gap
from tests.core.shapes import ellipse, letter_l, rotation


def corner_points(ring):
    contour = Contour.of(ring)
    lengths = contour.translated(contour.corners[0]) * arc_lengths(ring)[-1]
    return {int(np.argmin(np.abs(arc_lengths(ring)[:-1] - length))) for length in lengths}


def test_the_corners_of_a_polygon_are_its_vertices():
    assert corner_points(letter_l()) == set(range(6))


def test_vertices_along_an_edge_are_no_corners():
    lengths = arc_lengths(letter_l())
    at = np.sort(np.concatenate([lengths[:-1], np.linspace(0.01, 15.9, 57)]))
    dense = np.column_stack([np.interp(at, lengths, np.append(c, c[0])) for c in letter_l().T])
    found = dense[sorted(corner_points(dense))]
    assert {tuple(p) for p in found} == {tuple(p) for p in letter_l()}


def test_a_smooth_ring_has_no_corners():
    assert not len(Contour.of(ellipse(400)).corners[0])


def test_a_rounded_corner_is_one_corner():
    angle = np.linspace(0, np.pi / 2, 9)
    arc = 0.02 * np.column_stack([np.cos(angle), np.sin(angle)])
    square = np.array([[1.0, 1], [-1, 1], [-1, -1], [1, -1]])
    rounded = np.concatenate([c + arc @ rotation(k * np.pi / 2).T for k, c in enumerate(square)])
    assert len(Contour.of(rounded).corners[0]) == 4


def test_a_limb_is_as_wide_as_it_was_drawn():
    contour = Contour.of(np.array([[0.0, 0], [10, 0], [10, 1], [0, 1]]))
    middle_of_a_side = np.array([5 / 22, 16 / 22])
    assert contour.widths_at(middle_of_a_side) == pytest.approx(1 / 22, rel=0.05)


@pytest.mark.parametrize("backwards", [False, True])
def test_a_place_translates_there_and_back(backwards):
    ring = letter_l()[::-1] if backwards else letter_l()
    contour = Contour.of(ring)
    at = np.linspace(0, 0.99, 23)
    assert contour.translated(contour.translated(at)) == pytest.approx(at)
    corners = contour.translated(arc_lengths(ring)[:-1] / arc_lengths(ring)[-1])
    turned = contour.points_at(corners) - contour.points_at(np.zeros(1))
    drawn = ring - ring[0]
    assert np.abs(turned) / np.abs(turned).max() == pytest.approx(
        np.hypot(*drawn.T) / np.hypot(*drawn.T).max()
    )


def test_samples_of_a_mirror_image_turn_the_same_way_at_mirrored_places():
    contour = Contour.of(letter_l())
    at = np.linspace(0.003, 0.97, 31)
    plain, mirror = Samples.of(contour, at), Samples.of(contour.mirrored(), -at)
    assert mirror.points == pytest.approx(np.conj(plain.points))
    assert mirror.turns == pytest.approx(plain.turns)


def test_gaps_go_the_short_way_round():
    assert gap(np.array([0.95, 0.05]), np.array([0.05, 0.95])) == pytest.approx([-0.1, 0.1])


@pytest.mark.parametrize("ring", [ellipse(40), letter_l()])
def test_a_place_a_hair_from_a_vertex_is_drawn_onto_it_and_others_stay(ring):
    contour = Contour.of(ring)
    vertices = contour.lengths / contour.lengths[-1]
    for hair in (-0.9 * HAIR, 0.9 * HAIR, 0.0):
        drawn = contour.drawn(np.mod(vertices[:-1] + hair, 1.0))
        assert np.array_equal(np.sort(drawn), vertices[:-1])
    between = (vertices[1:] + vertices[:-1]) / 2
    assert np.array_equal(contour.drawn(between), between)
