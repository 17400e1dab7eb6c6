"""The table of actions: what artists expect is there, once, and says when it can be done."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
import shapely
from PySide6.QtCore import Qt
from PySide6.QtGui import QContextMenuEvent, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QMenu,
    QWidget,
)
from pytestqt.qtbot import QtBot

import resources
from app.actions import ENTRIES
from app.canvas.moment import Role
from app.icons import pixmap
from app.main_window import MainWindow
from app.menus import MENUS, TOP_BAR, Items
from app.style import DARK
from app.workspace import ViewOptions
from core.geometry.flatten import flatten
from core.model import Document, Keyframe, Layer, Outline, RingPoint
from core.model.edits import move_nodes
from core.morph.scene import layer_rings
from tests.app.canvas.conftest import LEFT, Hand
from tests.app.window.conftest import press

SQUARE = Outline.polygon([(100, 100), (300, 100), (300, 300), (100, 300)])
CONVENTIONS = {
    "new": "Ctrl+N",
    "open": "Ctrl+O",
    "save": "Ctrl+S",
    "save-as": "Ctrl+Shift+S",
    "import": "Ctrl+I",
    "export": "Ctrl+E",
    "undo": "Ctrl+Z",
    "redo": "Ctrl+Shift+Z Ctrl+Y",
    "delete": "Del",
    "tool-select": "V F1",
    "tool-nodes": "N F2",
    "tool-pen": "P F3",
    "tool-freehand": "B F4",
    "tool-marks": "M F5",
    "fit": "Ctrl+0",
    "zoom-100": "Ctrl+1",
    "flip": "Shift+H",
    "onion": "O",
    "insert-key": "F6 K",
    "draw-key": "F7",
    "play": "Space Return Enter",
    "play-from-start": "Shift+Space",
    "stop": "Esc",
    "next-frame": "Right .",
    "previous-frame": "Left ,",
    "next-key": "Ctrl+Right Alt+.",
    "previous-key": "Ctrl+Left Alt+,",
    "first": "Home",
    "last": "End",
}


def a_document() -> Document:
    """Two layers; the upper one moves from frame 1 to 25 and has a mark."""
    places = (RingPoint(0, 0.0),)
    keys = (Keyframe(1, SQUARE, places), Keyframe(25, SQUARE.transformed([[2, 0], [0, 1]]), places))
    return Document((Layer(1, "still", (Keyframe(1, SQUARE),)), Layer(2, "card", keys, ("a",))))


@pytest.fixture
def window(window: MainWindow) -> MainWindow:
    window.workspace.session.replace(a_document())
    return window


def all_ids(items: Items) -> list[str]:
    ids = []
    for item in items:
        ids += all_ids(item[1]) if isinstance(item, tuple) else [item]
    return [item for item in ids if item != "-"]


def test_every_shortcut_that_artists_expect_is_there() -> None:
    keys = {entry.id: " ".join(entry.keys) for entry in ENTRIES}
    assert {entry: keys[entry] for entry in CONVENTIONS} == CONVENTIONS


def test_no_two_actions_share_an_id_or_a_key() -> None:
    ids = Counter(entry.id for entry in ENTRIES)
    keys = Counter(QKeySequence(key).toString() for entry in ENTRIES for key in entry.keys)
    assert max(ids.values()) == max(keys.values()) == 1


def test_every_action_is_in_a_menu_and_every_menu_item_is_an_action() -> None:
    in_menus = set(all_ids(tuple(MENUS)))
    ids = {entry.id for entry in ENTRIES}
    assert in_menus == ids
    assert set(all_ids(TOP_BAR)) <= ids


def test_every_icon_that_is_named_can_be_drawn(qapp: QApplication) -> None:
    for entry in ENTRIES:
        if entry.icon:
            image = pixmap(entry.icon, 32, "#000000").toImage()
            assert any(image.pixelColor(x, y).alpha() for x in range(32) for y in range(32))


def test_menu_mnemonics_are_unique_within_each_menu() -> None:
    texts = {entry.id: entry.text for entry in ENTRIES}

    def check(items: Items) -> None:
        titles = [item[0] if isinstance(item, tuple) else texts.get(item, "") for item in items]
        letters = [text[text.index("&") + 1].lower() for text in titles if "&" in text]
        assert len(letters) == len(set(letters)), titles
        for item in items:
            if isinstance(item, tuple):
                check(item[1])

    check(tuple(MENUS))


def test_the_edit_menu_names_the_steps(window: MainWindow) -> None:
    press(window, "Ctrl+D")
    assert window.actions_["undo"].text() == "&Undo Duplicate layer"
    press(window, "Ctrl+Z")
    assert window.actions_["redo"].text() == "&Redo Duplicate layer"
    assert not window.actions_["undo"].isEnabled()


@pytest.mark.parametrize(
    ("keys", "tool"), [("N", "nodes"), ("F3", "pen"), ("B", "freehand"), ("M", "marks")]
)
def test_keys_take_tools_and_escape_puts_them_away(
    window: MainWindow, keys: str, tool: str
) -> None:
    press(window, keys)
    assert window.canvas.tool == tool
    assert window.actions_[f"tool-{tool}"].isChecked()
    press(window, "Esc")
    assert window.canvas.tool == "select"
    assert window.actions_["tool-select"].isChecked()


def test_keys_move_the_playhead(window: MainWindow) -> None:
    frames = []
    for keys in ("Right", ".", "Left", "Alt+.", "Ctrl+Left", "End", "Home", ","):
        press(window, keys)
        frames.append(window.workspace.playhead.frame)
    assert frames == [2, 3, 2, 25, 1, 25, 1, 1]


def test_space_plays_with_the_focus_on_the_canvas_or_elsewhere(window: MainWindow) -> None:
    for part in (window.canvas, window.timeline):
        part.setFocus()
        press(window, "Space")
        assert window.workspace.playhead.playing
        press(window, "Esc")
        assert not window.workspace.playhead.playing


def test_space_presses_a_button_that_has_the_focus(window: MainWindow) -> None:
    window.beginning.toggle_welcome()
    box = window.welcome.at_start
    box.setFocus(Qt.FocusReason.TabFocusReason)
    press(window, "Space")
    assert not box.isChecked()
    assert not window.workspace.playhead.playing


def test_letters_typed_into_a_field_take_no_tool(window: MainWindow) -> None:
    field = next(f for f in window.properties.findChildren(QLineEdit) if f.isVisible())
    field.setFocus()
    QTest.keyClicks(field, "p")
    assert window.canvas.tool == "select"


def test_insert_keyframe_makes_the_in_between_on_screen_a_key(
    window: MainWindow, qtbot: object
) -> None:
    qtbot.waitUntil(lambda: not window.workspace.solver.busy)
    window.workspace.playhead.move_to(13)
    before = window.workspace.session.document
    layer = window.workspace.selection.layer
    shown = layer_rings(before, layer, 13, window.workspace.solver.morph_of)
    press(window, "K")
    layer = window.workspace.selection.layer
    assert [key.frame for key in layer.keyframes] == [1, 13, 25]
    assert window.workspace.selection.key == 1
    [drawn] = (line.points for line in flatten(layer.keyframes[1].outline))
    apart = shapely.hausdorff_distance(*shapely.linearrings([drawn]), *shapely.linearrings(shown))
    assert apart < 0.2
    assert not window.actions_["insert-key"].isEnabled()
    press(window, "Shift+Del")
    assert window.workspace.session.document == before


def test_a_stale_in_between_is_never_made_a_key(window: MainWindow, qtbot: QtBot) -> None:
    session, solver = window.workspace.session, window.workspace.solver
    insert, layer_id = window.actions_["insert-key"], window.workspace.selection.layer.id
    qtbot.waitUntil(lambda: not solver.busy)
    window.workspace.playhead.move_to(13)
    session.apply("Move", move_nodes, layer_id, 1, 0, [0], (-40, -40))
    before = session.document
    insert.trigger()
    assert session.document is before
    assert "still being solved" in window.messages.text
    qtbot.waitUntil(lambda: not solver.busy)
    insert.trigger()
    assert session.document is not before
    session.undo()
    session.apply("Twist", move_nodes, layer_id, 1, 0, [0], (600, 50))
    twisted = session.document
    qtbot.waitUntil(lambda: not solver.busy)
    insert.trigger()
    assert session.document is twisted
    assert "not solved" in window.messages.text


def test_suggested_marks_are_shown_and_then_placed_on_every_key_in_one_step(
    window: MainWindow, qtbot: QtBot
) -> None:
    session, playhead = window.workspace.session, window.workspace.playhead
    arm = [(100, 250), (300, 250), (500, 250), (500, 290), (300, 290), (100, 290)]
    bent = [(100, 250), (300, 250), (300, 50), (340, 50), (340, 290), (100, 290)]
    keys = (Keyframe(1, Outline.polygon(arm)), Keyframe(25, Outline.polygon(bent)))
    session.replace(Document((Layer(1, "arm", (*keys, replace(keys[0], frame=49))),)))
    bare = session.document
    playhead.move_to(10)
    suggestions = window.workspace.suggestions
    press(window, "Ctrl+Shift+M")
    qtbot.waitUntil(lambda: suggestions.current)
    assert session.document is bare
    assert window.actions_["suggest-marks"].text() == "&Accept all suggested marks"
    press(window, "Ctrl+Shift+M")
    (layer,) = session.document.layers
    count = len(layer.labels)
    assert count >= 3
    assert all(len(key.marks) == count for key in layer.keyframes)
    first, _, last = ([mark.at for mark in key.marks] for key in layer.keyframes)
    np.testing.assert_allclose(first, last, atol=0.1)  # the third key is the first again
    qtbot.waitUntil(lambda: suggestions.current)
    press(window, "Ctrl+Shift+M")
    assert len(session.document.layers[0].labels) == count
    assert "no more" in window.messages.text
    press(window, "Ctrl+Z")
    assert session.document is bare
    session.replace(Document((Layer(1, "arm", keys[:1]),)))
    assert not window.actions_["suggest-marks"].isEnabled()


def test_delete_removes_what_is_selected(window: MainWindow) -> None:
    selection = window.workspace.selection
    press(window, "Ctrl+A")
    assert len(selection.nodes) == 4
    selection.select_nodes(frozenset({(0, 2)}))
    window.actions_["delete"].trigger()
    assert len(selection.keyframe.outline.rings[0]) == 3
    selection.select_mark(0)
    window.actions_["delete"].trigger()
    assert selection.layer.labels == ()
    window.workspace.playhead.move_to(25)
    window.actions_["delete"].trigger()
    assert [key.frame for key in selection.layer.keyframes] == [1]


def test_layers_can_be_duplicated_reordered_hidden_and_deleted_by_keys(window: MainWindow) -> None:
    names = lambda: [layer.name for layer in window.workspace.session.document.layers]  # noqa: E731
    press(window, "Ctrl+D")
    assert names() == ["still", "card", "card copy"]
    assert window.workspace.selection.layer.name == "card copy"
    press(window, "Ctrl+[")
    assert names() == ["still", "card copy", "card"]
    press(window, "PgDown")
    assert window.workspace.selection.layer.name == "still"
    window.actions_["layer-visible"].trigger()
    assert not window.workspace.selection.layer.visible
    assert not window.actions_["layer-visible"].isChecked()
    window.actions_["remove-layer"].trigger()
    assert names() == ["card copy", "card"]


def test_a_locked_layer_is_not_edited_and_the_message_says_so(window: MainWindow) -> None:
    window.actions_["layer-locked"].trigger()
    before = window.workspace.session.document
    window.workspace.playhead.move_to(13)
    for action in ("insert-key", "remove-key", "remove-marks", "easing-hold"):
        window.actions_[action].trigger()
        assert window.workspace.session.document is before
        assert "locked" in window.messages.text


def test_easing_is_set_for_the_span_under_the_playhead_and_shown_in_the_menu(
    window: MainWindow,
) -> None:
    window.actions_["easing-ease in"].trigger()
    assert window.workspace.selection.layer.keyframes[0].easing.x1 == 0.42
    assert window.actions_["easing-ease in"].isChecked()
    press(window, "Ctrl+Z")
    assert window.actions_["easing-linear"].isChecked()


def test_view_options_switch_and_are_remembered(window: MainWindow, open_window: object) -> None:
    press(window, "Shift+M")
    press(window, "Ctrl+3")
    assert window.workspace.view.mesh
    window.close()
    again = open_window()
    assert again.workspace.view.mesh
    assert again.workspace.view.layout == "overlay"
    assert again.actions_["mesh"].isChecked()


def test_deleting_the_only_key_of_a_layer_says_what_to_delete_instead(window: MainWindow) -> None:
    session = window.workspace.session
    session.replace(Document((Layer(1, "arm", (Keyframe(1, SQUARE),)),)))
    before = session.document
    press(window, "Del")
    assert session.document is before
    assert "Delete the layer instead" in window.messages.text


def test_the_onion_skin_is_remembered_and_damage_to_that_is_mended(
    window: MainWindow, open_window: object
) -> None:
    window.workspace.view.update(onion_before=3, tint_after="#123456")
    window.close()
    again = open_window()
    assert (again.workspace.view.onion_before, again.workspace.view.tint_after) == (3, "#123456")
    for name, value in (("onion_before", "12"), ("onion_after", "x"), ("tint_after", "red")):
        again.settings._store.setValue(f"view/{name}", value)
    again.settings.load_view(fresh := ViewOptions())
    assert (fresh.onion_before, fresh.onion_after, fresh.tint_after) == (1, 1, DARK.target)


def test_draw_keyframe_here_makes_what_is_drawn_a_key_under_the_playhead(
    window: MainWindow,
) -> None:
    window.workspace.playhead.move_to(13)
    press(window, "F7")
    assert window.canvas.tool == "pen"
    assert window.workspace.view.layout == "overlay"


@pytest.mark.parametrize("welcome", [False, True])
def test_every_control_has_a_name_a_tip_and_is_large_enough_to_hit(
    window: MainWindow, welcome: bool
) -> None:
    window.workspace.session.replace(a_document())
    if welcome:
        window.beginning.toggle_welcome()
    QApplication.processEvents()
    kinds = (QAbstractButton, QAbstractSpinBox, QComboBox)
    controls = [c for c in window.findChildren(QWidget) if isinstance(c, kinds) and c.isVisible()]
    assert len(controls) > 40
    for control in controls:
        text = control.text() if isinstance(control, QAbstractButton) else ""
        assert control.accessibleName() or text, control
        assert control.toolTip() or text, control.accessibleName()
        assert min(control.width(), control.height()) >= 24, control.accessibleName() or text


def test_a_panel_floats_and_closes_and_comes_back_by_its_title_and_the_menu(
    window: MainWindow,
) -> None:
    dock = window.panels.docks["layers"]
    title = dock.titleBarWidget()
    for floats in (True, False):
        QTest.mouseClick(title.float, LEFT)
        assert dock.isFloating() == floats
    QTest.mouseClick(title.close_, LEFT)
    assert dock.isHidden()
    dock.toggleViewAction().trigger()
    assert dock.isVisible()


def test_a_right_click_on_the_canvas_offers_what_can_be_done_there(
    window: MainWindow, hand: Hand
) -> None:
    window.workspace.session.replace(a_document())
    viewport = hand.pane(Role.TARGET).view.viewport()

    def ask() -> QMenu | None:
        at = hand.pixel(Role.TARGET, (200, 200))
        QTest.mouseClick(viewport, Qt.MouseButton.RightButton, pos=at)
        there = viewport.mapToGlobal(at)
        reason = QContextMenuEvent.Reason.Mouse
        QApplication.sendEvent(viewport, QContextMenuEvent(reason, at, there))
        return QApplication.activePopupWidget()

    menu = ask()
    offered = {action.objectName() for action in menu.actions() if action.isEnabled()}
    assert {"copy", "paste", "delete", "fit"} <= offered
    menu.close()
    assert window.workspace.selection.key == 1  # that of the pane that was clicked
    window.canvas.set_tool("pen")
    hand.click(Role.TARGET, (100, 100))
    assert ask() is None  # a drawing is under way


def test_samples_come_with_the_program() -> None:
    assert resources.samples()
