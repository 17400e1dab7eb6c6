"""A propeller on an aeroplane, by mouse and keys: it is carried along, and turns where it hangs."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.canvas.moment import Role, moment_of
from app.fields.choice import Choice
from app.main_window import MainWindow
from app.panels.layer_table import NAME
from core.model import Document, Keyframe, Layer, Outline, RingPoint, Style
from core.model.edits import replace_outline
from core.morph.scene import picture_at
from tests.app.canvas.conftest import Hand
from tests.app.window.conftest import press
from tests.core.shapes import rotation

BODY = np.array([[-200, -30], [100, -40], [160, 0], [100, 40], [-200, 30], [-240, 90]], dtype=float)
BLADES = np.array([[-6, -80], [6, -80], [14, 0], [6, 80], [-6, 80], [-14, 0]], dtype=float)
NOSE = np.array([160.0, 0.0])
POSES = {1: (0.0, (300.0, 380.0)), 25: (-0.6, (640.0, 200.0))}


def flown(points: np.ndarray, frame: int) -> Outline:
    angle, place = POSES[frame]
    return Outline.polygon(points @ rotation(angle).T + place)


def aeroplane() -> Document:
    marks = tuple(RingPoint(0, float(i)) for i in range(len(BODY)))
    keys = tuple(Keyframe(frame, flown(BODY, frame), marks) for frame in POSES)
    body = Layer(1, "body", keys, tuple("abcdef"), Style(fill="#4a7fb5"))
    propeller = Layer(
        2, "propeller", (Keyframe(1, flown(BLADES + NOSE, 1)),), style=Style(fill="#303030")
    )
    return Document((body, propeller))


def pick(box: Choice, text: str) -> None:
    """Choose an option further down by keys."""
    box.setFocus()
    for _ in range(box.findText(text) - box.currentIndex()):
        QTest.keyClick(box, Qt.Key.Key_Down)
    QApplication.processEvents()


@pytest.fixture
def flying(window: MainWindow, qtbot: QtBot) -> MainWindow:
    window.workspace.session.replace(aeroplane())
    window.workspace.selection.select_layer(2)
    qtbot.waitUntil(lambda: not window.workspace.solver.busy)
    return window


def seen(window: MainWindow, frame: int) -> np.ndarray:
    """Return the middle of the propeller at a frame."""
    space = window.workspace
    picture = picture_at(space.session.document, frame, space.solver.morph_of)
    [ring] = next(shape for shape in picture.shapes if shape.name == "propeller").rings
    return (ring.min(axis=0) + ring.max(axis=0)) / 2


def nose(frame: int) -> np.ndarray:
    angle, place = POSES[frame]
    return rotation(angle) @ NOSE + place


def test_a_propeller_hung_on_a_body_is_carried_and_a_key_made_there_turns_as_often_as_told(
    flying: MainWindow, qtbot: QtBot
) -> None:
    window, space, panel = flying, flying.workspace, flying.properties
    before = space.session.document
    assert seen(window, 25) == pytest.approx(nose(1), abs=1)
    pick(panel.layer.carrier, "body")
    assert space.session.document.layer(2).carrier == 1
    assert space.session.undo_stack.undoText() == "Hang layer"
    assert seen(window, 25) == pytest.approx(nose(25), abs=1e-6)

    space.playhead.move_to(25)
    window.canvas.setFocus()
    press(window, "K")
    assert [key.frame for key in space.session.document.layer(2).keyframes] == [1, 25]
    qtbot.waitUntil(lambda: panel.span.angle.text() == "no turn")  # as seen from the body
    pick(panel.span.direction, "Clockwise")
    panel.span.turns.setFocus()
    panel.span.turns.selectAll()
    QTest.keyClicks(panel.span.turns, "2")
    QTest.keyClick(panel.span.turns, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: panel.span.angle.text() == "720° clockwise")
    assert not panel.span.path.isEnabled()
    pick(panel.span.about, "Where it hangs")
    assert space.session.document.layer(2).keyframes[0].turning.about == "joint"

    space.playhead.move_to(9)
    qtbot.waitUntil(lambda: moment_of(space).positions is not None)
    shown = moment_of(space).positions  # what mesh and marks are drawn with
    ring = picture_at(space.session.document, 9, space.solver.morph_of).shapes[1].rings[0]
    assert shown[: len(ring)] == pytest.approx(ring)
    while space.session.document != before:
        press(window, "Ctrl+Z")
    assert seen(window, 25) == pytest.approx(nose(1), abs=1)


def test_what_hangs_on_a_layer_that_is_not_solved_is_shown_as_stale(
    flying: MainWindow, qtbot: QtBot
) -> None:
    space = flying.workspace
    pick(flying.properties.layer.carrier, "body")
    space.playhead.move_to(13)
    qtbot.waitUntil(lambda: not moment_of(space).stale)
    bow = Outline.polygon([(0, 0), (90, 90), (90, 0), (0, 91)])
    marks = [RingPoint(0, 0.0)] * len(BODY)
    space.session.apply("Cross it", replace_outline, 1, 1, bow, marks)
    assert moment_of(space).stale == {1, 2}


def test_a_hidden_body_still_carries(flying: MainWindow, qtbot: QtBot) -> None:
    space = flying.workspace
    pick(flying.properties.layer.carrier, "body")
    space.selection.select_layer(1)
    assert not flying.properties.span.about.isEnabled()  # it hangs on nothing
    flying.canvas.setFocus()
    table = flying.layers.table
    flying.layers.list.clicked.emit(table.index(table.row_of(1), 0))
    assert not space.session.document.layer(1).visible
    qtbot.waitUntil(lambda: not space.solver.busy)
    assert seen(flying, 25) == pytest.approx(nose(25), abs=1e-6)
    assert np.hypot(*(seen(flying, 13) - nose(1))) > 50


def test_a_layer_is_offered_no_carrier_that_hangs_on_it(flying: MainWindow) -> None:
    carrier = flying.properties.layer.carrier
    assert [carrier.itemText(i) for i in range(carrier.count())] == ["Nothing", "body"]
    pick(carrier, "body")
    flying.workspace.selection.select_layer(1)
    assert [carrier.itemText(i) for i in range(carrier.count())] == ["Nothing"]
    assert not carrier.isEnabled()


def test_a_body_that_is_dragged_takes_the_propeller_along(flying: MainWindow, hand: Hand) -> None:
    pick(flying.properties.layer.carrier, "body")
    flying.workspace.selection.select_layer(1)
    press(flying, "V")
    before = flying.workspace.session.document
    start = np.array([250.0, 380.0])
    hand.drag(Role.SOURCE, start, start + np.array([40, -60]))
    after = flying.workspace.session.document
    gone = after.layer(1).keyframes[0].outline.rings[0].points - flown(BODY, 1).rings[0].points
    assert np.abs(gone).max() > 20
    for layer in (1, 2):
        drawn = before.layer(layer).keyframes[0].outline
        assert after.layer(layer).keyframes[0].outline == drawn.transformed(np.eye(2), gone[0])
    flying.workspace.session.undo()
    assert flying.workspace.session.document is before


def test_the_layers_say_what_they_hang_on(flying: MainWindow) -> None:
    table = flying.layers.table
    pick(flying.properties.layer.carrier, "body")
    assert table.index(0, NAME).data() == "propeller · on body"
    assert table.index(0, NAME).data(Qt.ItemDataRole.EditRole) == "propeller"
