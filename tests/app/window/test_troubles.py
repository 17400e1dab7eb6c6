"""What goes wrong is said, shown where it is, and mended with one click; nothing else stops."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from app.application import watch_faults
from app.canvas.moment import Role
from app.jobs.solver import SpanState
from app.main_window import MainWindow
from core.errors import EditError, MarkError, Where
from core.model import Document, Keyframe, Layer, Outline, RingPoint
from core.model.edits import move_mark, move_nodes, update_document, update_layer
from core.morph.scene import span_of
from tests.app.window.conftest import press

LEFT = Qt.MouseButton.LeftButton
SQUARE = Outline.polygon([(200, 100), (400, 100), (400, 300), (200, 300)])


def a_document(*, crossed: bool = False) -> Document:
    """A square with three marks; ``crossed`` has two of them out of order on the target."""
    places = tuple(RingPoint(0, float(at)) for at in (0, 1, 2))
    swapped = (places[0], places[2], places[1]) if crossed else places
    keys = (Keyframe(1, SQUARE, places), Keyframe(25, SQUARE, swapped))
    return Document((Layer(1, "card", keys, ("a", "b", "c")),))


def mends(window: MainWindow) -> dict[str, QPushButton]:
    """The buttons of the message on show, by their text."""
    buttons = window.messages.findChildren(QPushButton)
    return {button.text(): button for button in buttons if button.isVisible()}


def test_marks_out_of_order_are_named_shown_and_removed_with_one_click(
    window: MainWindow, qtbot: QtBot
) -> None:
    session = window.workspace.session
    session.replace(a_document(crossed=True))
    qtbot.waitUntil(lambda: bool(window.messages.text))
    assert "not solved" in window.status.badge.text()
    (remove,) = (text for text in mends(window) if text.startswith("Delete mark"))
    QTest.mouseClick(mends(window)[remove], LEFT)
    assert len(session.document.layers[0].labels) == 2
    qtbot.waitUntil(lambda: window.workspace.solver.state(1, 0) is SpanState.SOLVED)
    qtbot.waitUntil(lambda: not window.messages.text)
    assert window.actions_["undo"].text().endswith(remove)


def test_of_marks_out_of_order_the_chosen_one_is_offered_to_be_deleted(
    window: MainWindow, qtbot: QtBot
) -> None:
    window.workspace.session.replace(a_document())
    qtbot.waitUntil(lambda: window.workspace.solver.state(1, 0) is SpanState.SOLVED)
    window.workspace.selection.select_mark(0)
    window.workspace.session.apply("Move mark", move_mark, 1, 1, 0, RingPoint(0, 1.5))
    qtbot.waitUntil(lambda: any(text.startswith("Delete mark") for text in mends(window)))
    assert "Delete mark a" in mends(window)


def test_show_place_goes_to_the_keyframe_with_the_tool_that_mends_it(
    window: MainWindow, qtbot: QtBot
) -> None:
    window.workspace.session.replace(a_document(crossed=True))
    qtbot.waitUntil(lambda: "Show place" in mends(window))
    window.workspace.playhead.play()
    QTest.mouseClick(mends(window)["Show place"], LEFT)
    assert window.canvas.tool == "marks"
    assert not window.workspace.playhead.playing


def test_an_outline_that_crosses_itself_keeps_the_last_good_shape_on_screen(
    window: MainWindow, qtbot: QtBot
) -> None:
    workspace = window.workspace
    workspace.session.replace(a_document())
    qtbot.waitUntil(lambda: workspace.solver.state(1, 0) is SpanState.SOLVED)
    good = workspace.solver.morph_of(span_of(workspace.selection.layer, 0))
    workspace.session.apply("Twist", move_nodes, 1, 1, 0, [0], (400, 100))
    qtbot.waitUntil(lambda: workspace.solver.state(1, 0) is SpanState.FAILED)
    qtbot.waitUntil(lambda: bool(window.messages.text))
    assert workspace.solver.morph_of(span_of(workspace.selection.layer, 0)) is good
    press(window, "Ctrl+Z")
    assert workspace.solver.state(1, 0) is SpanState.SOLVED
    qtbot.waitUntil(lambda: not window.messages.text)


def test_a_closed_message_stays_closed_until_something_else_is_wrong(
    window: MainWindow, qtbot: QtBot
) -> None:
    workspace = window.workspace
    workspace.session.replace(a_document(crossed=True))
    qtbot.waitUntil(lambda: bool(window.messages.text))
    window.messages.dismiss()
    workspace.selection.select_mark(0)
    workspace.session.apply("Rename", update_layer, 1, name="fin")
    qtbot.wait(1)
    assert not window.messages.text
    workspace.session.apply("Move", move_nodes, 1, 0, 0, [3], (-10, 0))
    qtbot.waitUntil(lambda: bool(window.messages.text))


SPIKED = Outline.polygon(
    [(200, 100), (400, 100), (400, 300), (300, 300), (300, 350), (300, 300), (200, 300)]
)


def test_a_repair_is_told_once_with_its_place_and_leaves_what_was_drawn(
    window: MainWindow, qtbot: QtBot
) -> None:
    session, ring = window.workspace.session, window.canvas.panes[Role.TARGET].error_ring
    session.replace(Document((Layer(1, "card", (Keyframe(1, SQUARE), Keyframe(25, SPIKED))),)))
    qtbot.waitUntil(lambda: "has a spike without area near (300, 350)" in window.messages.text)
    assert ring.isVisible()
    assert not window.canvas.panes[Role.SOURCE].error_ring.isVisible()
    assert session.document.layers[0].keyframes[1].outline == SPIKED
    session.apply("Move", move_nodes, 1, 1, 0, [0], (-10, 0))
    assert not window.messages.text
    qtbot.waitUntil(lambda: window.workspace.solver.state(1, 0) is SpanState.SOLVED)
    qtbot.wait(1)
    assert not window.messages.text
    session.apply("Open", move_nodes, 1, 1, 0, [5], (-20, 0))
    qtbot.waitUntil(lambda: window.workspace.solver.state(1, 0) is SpanState.SOLVED)
    qtbot.wait(1)
    assert not window.messages.text
    press(window, "Ctrl+Z")
    qtbot.waitUntil(lambda: "spike" in window.messages.text)


def test_show_place_of_a_repair_goes_there_with_the_nodes_tool(
    window: MainWindow, qtbot: QtBot
) -> None:
    keys = Keyframe(1, SPIKED), Keyframe(25, SQUARE)
    window.workspace.session.replace(Document((Layer(1, "card", keys),)))
    qtbot.waitUntil(lambda: "Show place" in mends(window))
    QTest.mouseClick(mends(window)["Show place"], LEFT)
    assert window.canvas.tool == "nodes"
    assert window.workspace.selection.key == 0


def test_a_refused_edit_is_told_and_the_next_one_takes_the_message_away(
    window: MainWindow,
) -> None:
    window.workspace.session.replace(a_document())
    window.workspace.session.failed.emit(EditError("That cannot be.", hint="Try this."))
    assert window.messages.text == "That cannot be. Try this."
    window.workspace.session.apply("Speed", update_document, fps=12.0)
    assert not window.messages.text


def test_a_message_covers_no_control_and_moves_nothing(window: MainWindow) -> None:
    window.workspace.session.replace(a_document())
    before = window.canvas.panes[Role.SOURCE].geometry()
    error = MarkError("Marks are wrong. " * 20, where=Where(marks=(0,)))
    window.workspace.session.failed.emit(error)
    assert window.canvas.panes[Role.SOURCE].geometry() == before
    assert window.canvas.rect().contains(window.messages.geometry())
    window.resize(900, 700)
    assert window.canvas.rect().contains(window.messages.geometry())


def test_an_error_of_another_layer_names_it(window: MainWindow, qtbot: QtBot) -> None:
    wrong = a_document(crossed=True).layers[0]
    still = Layer(2, "still", (Keyframe(1, SQUARE),))
    window.workspace.session.replace(Document((wrong, still)))
    qtbot.waitUntil(lambda: window.messages.text.startswith("Layer “card”: "))


def test_the_place_of_an_error_is_shown_only_where_it_is(window: MainWindow, qtbot: QtBot) -> None:
    """Neither on the outlines of another layer, nor on those of another span."""
    wrong = a_document(crossed=True).layers[0]
    wrong = replace(wrong, keyframes=(*wrong.keyframes, replace(wrong.keyframes[1], frame=49)))
    still = Layer(2, "still", (Keyframe(1, SQUARE),))
    session, selection = window.workspace.session, window.workspace.selection
    session.replace(Document((wrong, still)))
    ring = window.canvas.panes[Role.TARGET].error_ring
    selection.select_layer(1)
    qtbot.waitUntil(ring.isVisible)
    window.workspace.playhead.move_to(30)
    qtbot.waitUntil(lambda: not ring.isVisible())
    window.workspace.playhead.move_to(12)
    qtbot.waitUntil(ring.isVisible)
    selection.select_layer(2)
    qtbot.waitUntil(lambda: not ring.isVisible())
    assert window.messages.text.startswith("Layer “card”: ")


def test_cancel_in_the_status_bar_stops_solving_and_can_be_taken_back(
    window: MainWindow, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    solver = window.workspace.solver
    waiting = [True]

    def slow(span: object, progress: object) -> object:
        while waiting[0]:
            progress(0.25, "Placing")
        return solve(span, progress)

    solve = solver._solve
    monkeypatch.setattr(solver, "_solve", slow)
    window.workspace.session.replace(a_document())
    qtbot.waitUntil(window.status.cancel.isVisible)
    qtbot.waitUntil(lambda: window.status.stage.text() == "Solving: Placing")
    assert "updating" in window.status.badge.text()
    QTest.mouseClick(window.status.cancel, LEFT)
    qtbot.waitUntil(lambda: not solver.busy)
    assert not window.status.cancel.isVisible()
    qtbot.waitUntil(lambda: "out of date" in window.status.badge.text())
    waiting[0] = False
    QTest.mouseClick(mends(window)["Solve again"], LEFT)
    qtbot.waitUntil(lambda: "sound" in window.status.badge.text())
    assert not window.messages.text


def test_a_fault_of_the_program_is_told_without_a_traceback(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "excepthook", sys.excepthook)
    watch_faults(window.reporter.show_fault)
    fault = ZeroDivisionError("by nothing")
    sys.excepthook(type(fault), fault, None)
    assert "ZeroDivisionError: by nothing" in window.messages.text
    assert "Traceback" not in window.messages.text


def test_the_status_bar_says_what_the_next_click_does(window: MainWindow) -> None:
    hints = set()
    for keys in "VNPBM":
        press(window, keys)
        hints.add(window.status.hint.text())
    assert len(hints) == 5
    assert all(hints)


def mirrored_flags(count: int) -> Document:
    """A flag whose every key is the mirror image of the one before."""
    flag = [(100, 50), (140, 50), (300, 80), (300, 180), (140, 160), (140, 400), (100, 400)]
    mirrored = [(700 - x, y) for x, y in reversed(flag)]
    outlines = (Outline.polygon((flag, mirrored)[k % 2]) for k in range(count))
    return Document(
        (Layer(1, "flag", tuple(Keyframe(1 + 24 * k, o) for k, o in enumerate(outlines))),)
    )


def test_a_target_that_matches_far_better_mirrored_is_offered_once_and_mirrored_with_one_click(
    window: MainWindow, qtbot: QtBot
) -> None:
    session = window.workspace.session
    session.replace(mirrored_flags(2))
    before = session.document
    qtbot.waitUntil(lambda: "Mirror target" in mends(window))
    QTest.mouseClick(mends(window)["Mirror target"], LEFT)
    target = session.document.layers[0].keyframes[1].outline
    assert target.bounds() == before.layers[0].keyframes[1].outline.bounds()
    qtbot.waitUntil(lambda: window.workspace.solver.state(1, 0) is SpanState.SOLVED)
    morph = window.workspace.solver.solutions()[span_of(session.document.layers[0], 0)]
    assert morph.report.distortion_mean < 1.01
    assert not window.messages.text
    session.undo()
    assert session.document is before


def test_each_mirrored_target_is_offered_once_wherever_the_playhead_goes(
    window: MainWindow, qtbot: QtBot
) -> None:
    workspace = window.workspace
    workspace.session.replace(mirrored_flags(3))
    qtbot.waitUntil(lambda: "Mirror target" in mends(window))
    window.messages.dismiss()
    workspace.playhead.move_to(30)
    qtbot.waitUntil(lambda: "Mirror target" in mends(window))
    window.messages.dismiss()
    for frame in (5, 30):
        workspace.playhead.move_to(frame)
        qtbot.wait(1)
        assert not window.messages.text


def test_a_note_gives_way_to_what_cannot_be_solved_and_a_refusal_stays_until_it_is_closed(
    window: MainWindow, qtbot: QtBot
) -> None:
    window.workspace.session.replace(a_document(crossed=True))
    qtbot.waitUntil(lambda: bool(window.workspace.solver.errors))
    for show, stays in (
        (window.reporter.note, False),
        (lambda text: window.reporter.show_refusal(EditError(text)), True),
    ):
        show("Something happened.")
        window.workspace.selection.select_mark(None)
        window.workspace.selection.select_mark(0)
        qtbot.wait(1)
        assert ("Something happened." in window.messages.text) == stays
        if stays:
            window.messages.dismiss()
        qtbot.waitUntil(lambda: any(text.startswith("Delete mark") for text in mends(window)))


@pytest.mark.parametrize("by", ["mouse", "keys"])
def test_the_keys_stay_with_the_canvas_when_a_message_goes(window: MainWindow, by: str) -> None:
    window.messages.show_info("Something happened.", ("Do it", window.messages.clear))
    button = mends(window)["Do it"]
    if by == "mouse":
        QTest.mouseClick(button, LEFT)
    else:
        button.setFocus(Qt.FocusReason.TabFocusReason)
        QTest.keyClick(button, Qt.Key.Key_Space)
    assert not window.messages.text
    assert window.canvas.isAncestorOf(QApplication.focusWidget())
