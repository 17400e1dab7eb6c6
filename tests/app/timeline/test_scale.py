"""The scale of time."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.timeline.scale import COARSEST, FINEST, TimeScale, multiples, step_for

frames = st.floats(-1000, 10000)
pixels = st.floats(COARSEST, FINEST)
widths = st.floats(200, 3000)
scales = st.builds(TimeScale, frames, pixels)


@given(scales, frames)
def test_pixels_lead_back_to_frames(scale: TimeScale, frame: float) -> None:
    assert scale.frame(scale.x(frame)) == pytest.approx(frame, abs=1e-6)


@given(scales, st.floats(0.1, 10), st.floats(0, 2000))
def test_zooming_keeps_the_frame_under_the_cursor(
    scale: TimeScale, factor: float, x: float
) -> None:
    zoomed = scale.zoomed(factor, x)
    assert zoomed.frame(x) == pytest.approx(scale.frame(x), rel=1e-9, abs=1e-6)
    assert COARSEST <= zoomed.pixels <= FINEST


@given(scales, st.floats(-500, 500), frames)
def test_panning_shifts_every_frame_alike(scale: TimeScale, dx: float, frame: float) -> None:
    assert scale.panned(dx).x(frame) == pytest.approx(scale.x(frame) + dx, rel=1e-9, abs=1e-6)


@given(st.integers(-100, 1000), st.integers(0, 2000), widths)
def test_fitting_shows_both_ends_with_a_margin(first: int, length: int, width: float) -> None:
    scale = TimeScale.fitted(first, first + length, width)
    assert 0 < scale.x(first) < width
    assert 0 < scale.x(first + length) < width


@given(scales, frames, widths)
def test_following_brings_a_frame_into_view(scale: TimeScale, frame: float, width: float) -> None:
    shown = scale.showing(frame, width)
    assert -1e-6 <= shown.x(frame) <= width + 1e-6
    assert shown.pixels == scale.pixels


@given(scales, frames, widths)
def test_following_leaves_alone_what_is_in_view(
    scale: TimeScale, frame: float, width: float
) -> None:
    if 0 <= scale.x(frame) <= width:
        assert scale.showing(frame, width) is scale


@given(pixels, st.floats(1, 100))
def test_labels_have_room_and_are_no_sparser_than_need_be(pixel: float, room: float) -> None:
    step = step_for(pixel, room)
    assert step * pixel >= room * (1 - 1e-9)
    assert step == 1 or step * pixel <= 2.5 * room + 2.5 * pixel
    assert int(str(step).rstrip("0")) in (1, 2, 5)


@given(st.integers(-50, 500), st.integers(0, 300), st.sampled_from([1, 2, 5, 10, 20, 50]))
def test_labels_are_multiples_that_begin_at_the_lowest(first: int, count: int, step: int) -> None:
    labels = multiples(first, first + count, step, 1)
    assert labels == sorted(set(labels))
    assert all(label % step == 0 or label == 1 for label in labels)
    wanted = {f for f in range(max(first, 1), first + count + 1) if f % step == 0}
    assert wanted <= set(labels)
