from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import Cancelled
from core.geometry.flatten import flatten
from core.model import Keyframe, Layer, Outline, Ring
from core.model.easing import EASE_IN_OUT
from core.morph.morph import Morph
from core.morph.scene import Span, solve_span, span_of, timed_span_of
from core.morph.soundness import check_frame, check_span, crossings

SQUARE = np.array([[0, 0], [4, 0], [4, 4], [0, 4]], dtype=float)
BOW = np.array([[0, 0], [4, 4], [4, 0], [0, 4]], dtype=float)
FRAMES = [(frame, frame / 4) for frame in range(5)]


def solved(source: Outline, target: Outline) -> tuple[Span, Morph]:
    span = span_of(Layer(1, "x", (Keyframe(1, source), Keyframe(9, target))), 0)
    return span, solve_span(span)


@pytest.mark.parametrize(
    ("rings", "places"),
    [
        ([SQUARE], []),
        ([SQUARE, SQUARE / 4 + 1], []),
        ([BOW], [(2, 2)]),
        ([SQUARE, SQUARE / 2 + 3], [(3, 4), (4, 3)]),
        ([SQUARE, SQUARE / 4 + 10], [(10, 10)]),  # a hole outside
        ([np.array([[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]], dtype=float)], [(2, 0)]),  # touching
    ],
)
def test_crossings_are_found_where_they_are(
    rings: list[np.ndarray], places: list[tuple[int, int]]
) -> None:
    assert sorted(map(tuple, crossings(rings))) == places


def test_every_crossing_and_fold_of_a_frame_has_its_place() -> None:
    _, morph = solved(Outline.polygon(SQUARE), Outline.polygon(SQUARE + 9))
    points = morph.rest.copy()
    points[np.all(points == [4, 4], axis=1)] = [-1, 1]  # a corner pulled through the side opposite
    found = check_frame(3, morph, points)
    assert found.folds > 0
    assert found.crossings == 2
    assert found.places.shape == (found.folds + 2, 2)
    assert np.allclose(found.places[-2:, 0], 0)
    assert not found.sound
    nowhere = check_frame(3, morph, np.full_like(points, np.nan))
    assert not nowhere.sound


def test_frames_are_looked_at_in_the_order_asked_for_and_told_in_theirs() -> None:
    span, morph = solved(Outline.polygon(SQUARE), Outline.polygon(SQUARE + 9))
    told: list[float] = []
    found = check_span(span, morph, FRAMES[::-1], lambda fraction, stage: told.append(fraction))
    assert [frame.frame for frame in found.frames] == [0, 1, 2, 3, 4]
    assert told == pytest.approx([0, 0.2, 0.4, 0.6, 0.8])


def test_a_check_can_be_stopped_at_each_frame() -> None:
    span, morph = solved(Outline.polygon(SQUARE), Outline.polygon(SQUARE + 9))

    def stop(fraction: float, stage: str) -> None:
        if fraction > 0.3:
            raise Cancelled

    with pytest.raises(Cancelled):
        check_span(span, morph, FRAMES, stop)


def test_a_timed_span_has_every_frame_from_key_to_key_as_the_layer_has_them() -> None:
    keys = [Keyframe(f, Outline.polygon(SQUARE + f), easing=EASE_IN_OUT) for f in (3, 9, 10)]
    layer = Layer(1, "x", tuple(keys))
    timed = timed_span_of(layer, 0)
    assert timed.frames()[:-1] == [(f, layer.progress_at(f)[1]) for f in range(3, 9)]
    assert timed.frames()[-1] == (9, 1.0)
    assert timed_span_of(layer, 1).frames() == [(9, 0.0), (10, 1.0)]


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


def test_a_map_that_is_not_proved_to_be_one_to_one_is_not_sound_whatever_its_frames() -> None:
    span, morph = solved(Outline.polygon(SQUARE), Outline.polygon(SQUARE + 9))
    doubtful = replace(morph.report.certificate, bordered=False)
    morph = replace(morph, report=replace(morph.report, certificate=doubtful))
    found = check_span(span, morph, FRAMES)
    assert found.exact
    assert all(frame.sound for frame in found.frames)
    assert not found.sound


def test_curves_are_measured_where_they_were_flattened() -> None:
    points = np.array([[1, 0], [0, 1], [-1, 0], [0, -1]], dtype=float)
    along = 0.55 * np.roll(points, -1, axis=0)
    round_one = Outline((Ring(points, -along, along),))
    assert len(flatten(round_one)[0].points) > 8
    span, morph = solved(round_one, round_one.transformed([[2, 0], [0, 2]]))
    found = check_span(span, morph, FRAMES)
    assert max(found.source_error, found.target_error) <= 1e-9


def test_the_repair_of_an_outline_that_bulges_beyond_its_nodes_is_no_fault() -> None:
    points = np.array([[0, 0], [0, 60], [-1e-4, 0]])  # it comes back on the wrong side of its start
    before, after = np.array([[0, 0], [-40, 0], [40, 0]]), np.array([[-40, 0], [40, 0], [0, 0]])
    drop = Outline((Ring(points, before.astype(float), after.astype(float)),))
    span, morph = solved(drop, drop.transformed(np.eye(2), [9, 0]))
    assert morph.report.repairs
    assert check_span(span, morph, FRAMES).exact
