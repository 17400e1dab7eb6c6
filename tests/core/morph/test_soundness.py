from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.geometry.flatten import flatten
from core.model import Keyframe, Layer, Outline, Ring
from core.morph.morph import Morph
from core.morph.scene import Span, solve_span, span_of
from core.morph.soundness import check_span, crossings

SQUARE = np.array([[0, 0], [4, 0], [4, 4], [0, 4]], dtype=float)
BOW = np.array([[0, 0], [4, 4], [4, 0], [0, 4]], dtype=float)
FRAMES = [(frame, frame / 4) for frame in range(5)]


def solved(source: Outline, target: Outline) -> tuple[Span, Morph]:
    span = span_of(Layer(1, "x", (Keyframe(1, source), Keyframe(9, target))), 0)
    return span, solve_span(span)


@pytest.mark.parametrize(
    ("rings", "count"),
    [
        ([SQUARE], 0),
        ([SQUARE, SQUARE / 4 + 1], 0),
        ([BOW], 1),
        ([SQUARE, SQUARE / 2 + 3], 2),
        ([SQUARE, SQUARE / 4 + 10], 1),  # a hole outside
        ([np.array([[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]], dtype=float)], 1),  # touching
    ],
)
def test_crossings_are_counted(rings: list[np.ndarray], count: int) -> None:
    assert crossings(rings) == count


def test_a_rigid_motion_is_sound() -> None:
    source = Outline.polygon(SQUARE, SQUARE[::-1] / 4 + 1)
    span, morph = solved(source, source.transformed([[0, -1], [1, 0]], [20, 0]))
    found = check_span(span, morph, FRAMES)
    assert found.sound
    assert [(f.frame, f.folds, f.crossings) for f in found.frames] == [(i, 0, 0) for i in range(5)]
    assert found.seconds_per_frame > 0


def test_holes_may_be_drawn_in_any_order() -> None:
    large, small = SQUARE / 4 + 0.5, SQUARE[::-1] / 8 + 3
    span, morph = solved(
        Outline.polygon(SQUARE, large, small), Outline.polygon(SQUARE, small, large)
    )
    assert check_span(span, morph, FRAMES).sound


def test_a_corner_that_is_cut_off_shows_in_the_ends() -> None:
    corners = Outline.polygon(SQUARE)
    span, morph = solved(corners, Outline.polygon(SQUARE + 9))
    cut = Outline.polygon([[0, 0], [4, 0], [4, 3], [3, 4], [0, 4]])
    for drawn, side in ((replace(span, source=cut), 0), (replace(span, target=cut), 1)):
        found = check_span(drawn, morph, FRAMES)
        errors = (found.source_error, found.target_error)
        assert errors[side] > 0.1
        assert errors[1 - side] <= 1e-9
        assert not found.sound


def test_curves_are_measured_where_they_were_flattened() -> None:
    points = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]], dtype=float)
    along = 0.55 * np.roll(points, -1, axis=0)
    round_one = Outline((Ring(points, -along, along),))
    assert len(flatten(round_one)[0].points) > 8
    span, morph = solved(round_one, round_one.transformed([[2, 0], [0, 2]]))
    found = check_span(span, morph, FRAMES)
    assert max(found.source_error, found.target_error) <= 1e-9
