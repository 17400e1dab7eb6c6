"""A hole belongs to the one that lies where the exterior carries it."""

from __future__ import annotations

import numpy as np
import pytest

from core.morph.marks.holes import paired_holes
from core.morph.marks.rings import match_rings
from tests.core.shapes import ellipse, letter_l, rotation

HOLES = [0.2 * ellipse(12, 1, 1) + centre for centre in ([0.5, 0.5], [2.4, 0.5], [0.5, 4.2])]


def partners(source, target, known=None):
    exterior = next(m for m in match_rings(source[0], target[0]) if not m.mirrored)
    return paired_holes(source, target, exterior, known or {})


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1), (1, 0, 2)])
def test_the_order_in_which_holes_are_drawn_does_not_matter(order):
    turn = 3 * rotation(2.2).T
    target = [letter_l() @ turn + 7, *(HOLES[k] @ turn + 7 for k in order)]
    pairs = partners([letter_l(), *HOLES], target)
    assert {pair.source: order[pair.target - 1] + 1 for pair in pairs} == {1: 1, 2: 2, 3: 3}


def test_a_hole_is_turned_like_the_exterior_around_it():
    target = [ring @ rotation(0.7).T for ring in (letter_l(), *HOLES)]
    for pair in partners([letter_l(), *HOLES], target):
        assert np.angle(pair.rotation) == pytest.approx(0.7)


def test_what_the_artist_paired_stays_paired():
    source = [letter_l(), *HOLES]
    assert {(p.source, p.target) for p in partners(source, source, {1: 3, 3: 2})} == {
        (1, 3),
        (2, 1),
        (3, 2),
    }


def test_a_hole_too_many_has_no_partner():
    source, target = [letter_l(), *HOLES], [letter_l(), *HOLES[1:]]
    assert {(p.source, p.target) for p in partners(source, target)} == {(2, 1), (3, 2)}
    assert partners(source, target[:1]) == []
