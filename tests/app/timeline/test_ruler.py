"""The ruler scrubs at once, and never changes the document."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from app.timeline.timeline import Timeline
from app.workspace import Workspace
from core.model import Keyframe
from core.model.edits import duplicate_layer, insert_keyframe
from tests.app.timeline.conftest import SQUARE, Mouse

LOW = 35.0
"""Below the strip of the playback range."""
STRIP = 6.0
SHIFT = Qt.KeyboardModifier.ShiftModifier


def x_of(timeline: Timeline, frame: float) -> float:
    return timeline.view.scale.x(frame)


def wheel(widget: QWidget, x: float, turn: int, modifiers: object = None) -> None:
    place = QPointF(x, LOW)
    QApplication.sendEvent(
        widget,
        QWheelEvent(
            place,
            widget.mapToGlobal(place),
            QPoint(),
            QPoint(0, turn),
            Qt.MouseButton.NoButton,
            modifiers or Qt.KeyboardModifier.NoModifier,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        ),
    )


def test_scrubbing_shows_every_frame_passed_over_in_order_and_changes_nothing(
    timeline: Timeline, workspace: Workspace
) -> None:
    document, seen = workspace.session.document, []
    workspace.playhead.moved.connect(seen.append)
    mouse = Mouse(timeline.ruler)
    mouse.press(x_of(timeline, 3), LOW)
    mouse.move(x_of(timeline, 20), LOW)
    mouse.move(x_of(timeline, 12), LOW)
    mouse.release()
    assert seen == [*range(3, 21), *range(19, 11, -1)]
    assert workspace.session.document is document
    assert workspace.session.undo_stack.count() == 0


def test_one_press_goes_to_that_frame(timeline: Timeline, workspace: Workspace) -> None:
    Mouse(timeline.ruler).click(x_of(timeline, 7) + 2, LOW)
    assert workspace.playhead.frame == 7


def test_with_shift_the_space_between_frames_is_scrubbed(
    timeline: Timeline, workspace: Workspace
) -> None:
    x = x_of(timeline, 7.4)
    Mouse(timeline.ruler).click(x, LOW, SHIFT)
    assert workspace.playhead.frame == round(timeline.view.scale.frame(round(x)), 2)
    assert workspace.playhead.frame % 1 != 0


def test_scrubbing_stops_playing(timeline: Timeline, workspace: Workspace) -> None:
    workspace.playhead.play()
    Mouse(timeline.ruler).click(x_of(timeline, 7), LOW)
    assert not workspace.playhead.playing


def test_scrubbing_beyond_the_edge_scrolls_time(timeline: Timeline, workspace: Workspace) -> None:
    mouse = Mouse(timeline.ruler)
    mouse.press(x_of(timeline, 20), LOW)
    last = timeline.view.scale.frame(timeline.ruler.width())
    mouse.move(timeline.ruler.width() + 60, LOW)
    mouse.release()
    assert workspace.playhead.frame > last
    assert 0 <= x_of(timeline, workspace.playhead.frame) <= timeline.ruler.width()


def test_scrubbing_never_goes_before_the_first_frame(
    timeline: Timeline, workspace: Workspace
) -> None:
    mouse = Mouse(timeline.ruler)
    mouse.press(x_of(timeline, 5), LOW)
    mouse.move(-40, LOW)
    mouse.release()
    assert workspace.playhead.frame == 1


def test_escape_takes_a_scrub_back(timeline: Timeline, workspace: Workspace) -> None:
    mouse = Mouse(timeline.ruler)
    mouse.press(x_of(timeline, 5), LOW)
    mouse.move(x_of(timeline, 9), LOW)
    QTest.keyClick(timeline.ruler, Qt.Key.Key_Escape)
    mouse.move(x_of(timeline, 12), LOW)
    mouse.release()
    assert workspace.playhead.frame == 1


# -- playback range ----------------------------------------------------------------------------


def test_the_handles_limit_playback(timeline: Timeline, workspace: Workspace) -> None:
    mouse = Mouse(timeline.ruler)
    mouse.drag((x_of(timeline, 25), STRIP), (x_of(timeline, 18), STRIP))
    assert workspace.playhead.range == (1, 18)
    mouse.drag((x_of(timeline, 1), STRIP), (x_of(timeline, 6), STRIP))
    assert workspace.playhead.range == (6, 18)
    assert workspace.playhead.frame == 1
    assert workspace.session.undo_stack.count() == 0


def test_a_handle_stops_at_the_other_one(timeline: Timeline, workspace: Workspace) -> None:
    workspace.playhead.set_range((5, 10))
    mouse = Mouse(timeline.ruler)
    mouse.drag((x_of(timeline, 5), STRIP), (x_of(timeline, 20), STRIP))
    assert workspace.playhead.range == (10, 10)
    mouse.drag((x_of(timeline, 10), STRIP), (x_of(timeline, 15), STRIP))
    assert workspace.playhead.range == (10, 15)


def test_escape_puts_a_handle_back(timeline: Timeline, workspace: Workspace) -> None:
    mouse = Mouse(timeline.ruler)
    mouse.press(x_of(timeline, 25), STRIP)
    mouse.move(x_of(timeline, 18), STRIP)
    QTest.keyClick(timeline.ruler, Qt.Key.Key_Escape)
    mouse.release()
    assert not workspace.playhead.limited


# -- zoom and pan ------------------------------------------------------------------------------


def test_the_wheel_zooms_at_the_cursor(timeline: Timeline) -> None:
    before, x = timeline.view.scale, 300.0
    wheel(timeline.ruler, x, 120)
    after = timeline.view.scale
    assert after.pixels > before.pixels
    assert abs(after.frame(x) - before.frame(x)) < 1e-9
    wheel(timeline.tracks, x, -120)
    assert abs(timeline.view.scale.pixels - before.pixels) < 1e-9


def test_the_wheel_scrolls_through_layers_where_more_are_there_than_fit(
    timeline: Timeline, workspace: Workspace
) -> None:
    for _ in range(4):
        workspace.session.apply("", duplicate_layer, 1, "copy")
    workspace.selection.select_layer(2)
    QApplication.processEvents()
    before, place = timeline.view.scale, timeline.headers.mapTo(timeline, QPoint())
    at = timeline.tracks.mapTo(timeline.window(), QPoint(300, 20))
    QTest.wheelEvent(timeline.windowHandle(), QPointF(at), QPoint(0, -120))
    QApplication.processEvents()
    assert timeline.view.scale == before
    assert timeline.headers.mapTo(timeline, QPoint()).y() < place.y()
    wheel(timeline.tracks, 300.0, -120, Qt.KeyboardModifier.ControlModifier)
    assert timeline.view.scale.pixels < before.pixels


def test_the_wheel_with_shift_pans(timeline: Timeline) -> None:
    before = timeline.view.scale
    wheel(timeline.ruler, 300.0, 120, SHIFT)
    assert timeline.view.scale.pixels == before.pixels
    assert timeline.view.scale.left < before.left


def test_the_middle_button_pans_and_leaves_the_playhead(
    timeline: Timeline, workspace: Workspace
) -> None:
    before = timeline.view.scale
    mouse = Mouse(timeline.ruler)
    mouse.press(200, LOW, Qt.MouseButton.MiddleButton)
    mouse.move(260, LOW)
    mouse.release()
    assert timeline.view.scale.x(1) == pytest.approx(before.x(1) + 60)
    assert workspace.playhead.frame == 1


def test_a_double_click_fits_everything_in_again(timeline: Timeline) -> None:
    fitted = timeline.view.scale
    wheel(timeline.ruler, 300.0, 360)
    assert timeline.view.scale != fitted
    QTest.mouseDClick(timeline.ruler, Qt.MouseButton.LeftButton, pos=QPoint(300, int(LOW)))
    assert timeline.view.scale == fitted


def test_resizing_fits_time_into_the_new_width_until_the_artist_zooms(timeline: Timeline) -> None:
    timeline.resize(1400, 200)
    assert abs(timeline.view.scale.x(25) - (timeline.ruler.width() - 28)) < 1
    wheel(timeline.ruler, 300.0, 120)
    zoomed = timeline.view.scale
    timeline.resize(1100, 200)
    assert timeline.view.scale == zoomed


def test_a_new_key_beyond_the_end_is_in_view_until_the_artist_zooms(
    timeline: Timeline, workspace: Workspace
) -> None:
    session = workspace.session
    session.apply("Insert keyframe", insert_keyframe, 2, Keyframe(48, SQUARE))
    assert x_of(timeline, 48) == pytest.approx(timeline.ruler.width() - 28)
    session.undo()
    assert x_of(timeline, 25) == pytest.approx(timeline.ruler.width() - 28)
    wheel(timeline.ruler, 300.0, 120)
    zoomed = timeline.view.scale
    session.redo()
    assert timeline.view.scale == zoomed


def test_the_playhead_stays_in_view_while_it_plays_on(
    timeline: Timeline, workspace: Workspace
) -> None:
    wheel(timeline.ruler, x_of(timeline, 1), 1200)
    for frame in range(1, 26):
        workspace.playhead.move_to(frame)
        assert 0 <= x_of(timeline, frame) <= timeline.ruler.width()
