"""An in-between becomes a key that can be edited: few nodes, and the same shape."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from core.geometry.flatten import flatten
from core.geometry.polyline import cross
from core.model import Keyframe, Layer, Outline, Ring
from core.morph.morph import Morph
from core.morph.redrawn import TOLERANCE, redrawn
from core.morph.scene import solve_span, span_of
from tests.core.shapes import letter_l, rotation


def solved(source: Outline, target: Outline) -> Morph:
    return solve_span(span_of(Layer(1, "x", (Keyframe(1, source), Keyframe(9, target))), 0))


def bean(bend: float) -> Outline:
    """A round shape with four nodes that bends."""
    points = np.array([[100, 0], [0, 60], [-100, 0], [0, -60 + bend]], dtype=float)
    along = 0.55 * np.roll(points, -1, axis=0)
    return Outline((Ring(points, -along, along),))


def edges(outline: Outline) -> shapely.MultiLineString:
    return shapely.MultiLineString([shapely.LinearRing(line.points) for line in flatten(outline)])


def halfway(source: Outline, target: Outline) -> tuple[Outline, Outline]:
    """The in-between with all its vertices, and drawn anew."""
    morph = solved(source, target)
    positions = morph.at(0.5)
    plain = Outline.polygon(*(positions[ring] for ring in morph.rings))
    return plain, redrawn(morph, positions, source, target)


HOLE = np.array(letter_l()) / 6 + 0.3
CASES = {
    "a bean": (bean(0), bean(50)),
    "a letter": (
        Outline.polygon(letter_l()),
        Outline.polygon(letter_l()).transformed([[1, 1], [0, 1]]),
    ),
    "a hole": (
        Outline.polygon(letter_l(), HOLE),
        Outline.polygon(letter_l(), HOLE).transformed(rotation(1.0), [4, 2]),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_an_in_between_drawn_anew_looks_the_same_with_far_fewer_nodes(name: str):
    source, target = CASES[name]
    plain, few = halfway(source, target)
    assert len(few.rings) == len(plain.rings)
    size = np.hypot(*np.ptp(plain.rings[0].points, axis=0))
    assert edges(few).hausdorff_distance(edges(plain)) < 2 * TOLERANCE * size
    for ring, whole in zip(few.rings, plain.rings, strict=True):
        assert 3 <= len(ring) < len(whole) / 3


def test_the_nodes_of_the_source_travel_along():
    source, target = CASES["a letter"]
    morph = solved(source, target)
    few = redrawn(morph, morph.at(0.5), source, target)
    nodes = source.rings[0].points
    at_rest = [int(np.argmin(np.hypot(*(morph.rest - node).T))) for node in nodes]
    for place in morph.at(0.5)[at_rest]:
        assert np.hypot(*(few.rings[0].points - place).T).min() < 1e-9


def test_what_moves_rigidly_keeps_its_very_nodes():
    source = Outline.polygon(letter_l())
    _, few = halfway(source, source.transformed(rotation(1.0), [4, 2]))
    assert len(few.rings[0]) == len(source.rings[0])
    assert not few.rings[0].handles_in.any()


def test_a_corner_that_only_the_target_has_becomes_a_node():
    square = Outline.polygon([(0, 0), (8, 0), (8, 8), (0, 8)])
    house = Outline.polygon([(0, 0), (4, -5), (8, 0), (8, 8), (0, 8)])
    morph = solved(square, house)
    roof = morph.at(0.5)[int(np.argmin(morph.target[:, 1]))]
    few = redrawn(morph, morph.at(0.5), square, house)
    assert np.hypot(*(few.rings[0].points - roof).T).min() < 1e-9


def test_a_smooth_node_stays_smooth():
    _, few = halfway(bean(0), bean(50))
    ring = few.rings[0]
    turn = cross(ring.handles_out, -ring.handles_in)
    lengths = np.hypot(*ring.handles_in.T) * np.hypot(*ring.handles_out.T)
    assert np.all(np.abs(turn) < 1e-6 * lengths)
