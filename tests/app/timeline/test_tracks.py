"""Keys and spans on the tracks, by mouse and by keyboard."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QContextMenuEvent, QHelpEvent, QImage, QPainter, QPaintEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QToolTip
from pytestqt.qtbot import QtBot

from app.jobs.solver import SpanState
from app.timeline.menu import TrackMenu
from app.timeline.painting import BAND, paint_key, paint_state
from app.timeline.rows import ROW
from app.timeline.timeline import Timeline
from app.workspace import Workspace
from core.model import Document
from core.model.edits import update_layer
from tests.app.timeline.conftest import Mouse, layer, row_y

Key = Qt.Key
ALT, CTRL = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ControlModifier
TOP, BOTTOM = row_y(0), row_y(1)
"""Layer 2 is on top, layer 1 below it."""


def x_of(timeline: Timeline, frame: float) -> float:
    return timeline.view.scale.x(frame)


def frames(workspace: Workspace, layer: int = 1) -> list[int]:
    return [key.frame for key in workspace.session.document.layer(layer).keyframes]


def chosen(workspace: Workspace) -> tuple[int, int]:
    assert workspace.selection.layer is not None
    return workspace.selection.layer.id, workspace.selection.key


@pytest.fixture
def mouse(timeline: Timeline) -> Mouse:
    return Mouse(timeline.tracks)


# -- mouse -------------------------------------------------------------------------------------


def test_a_click_on_a_key_chooses_it_and_goes_there(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    mouse.click(x_of(timeline, 13), BOTTOM)
    assert chosen(workspace) == (1, 1)
    assert workspace.playhead.frame == 13
    assert workspace.session.undo_stack.count() == 0


def test_a_click_on_a_span_chooses_it_and_goes_there(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    mouse.click(x_of(timeline, 19), BOTTOM)
    assert chosen(workspace) == (1, 1)
    assert workspace.playhead.frame == 19
    assert workspace.session.undo_stack.count() == 0


def test_a_click_beside_the_spans_chooses_the_layer(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    mouse.click(x_of(timeline, 20), BOTTOM)
    mouse.click(x_of(timeline, 20), TOP)
    assert chosen(workspace) == (2, 0)


def test_dragging_a_key_is_one_step_and_undo_restores_the_identical_document(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    before, seen = workspace.session.document, []
    workspace.session.changed.connect(lambda document: seen.append(frames(workspace)[1]))
    mouse.drag((x_of(timeline, 13), BOTTOM), (x_of(timeline, 18), BOTTOM))
    assert frames(workspace) == [1, 18, 25]
    assert seen == [14, 15, 16, 17, 18]
    assert workspace.session.undo_stack.count() == 1
    assert workspace.session.undo_stack.undoText() == "Move keyframe"
    workspace.session.undo()
    assert workspace.session.document is before


@pytest.mark.parametrize("copied", [False, True])
def test_undo_while_a_key_is_dragged_or_copied_ends_that_and_leaves_nothing_of_it(
    timeline: Timeline, workspace: Workspace, mouse: Mouse, copied: bool
) -> None:
    before = workspace.session.document
    modifiers = ALT if copied else Qt.KeyboardModifier.NoModifier
    mouse.press(x_of(timeline, 13), BOTTOM, modifiers=modifiers)
    mouse.move(x_of(timeline, 16), BOTTOM)
    assert workspace.session.document is not before
    workspace.session.undo()
    frame = workspace.playhead.frame
    mouse.move(x_of(timeline, 20), BOTTOM)
    mouse.release()
    assert workspace.session.document is before
    assert workspace.session.undo_stack.index() == 0
    assert workspace.playhead.frame == frame


@pytest.mark.parametrize("copied", [False, True])
def test_an_edit_while_a_key_is_dragged_or_copied_ends_that_and_both_are_kept(
    timeline: Timeline, workspace: Workspace, mouse: Mouse, copied: bool
) -> None:
    modifiers = ALT if copied else Qt.KeyboardModifier.NoModifier
    mouse.press(x_of(timeline, 13), BOTTOM, modifiers=modifiers)
    mouse.move(x_of(timeline, 16), BOTTOM)
    workspace.session.apply("Rename layer", update_layer, 2, name="Leaf")
    renamed = workspace.session.document
    mouse.move(x_of(timeline, 20), BOTTOM)
    QTest.keyClick(timeline.tracks, Key.Key_Escape)
    mouse.release()
    assert workspace.session.document is renamed
    assert frames(workspace) == ([1, 13, 16, 25] if copied else [1, 16, 25])
    assert workspace.session.undo_stack.index() == 2


def test_a_dragged_key_takes_the_playhead_along(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    mouse.drag((x_of(timeline, 13), BOTTOM), (x_of(timeline, 18), BOTTOM))
    assert workspace.playhead.frame == 18


def test_a_key_stops_at_its_neighbours_and_at_the_first_frame(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    mouse.drag((x_of(timeline, 13), BOTTOM), (x_of(timeline, 40), BOTTOM))
    assert frames(workspace) == [1, 24, 25]
    mouse.drag((x_of(timeline, 24), BOTTOM), (x_of(timeline, -10), BOTTOM))
    assert frames(workspace) == [1, 2, 25]
    mouse.drag((x_of(timeline, 1), TOP), (x_of(timeline, 5), TOP))
    mouse.drag((x_of(timeline, 5), TOP), (x_of(timeline, -10), TOP))
    assert frames(workspace, 2) == [1, 9]


def test_a_drag_that_ends_where_it_began_leaves_no_step(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    mouse.press(x_of(timeline, 13), BOTTOM)
    mouse.move(x_of(timeline, 18), BOTTOM)
    mouse.move(x_of(timeline, 13), BOTTOM)
    mouse.release()
    assert workspace.session.undo_stack.count() == 0


def test_dragging_a_key_with_alt_leaves_it_and_takes_a_copy_along_as_one_step(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    before = workspace.session.document
    mouse.press(x_of(timeline, 1), BOTTOM, modifiers=ALT)
    mouse.move(x_of(timeline, 30), BOTTOM)  # over keys of its own layer
    mouse.release()
    assert frames(workspace) == [1, 13, 25, 30]
    keys = workspace.session.document.layer(1).keyframes
    assert (keys[3].outline, keys[3].marks) == (keys[0].outline, keys[0].marks)
    assert chosen(workspace) == (1, 3)
    assert workspace.playhead.frame == 30
    assert workspace.session.undo_stack.count() == 1
    workspace.session.undo()
    assert workspace.session.document is before


@pytest.mark.parametrize("end", ["Esc", "back where it began", "a mere click"])
def test_no_copy_of_a_key_is_left_after(
    end: str, timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    before = workspace.session.document
    mouse.press(x_of(timeline, 13), BOTTOM, modifiers=ALT)
    if end != "a mere click":
        mouse.move(x_of(timeline, 18), BOTTOM)
        assert frames(workspace) == [1, 13, 18, 25]
    if end == "Esc":
        QTest.keyClick(timeline.tracks, Key.Key_Escape)
    elif end == "back where it began":
        mouse.move(x_of(timeline, 13), BOTTOM)
    mouse.release()
    assert workspace.session.document is before
    assert workspace.session.undo_stack.count() == 0
    assert chosen(workspace) == (1, 1)


def test_a_hand_that_trembles_on_a_click_moves_no_key(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    timeline.view.zoom(0.1, 0)
    x = x_of(timeline, 13)
    mouse.drag((x, BOTTOM), (x + 3, BOTTOM))
    assert frames(workspace) == [1, 13, 25]


def test_escape_puts_a_dragged_key_back(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    before = workspace.session.document
    mouse.press(x_of(timeline, 13), BOTTOM)
    mouse.move(x_of(timeline, 18), BOTTOM)
    QTest.keyClick(timeline.tracks, Key.Key_Escape)
    mouse.release()
    assert workspace.session.document is before
    assert workspace.session.undo_stack.count() == 0
    assert workspace.playhead.frame == 13


def test_a_key_of_a_locked_layer_can_be_chosen_but_not_moved_or_deleted(
    timeline: Timeline, workspace: Workspace, mouse: Mouse, qtbot: QtBot
) -> None:
    workspace.session.apply("Lock", update_layer, 1, locked=True)
    mouse.drag((x_of(timeline, 13), BOTTOM), (x_of(timeline, 18), BOTTOM))
    assert chosen(workspace) == (1, 1)
    with qtbot.waitSignal(workspace.session.failed) as failed:
        QTest.keyClick(timeline.tracks, Key.Key_Delete)
    assert "locked" in failed.args[0].what
    assert frames(workspace) == [1, 13, 25]


def test_a_drag_over_the_tracks_scrubs(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    seen: list[float] = []
    workspace.playhead.moved.connect(seen.append)
    mouse.drag((x_of(timeline, 6), BOTTOM), (x_of(timeline, 18), TOP))
    assert seen == [*range(6, 19)]
    assert workspace.session.undo_stack.count() == 0


def test_a_double_click_on_a_span_plays_it_alone_and_another_plays_everything(
    timeline: Timeline, workspace: Workspace
) -> None:
    place = QPoint(round(x_of(timeline, 19)), round(BOTTOM))
    QTest.mouseDClick(timeline.tracks, Qt.MouseButton.LeftButton, pos=place)
    assert workspace.playhead.range == (13, 25)
    QTest.mouseDClick(timeline.tracks, Qt.MouseButton.LeftButton, pos=place)
    assert workspace.playhead.range == (1, 25)
    assert not workspace.playhead.limited


def test_the_menu_of_a_span_sets_its_easing_in_one_step(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    place = QPoint(round(x_of(timeline, 19)), round(BOTTOM))
    reason = QContextMenuEvent.Reason.Mouse
    event = QContextMenuEvent(reason, place, timeline.tracks.mapToGlobal(place))
    QApplication.sendEvent(timeline.tracks, event)
    menu = timeline.tracks.findChild(QMenu)
    easing = next(action.menu() for action in menu.actions() if action.menu())
    next(action for action in easing.actions() if action.text() == "Hold").trigger()
    menu.close()
    assert workspace.session.document.layer(1).keyframes[1].easing.hold
    assert workspace.session.undo_stack.count() == 1


def test_the_menu_of_a_key_lets_the_motion_pass_through_it(
    timeline: Timeline, workspace: Workspace
) -> None:
    place = QPoint(round(x_of(timeline, 13)), round(BOTTOM))
    for passes in (True, False):
        event = QContextMenuEvent(
            QContextMenuEvent.Reason.Mouse, place, timeline.tracks.mapToGlobal(place)
        )
        QApplication.sendEvent(timeline.tracks, event)
        menu = timeline.tracks.findChildren(TrackMenu)[-1]
        through = next(action for action in menu.actions() if "Pass through" in action.text())
        assert through.isChecked() != passes
        through.trigger()
        menu.close()
        assert workspace.session.document.layer(1).keyframes[1].passes == passes
    assert workspace.session.undo_stack.count() == 2


@pytest.mark.parametrize("passed", [True, False])
def test_a_key_is_round_where_the_motion_passes_through_it(passed: bool) -> None:
    image = QImage(20, 20, QImage.Format.Format_RGB32)
    painter = QPainter(image)
    paint_key(painter, QPointF(10, 10), passed=passed, chosen=False, hovered=False, dim=False)
    painter.end()
    rim = image.pixelColor(13, 13)  # of a diamond; a disc has it inside
    assert (rim == image.pixelColor(10, 10)) == passed


# -- keyboard ----------------------------------------------------------------------------------


def test_the_arrows_step_frames_and_keys(timeline: Timeline, workspace: Workspace) -> None:
    seen: list[float] = []
    workspace.playhead.moved.connect(seen.append)
    for key, modifiers in (
        (Key.Key_Right, Qt.KeyboardModifier.NoModifier),
        (Key.Key_Right, CTRL),
        (Key.Key_Right, CTRL),
        (Key.Key_Left, Qt.KeyboardModifier.NoModifier),
        (Key.Key_Left, CTRL),
        (Key.Key_End, Qt.KeyboardModifier.NoModifier),
        (Key.Key_Home, Qt.KeyboardModifier.NoModifier),
    ):
        QTest.keyClick(timeline.tracks, key, modifiers)
    assert seen == [2, 9, 13, 12, 9, 25, 1]


def test_a_key_that_is_stepped_to_is_the_one_that_delete_removes(
    timeline: Timeline, workspace: Workspace
) -> None:
    workspace.selection.select_layer(1)
    workspace.playhead.move_to(10)
    QTest.keyClick(timeline.tracks, Key.Key_Right, CTRL)
    assert chosen(workspace) == (1, 1)
    QTest.keyClick(timeline.tracks, Key.Key_Delete)
    assert frames(workspace) == [1, 25]


def test_space_plays_and_stops(timeline: Timeline, workspace: Workspace) -> None:
    QTest.keyClick(timeline.tracks, Key.Key_Space)
    assert workspace.playhead.playing
    QTest.keyClick(timeline.tracks, Key.Key_Space)
    assert not workspace.playhead.playing


def test_delete_removes_the_chosen_key_in_one_step(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    before = workspace.session.document
    mouse.click(x_of(timeline, 13), BOTTOM)
    QTest.keyClick(timeline.tracks, Key.Key_Delete)
    assert frames(workspace) == [1, 25]
    workspace.session.undo()
    assert workspace.session.document is before


def test_nudges_in_a_row_are_one_step_and_stop_at_the_neighbours(
    timeline: Timeline, workspace: Workspace, mouse: Mouse
) -> None:
    before = workspace.session.document
    mouse.click(x_of(timeline, 13), BOTTOM)
    for _ in range(15):
        QTest.keyClick(timeline.tracks, Key.Key_Right, ALT)
    assert frames(workspace) == [1, 24, 25]
    assert workspace.playhead.frame == 24
    assert workspace.session.undo_stack.count() == 1
    workspace.session.undo()
    assert workspace.session.document is before


def test_up_and_down_choose_layers(timeline: Timeline, workspace: Workspace) -> None:
    assert chosen(workspace) == (2, 0)
    for key, layer_id in ((Key.Key_Down, 1), (Key.Key_Down, 1), (Key.Key_Up, 2)):
        QTest.keyClick(timeline.tracks, key)
        assert chosen(workspace) == (layer_id, 0)


# -- what is said and shown --------------------------------------------------------------------


def test_the_row_of_a_layer_that_is_chosen_elsewhere_is_scrolled_to(
    timeline: Timeline, workspace: Workspace, qtbot: QtBot
) -> None:
    workspace.session.replace(Document(tuple(layer(i, 1, 9) for i in range(1, 21))))

    def in_view() -> bool:
        row = timeline.tracks.rows.layers().index(workspace.selection.layer)
        top = timeline.tracks.mapTo(timeline, QPoint(0, row * ROW)).y()
        return timeline.ruler.geometry().bottom() < top <= timeline.height() - ROW

    for layer_id in (1, 20, 7):
        workspace.selection.select_layer(layer_id)
        qtbot.waitUntil(in_view)


def test_the_description_names_what_is_chosen(timeline: Timeline, workspace: Workspace) -> None:
    workspace.selection.select_key(1, 1)
    said = timeline.tracks.accessibleDescription()
    assert said == "Layer layer 1, keyframe 2 of 3, at frame 13."


def test_the_tooltip_of_a_span_tells_how_it_stands_and_why_it_failed(
    timeline: Timeline, workspace: Workspace, qtbot: QtBot
) -> None:
    workspace.session.replace(Document((layer(1, 1, 9, 17, 25),)))
    qtbot.waitUntil(lambda: workspace.solver.state(1, 2) is SpanState.FAILED)
    qtbot.waitUntil(lambda: workspace.solver.state(1, 1) is SpanState.SOLVED)

    def tip(frame: float) -> str:
        place = QPoint(round(x_of(timeline, frame)), round(TOP))
        event = QHelpEvent(QEvent.Type.ToolTip, place, timeline.tracks.mapToGlobal(place))
        QApplication.sendEvent(timeline.tracks, event)
        return QToolTip.text()

    assert "Draw them anew." in tip(20)
    qtbot.waitUntil(lambda: "Sound" in tip(12))
    assert "keyframe at frame 9" in tip(9)


@pytest.mark.parametrize("first", list(SpanState))
@pytest.mark.parametrize("second", list(SpanState))
def test_states_differ_in_shape_and_not_by_colour_alone(
    first: SpanState, second: SpanState, qapp: object
) -> None:
    def silhouette(state: SpanState) -> bytes:
        image = QImage(64, 12, QImage.Format.Format_ARGB32)
        image.fill(0)
        with QPainter(image) as painter:
            paint_state(painter, QRectF(2, 3, 60, BAND), state)
        return bytes(image.convertToFormat(QImage.Format.Format_Alpha8).constBits())

    assert (silhouette(first) == silhouette(second)) == (first is second)


class PaintWatch(QObject):
    """Notes how wide each repaint is."""

    def __init__(self) -> None:
        super().__init__()
        self.widths: list[int] = []

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(event, QPaintEvent):
            self.widths.append(event.rect().width())
        return False


def test_a_moving_playhead_repaints_a_strip_and_not_the_whole_timeline(
    timeline: Timeline, workspace: Workspace, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: not workspace.solver.busy and not workspace.inspector.busy)
    QApplication.processEvents()
    watch = PaintWatch()
    timeline.tracks.installEventFilter(watch)
    workspace.playhead.move_to(5)
    qtbot.waitUntil(lambda: bool(watch.widths))
    assert max(watch.widths) < timeline.tracks.width() / 2
