"""Which boundaries belong together."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.errors import Cancelled, MarkError
from core.geometry.clean_outline import CleanOutline
from core.geometry.polyline import arc_lengths, points_at, signed_area
from core.geometry.validate import clean
from core.model import Outline, RingPoint
from core.model.outline import Array
from core.morph.boundary import BoundaryPair
from core.morph.correspondence import PlacedMark, place_marks, ways
from tests.core.morph.polygons import hole
from tests.core.shapes import ellipse, letter_l, rotation, square_ring, star_shaped

DENSITY = 64


def cleaned(*rings: Array) -> CleanOutline:
    return clean(list(rings), "source")


def proposals(
    source: CleanOutline, target: CleanOutline, marks: list[PlacedMark] | None = None
) -> list[list[BoundaryPair]]:
    found = (way.follow() for way in ways(source, target, marks or [], "abcd", DENSITY))
    return [each.boundaries for each in found if each]


def mark(index: int, source: float, target: float, rings: tuple[int, int] = (0, 0)) -> PlacedMark:
    return PlacedMark(rings, (source, target), index)


@settings(max_examples=10)
@given(star_shaped(), star_shaped())
def test_proposed_boundaries_go_once_round_both_outlines(source: Array, target: Array) -> None:
    ends = cleaned(source), cleaned(target)
    found = proposals(*ends)
    assert found
    for [pair] in found:
        assert len(pair.source) == len(pair.target) >= 3
        for points, end in zip((pair.source, pair.target), ends, strict=True):
            assert len(np.unique(points, axis=0)) == len(points)
            assert signed_area(points) == pytest.approx(end.area, rel=1e-6)


@given(st.floats(0, 20), st.floats(0, 20))
def test_marks_on_the_exterior_decide(here: float, there: float) -> None:
    ends = cleaned(letter_l()), cleaned(ellipse(60))
    rings = ends[0].rings[0], ends[1].rings[0]
    here, there = (x % arc_lengths(ring)[-1] for x, ring in zip((here, there), rings, strict=True))
    [[pair]] = proposals(*ends, [mark(0, here, there)])
    places = [
        points_at(ring, arc_lengths(ring), np.array([length]))[0]
        for ring, length in zip(rings, (here, there), strict=True)
    ]
    away = [
        np.hypot(*(points - place).T)
        for points, place in zip((pair.source, pair.target), places, strict=True)
    ]
    assert min(away[0] + away[1]) < 1e-6


def test_marks_of_the_artist_out_of_order_are_refused_and_not_replaced_by_a_proposal() -> None:
    ends = cleaned(ellipse(60)), cleaned(ellipse(60))
    marks = [mark(0, 1.0, 1.0), mark(1, 3.0, 5.0), mark(2, 5.0, 3.0), mark(3, 7.0, 7.0)]
    with pytest.raises(MarkError, match="order"):
        proposals(*ends, marks)


@pytest.mark.parametrize("turn", [0.0, 0.4, -2.0])
def test_the_first_proposal_for_a_shape_and_itself_turned_is_that_turn(turn: float) -> None:
    source = cleaned(letter_l())
    target = cleaned(letter_l() @ rotation(turn).T)
    [pair] = proposals(source, target)[0]
    assert np.allclose(pair.source @ rotation(turn).T, pair.target, atol=1e-6)


def test_holes_go_where_the_exterior_carries_them_unless_their_marks_say_otherwise() -> None:
    left, right = hole(-1, 0), hole(1, 0)
    ends = cleaned(ellipse(60), left, right), cleaned(ellipse(60), right, left)
    marks = [mark(0, 0.0, 0.0)]
    [[_, first, second]] = proposals(*ends, marks)
    assert np.allclose(first.source.mean(axis=0), first.target.mean(axis=0), atol=1e-2)
    assert np.allclose(second.source.mean(axis=0), second.target.mean(axis=0), atol=1e-2)
    [[_, first, _]] = proposals(*ends, [*marks, mark(1, 0.0, 0.0, (1, 1))])
    assert np.allclose(first.source.mean(axis=0), -first.target.mean(axis=0), atol=1e-2)


@pytest.mark.parametrize(
    ("pairs", "named"),
    [
        ([((0, 0), (1, 0))], "a joins the exterior of the source to hole 1 of the target"),
        ([((1, 0), (0, 0))], "a joins hole 1 of the source to the exterior of the target"),
        ([((1, 0), (1, 0)), ((1, 1), (2, 1))], "b joins hole 1 of the source to hole 2"),
        ([((1, 0), (1, 0)), ((2, 1), (1, 1))], "b joins hole 2 of the source to hole 1"),
    ],
)
def test_marks_that_join_rings_of_different_kinds_are_refused_by_name(
    pairs: list[tuple[tuple[int, int], tuple[int, int]]], named: str
) -> None:
    rings = [ellipse(60), hole(-1, 0), hole(1, 0)]
    outline, end = Outline.polygon(*rings), cleaned(*rings)
    marks = [(RingPoint(i, float(a)), RingPoint(j, float(b))) for (i, a), (j, b) in pairs]
    with pytest.raises(MarkError, match=named) as refused:
        place_marks((outline, outline), (end, end), marks, "ab")
    assert refused.value.where.marks == (len(pairs) - 1,)


def test_matching_can_be_stopped_before_every_ring() -> None:
    ends = cleaned(*square_ring()), cleaned(*square_ring(0.3))
    calls: list[str] = []
    first = next(ways(*ends, [], "", DENSITY, calls.append)).follow()
    assert len(calls) >= len(first.boundaries) == 2

    def stop(stage: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        next(ways(*ends, [], "", DENSITY, stop))
