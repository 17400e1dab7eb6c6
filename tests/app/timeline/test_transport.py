"""The transport, the headers and the fields drive the playhead and the document."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QComboBox, QToolButton, QWidget
from pytestqt.qtbot import QtBot

from app.document.playhead import Loop
from app.timeline.headers import LayerHeader
from app.timeline.timeline import Timeline
from app.workspace import Workspace
from core.model import Document
from core.model.edits import move_keyframe
from tests.app.timeline.conftest import layer

Key = Qt.Key
LEFT = Qt.MouseButton.LeftButton


def button(timeline: Timeline, tip: str) -> QToolButton:
    return next(b for b in timeline.findChildren(QToolButton) if b.toolTip().startswith(tip))


def press(timeline: Timeline, tip: str) -> None:
    QTest.mouseClick(button(timeline, tip), LEFT)


def enter(field: QWidget, text: str) -> None:
    """Type into a field and press Return."""
    line = field.lineEdit()
    line.setFocus()
    line.selectAll()
    QTest.keyClicks(line, text)
    QTest.keyClick(line, Key.Key_Return)


def test_the_buttons_move_the_playhead(timeline: Timeline, workspace: Workspace) -> None:
    seen: list[float] = []
    workspace.playhead.moved.connect(seen.append)
    for tip in ("Next frame", "Next key", "To the end", "Previous key", "Previous frame"):
        press(timeline, tip)
    press(timeline, "To the start")
    assert seen == [2, 9, 25, 13, 12, 1]


def test_the_play_button_plays_then_stops_and_is_named_for_what_it_does(
    timeline: Timeline, workspace: Workspace
) -> None:
    press(timeline, "Play (Space)")
    assert workspace.playhead.playing
    assert timeline.transport.play.accessibleName() == "Pause (Space)"
    press(timeline, "Pause")
    assert not workspace.playhead.playing
    assert timeline.transport.play.accessibleName() == "Play (Space)"


def test_the_loop_menu_sets_what_happens_at_the_end(
    timeline: Timeline, workspace: Workspace
) -> None:
    for action, loop in zip(timeline.transport.loop.menu().actions(), Loop, strict=True):
        action.trigger()
        assert workspace.playhead.loop is loop
        assert action.text() in timeline.transport.loop.toolTip()


def test_a_typed_frame_is_gone_to_and_the_keyboard_is_back_on_the_tracks(
    timeline: Timeline, workspace: Workspace
) -> None:
    timeline.activateWindow()
    enter(timeline.transport.frame, "12.5")
    assert workspace.playhead.frame == 12.5
    assert timeline.tracks.hasFocus()


def test_the_frame_field_follows_the_playhead(timeline: Timeline, workspace: Workspace) -> None:
    for frame, text in ((7, "7"), (7.25, "7.25"), (120, "120")):
        workspace.playhead.move_to(frame)
        assert timeline.transport.frame.text() == text


def test_the_range_fields_limit_playback_and_the_cross_plays_everything(
    timeline: Timeline, workspace: Workspace
) -> None:
    enter(timeline.transport.first, "5")
    enter(timeline.transport.last, "20")
    assert workspace.playhead.range == (5, 20)
    press(timeline, "Play everything")
    assert not workspace.playhead.limited
    assert timeline.transport.first.value() == 1
    assert timeline.transport.last.value() == 25
    assert workspace.session.undo_stack.count() == 0


def test_the_range_fields_show_the_keys_until_a_range_is_set(
    timeline: Timeline, workspace: Workspace
) -> None:
    workspace.session.apply("Move", move_keyframe, 1, 2, 40)
    assert timeline.transport.last.value() == 40
    assert not workspace.playhead.limited


def test_any_frame_rate_can_be_typed_in_one_undo_step_and_nonsense_is_not_taken(
    timeline: Timeline, workspace: Workspace
) -> None:
    box = timeline.transport.frame_rate
    enter(box, "23.976")
    assert workspace.session.document.fps == 23.976
    assert workspace.session.undo_stack.count() == 1
    enter(box, "0")
    assert workspace.session.document.fps == 23.976
    workspace.session.undo()
    assert box.currentText() == "24"


def test_the_usual_frame_rates_are_offered(timeline: Timeline, workspace: Workspace) -> None:
    box = timeline.transport.frame_rate
    assert [box.itemText(i) for i in range(box.count())] == ["12", "24", "25", "30", "60"]
    box.setCurrentIndex(0)
    box.activated.emit(0)
    assert workspace.session.document.fps == 12


def test_the_eye_and_the_padlock_are_one_step_each_and_say_what_they_do(
    timeline: Timeline, workspace: Workspace
) -> None:
    before = workspace.session.document
    press(timeline, "Hide layer layer 1")
    assert not workspace.session.document.layer(1).visible
    press(timeline, "Lock layer layer 1")
    assert workspace.session.document.layer(1).locked
    assert button(timeline, "Show layer layer 1").accessibleName() == "Show layer layer 1"
    workspace.session.undo()
    workspace.session.undo()
    assert workspace.session.document is before
    assert button(timeline, "Hide layer layer 1")


def test_a_click_on_a_name_chooses_the_layer(timeline: Timeline, workspace: Workspace) -> None:
    QTest.mouseClick(timeline.headers.childAt(120, 40), LEFT)
    assert workspace.selection.layer.id == 1


def test_there_is_one_name_a_layer_whatever_is_opened(
    timeline: Timeline, workspace: Workspace, qtbot: QtBot
) -> None:
    def shown() -> list[str]:
        headers = timeline.headers.findChildren(LayerHeader)
        return sorted(header.toolTip() for header in headers if header.isVisible())

    for count in (4, 0, 2):
        layers = tuple(layer(i, 1, 9) for i in range(1, count + 1))
        workspace.session.replace(Document(layers))
        names = [one.name for one in layers]
        qtbot.waitUntil(lambda names=names: shown() == names)


def test_every_control_has_a_name_and_room_to_be_hit(timeline: Timeline, qtbot: QtBot) -> None:
    kinds = (QToolButton, QAbstractSpinBox, QComboBox)
    controls = [c for c in timeline.findChildren(QWidget) if isinstance(c, kinds)]
    assert len(controls) >= 16
    for control in controls:
        assert control.accessibleName(), control
        assert min(control.width(), control.height()) >= 24, control.accessibleName()


def test_the_wheel_over_a_field_without_focus_changes_nothing(
    timeline: Timeline, workspace: Workspace
) -> None:
    before = workspace.session.document
    timeline.tracks.setFocus()
    for field in (timeline.transport.frame_rate, timeline.transport.frame):
        place = QPointF(8, 8)
        event = QWheelEvent(
            place,
            field.mapToGlobal(place),
            QPoint(),
            QPoint(0, 120),
            Qt.MouseButton.NoButton,
            Qt.KeyboardModifier.NoModifier,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(field, event)
    assert workspace.session.document is before
    assert workspace.playhead.frame == 1
