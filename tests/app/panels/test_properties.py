"""The properties panel shows what is chosen, and every edit in it is one undo step."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import get_args

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QApplication,
    QColorDialog,
    QComboBox,
    QLabel,
    QLineEdit,
    QToolButton,
    QWidget,
)
from pytestqt.qtbot import QtBot

from app.fields.colour import Swatch
from app.jobs.solver import SpanState
from app.panels.properties import WIDTH, PropertiesPanel
from app.workspace import Workspace
from core.model import Document, Easing, Turning
from core.model.easing import EASE_IN, HOLD, PRESETS
from core.model.edits import move_nodes, remove_layer, update_document, update_layer
from core.model.recipe import LEAST_DENSITY, MOST_DENSITY, Method, Recipe
from tests.app.eye import Eye
from tests.app.panels.conftest import a_layer, solve

Key = Qt.Key
LEFT = Qt.MouseButton.LeftButton
SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def panel(workspace: Workspace, qtbot: QtBot) -> PropertiesPanel:
    workspace.selection.select_key(1, 1)
    workspace.playhead.move_to(13)
    panel = PropertiesPanel(workspace)
    qtbot.addWidget(panel)
    panel.resize(WIDTH, 1300)
    panel.show()
    qtbot.waitExposed(panel)
    panel.activateWindow()
    panel.setFocus()
    return panel


def type_in(field: QWidget, text: str) -> None:
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)


def choose(box: QComboBox, text: str) -> None:
    """Choose an option as a person does: open, arrow, Return."""
    index = box.findText(text)
    box.setCurrentIndex(index)
    box.activated.emit(index)


def layer(workspace: Workspace) -> object:
    return workspace.session.document.layer(1)


def test_looking_at_everything_edits_nothing(
    panel: PropertiesPanel, workspace: Workspace, qtbot: QtBot
) -> None:
    before = workspace.session.document
    for layer_id, key in ((1, 0), (1, 2), (2, 1), (3, 0), (1, 1)):
        workspace.selection.select_key(layer_id, key)
        for frame in (1, 9, 13, 25, 40):
            workspace.playhead.move_to(frame)
    for field in panel.findChildren(QWidget):
        if field.isEnabled() and field.focusPolicy() != Qt.FocusPolicy.NoFocus:
            field.setFocus()
    panel.setFocus()
    assert workspace.session.document is before
    assert workspace.session.undo_stack.count() == 0


EDITS: dict[str, Callable[[PropertiesPanel], None]] = {
    "stroke width": lambda p: type_in(p.layer.stroke_width, "12.5"),
    "frame": lambda p: type_in(p.keyframe.frame, "20"),
    "easing": lambda p: choose(p.span.preset, "Hold"),
    "passing": lambda p: choose(p.keyframe.passes, "Passes through"),
    "turn": lambda p: choose(p.span.direction, "Counter-clockwise"),
    "extra turns": lambda p: type_in(p.span.turns, "2"),
    "path": lambda p: choose(p.span.path, "Straight"),
    "method": lambda p: choose(p.mapping.method, "Straight paths"),
    "density": lambda p: type_in(p.mapping.density, "256"),
    "material": lambda p: choose(p.mapping.material, "St. Venant–Kirchhoff"),
    "width": lambda p: type_in(p.document.width_, "1920"),
    "height": lambda p: type_in(p.document.height_, "1080"),
    "frame rate": lambda p: choose(p.document.frame_rate, "30"),
    "hold": lambda p: choose(p.document.hold, "On twos"),
}


@pytest.mark.parametrize("name", EDITS)
def test_an_edit_is_one_step_and_undo_restores_the_identical_document(
    name: str, panel: PropertiesPanel, workspace: Workspace
) -> None:
    before = workspace.session.document
    EDITS[name](panel)
    after = workspace.session.document
    assert after != before
    assert workspace.session.undo_stack.count() == 1
    workspace.session.undo()
    assert workspace.session.document is before
    workspace.session.redo()
    assert workspace.session.document is after


def test_the_fields_set_what_they_name(panel: PropertiesPanel, workspace: Workspace) -> None:
    for edit in EDITS.values():
        edit(panel)
    type_in(panel.mapping.mu, "2.5")
    type_in(panel.mapping.lam, "0.25")
    changed, document = layer(workspace), workspace.session.document
    assert changed.style.stroke_width == 12.5
    assert changed.keyframes[1].frame == 20
    assert changed.keyframes[0].easing == HOLD  # the playhead, at 13, is now in the first span
    assert changed.keyframes[1].passes
    assert changed.keyframes[0].turning == Turning("counter-clockwise", 2, "straight")
    recipe = changed.recipe
    assert (recipe.method, recipe.density) == ("linear", 256)
    assert (recipe.material, recipe.mu, recipe.lam) == ("st-venant-kirchhoff", 2.5, 0.25)
    assert (document.size, document.fps, document.hold) == ((1920, 1080), 30, 2)
    assert document.layer(2) == a_layer(2, 1, 9)


def test_the_span_says_how_far_it_turns_as_soon_as_it_is_solved(
    panel: PropertiesPanel, workspace: Workspace, qtbot: QtBot
) -> None:
    assert panel.span.angle.text() == "–"  # the span at 13 cannot be solved
    workspace.playhead.move_to(5)
    qtbot.waitUntil(lambda: panel.span.angle.text() == "29° clockwise")
    choose(panel.span.direction, "Counter-clockwise")
    assert panel.span.angle.text() == "–"
    qtbot.waitUntil(lambda: panel.span.angle.text() == "331° counter-clockwise")
    type_in(panel.span.turns, "1")
    qtbot.waitUntil(lambda: panel.span.angle.text() == "691° counter-clockwise")
    choose(panel.mapping.method, "Straight paths")
    assert not any(field.isEnabled() for field in (panel.span.direction, panel.span.turns))


def test_only_a_key_with_motion_on_both_sides_can_be_passed(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    for key, passable in ((0, False), (1, True), (2, False)):
        workspace.selection.select_key(1, key)
        assert panel.keyframe.passes.isEnabled() == passable
    workspace.selection.select_key(1, 1)
    choose(panel.span.preset, "Hold")
    assert not panel.keyframe.passes.isEnabled()


def test_the_curve_shows_that_easing_is_even_at_a_key_that_is_passed(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    workspace.playhead.move_to(5)
    choose(panel.keyframe.passes, "Passes through")
    assert panel.span.curve.accessibleDescription().endswith("0.67, 0.67")
    assert panel.span.preset.currentText() == "Ease in"


def test_turning_belongs_to_the_span_under_the_playhead(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    choose(panel.span.direction, "Clockwise")
    workspace.playhead.move_to(5)
    assert panel.span.direction.currentText() == "Shorter way"
    workspace.playhead.move_to(14)
    assert panel.span.direction.currentText() == "Clockwise"
    assert [key.turning.direction for key in layer(workspace).keyframes] == [
        "automatic",
        "clockwise",
        "automatic",
    ]


@pytest.mark.parametrize("density", [LEAST_DENSITY, 5000, MOST_DENSITY])
@pytest.mark.parametrize("method", get_args(Method))
def test_every_recipe_is_shown_as_it_is(
    panel: PropertiesPanel, workspace: Workspace, density: int, method: Method
) -> None:
    recipe = Recipe(method, density)
    workspace.session.apply("Import", update_layer, 1, recipe=recipe)
    assert panel.mapping.density.value() == density
    assert panel.mapping.method.currentText()
    choose(panel.mapping.method, panel.mapping.method.currentText())
    assert layer(workspace).recipe == recipe


def test_every_method_says_what_it_is_for(panel: PropertiesPanel) -> None:
    box = panel.mapping.method
    assert box.count() == len(get_args(Method))
    for i in range(box.count()):
        purpose = box.itemData(i, Qt.ItemDataRole.ToolTipRole)
        assert f"{box.itemText(i)}: {purpose}" in box.toolTip()


def test_numbers_that_a_file_holds_are_shown_as_they_are(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    style = replace(layer(workspace).style, stroke_width=750.0)
    recipe = Recipe(material="st-venant-kirchhoff", mu=20_000.0)
    workspace.session.apply("Import", update_layer, 1, style=style, recipe=recipe)
    workspace.session.apply("Import", update_document, size=(12_000.0, 200.25))
    opened = workspace.session.document
    fields = panel.layer.stroke_width, panel.mapping.mu, panel.document.width_
    assert [field.value() for field in fields] == [750, 20_000, 12_000]
    assert panel.document.height_.value() == 200.25
    for field in fields:
        field.setFocus()
    panel.setFocus()
    assert workspace.session.document is opened
    workspace.selection.select_layer(2)
    type_in(panel.layer.stroke_width, "750")
    assert workspace.session.document.layer(2).style.stroke_width <= 500


def test_the_fields_follow_undo_and_the_selection(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    type_in(panel.layer.stroke_width, "12.5")
    panel.setFocus()
    workspace.session.undo()
    assert panel.layer.stroke_width.value() == 1.25
    workspace.selection.select_key(2, 1)
    assert panel.keyframe.frame.value() == 9
    workspace.selection.select_layer(3)
    assert not panel.span.isVisible()
    assert not panel.result.isVisible()
    workspace.session.apply("Delete", remove_layer, 3)
    assert panel.span.isVisible()


def test_steps_in_one_visit_merge_and_another_visit_is_another_step(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    field = panel.mapping.density
    field.setFocus()
    for _ in range(4):
        QTest.keyClick(field, Key.Key_Up)
    panel.setFocus()
    field.setFocus()
    QTest.keyClick(field, Key.Key_Up)
    assert layer(workspace).recipe.density == 128 + 5 * 16
    assert workspace.session.undo_stack.count() == 2


def test_the_same_field_for_another_layer_is_another_step(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    type_in(panel.layer.stroke_width, "5")
    workspace.selection.select_layer(2)
    panel.layer.stroke_width.selectAll()
    QTest.keyClicks(panel.layer.stroke_width, "7")
    assert layer(workspace).style.stroke_width == 5
    assert workspace.session.document.layer(2).style.stroke_width == 7
    assert workspace.session.undo_stack.count() == 2


def test_the_wheel_over_a_field_without_focus_changes_nothing(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    before = workspace.session.document
    fields = [w for w in panel.findChildren(QWidget) if isinstance(w, QAbstractSpinBox | QComboBox)]
    assert len(fields) >= 10
    for field in fields:
        place = QPointF(5, 5)
        event = QWheelEvent(
            place,
            field.mapToGlobal(place),
            QPoint(),
            QPoint(0, -120),
            Qt.MouseButton.NoButton,
            Qt.KeyboardModifier.NoModifier,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(field, event)
    assert workspace.session.document is before


def test_a_keyframe_can_be_typed_only_between_its_neighbours(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    field = panel.keyframe.frame
    assert (field.minimum(), field.maximum()) == (2, 24)
    type_in(field, "99")
    panel.setFocus()
    frames = [key.frame for key in layer(workspace).keyframes]
    assert frames == sorted(set(frames))


def test_stiffness_can_be_set_only_for_the_material_that_has_it(panel: PropertiesPanel) -> None:
    assert not panel.mapping.mu.isEnabled()
    choose(panel.mapping.material, "St. Venant–Kirchhoff")
    assert panel.mapping.mu.isEnabled()
    assert panel.mapping.lam.isEnabled()


# -- colours -----------------------------------------------------------------------------------


def open_picker(panel: PropertiesPanel, field: QWidget) -> QColorDialog:
    QTest.mouseClick(field.findChild(Swatch), LEFT)
    return field.findChild(QColorDialog)


def test_colours_are_shown_while_picked_and_kept_as_one_step(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    before = workspace.session.document
    picker = open_picker(panel, panel.layer.fill)
    for value in ("#101010", "#202020", "#303030"):
        picker.setCurrentColor(QColor(value))
        assert layer(workspace).style.fill == value
    picker.accept()
    assert workspace.session.undo_stack.count() == 1
    workspace.session.undo()
    assert workspace.session.document is before


def test_a_picker_closed_without_a_choice_leaves_the_identical_document(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    before = workspace.session.document
    picker = open_picker(panel, panel.document.background)
    picker.setCurrentColor(QColor("#101010"))
    assert workspace.session.document.background == "#101010"
    picker.reject()
    assert workspace.session.document is before
    assert workspace.session.undo_stack.count() == 0


def test_the_picker_starts_from_the_colour_with_its_alpha(panel: PropertiesPanel) -> None:
    picker = open_picker(panel, panel.layer.stroke)
    assert picker.currentColor().getRgb() == (0x00, 0xBB, 0x00, 0x80)
    picker.reject()


def test_a_typed_colour_and_none_are_one_step_each(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    line = panel.layer.fill.findChild(QLineEdit)
    line.setFocus()
    line.selectAll()
    QTest.keyClicks(line, "12345678")
    QTest.keyClick(line, Key.Key_Return)
    assert layer(workspace).style.fill == "#12345678"
    QTest.mouseClick(panel.layer.fill.findChild(QToolButton), LEFT)
    assert layer(workspace).style.fill == ""
    assert workspace.session.undo_stack.count() == 2


# -- easing ------------------------------------------------------------------------------------


def drag_handle(panel: PropertiesPanel, index: int, to: QPointF, *, escape: bool = False) -> None:
    curve = panel.span.curve
    start = curve.handle(index)
    QTest.mousePress(curve, LEFT, pos=start.toPoint())
    for i in range(1, 11):
        QTest.mouseMove(curve, (start + (to - start) * (i / 10)).toPoint())
    if escape:
        QTest.keyClick(curve, Key.Key_Escape)
    QTest.mouseRelease(curve, LEFT, pos=to.toPoint())


def test_dragging_a_handle_is_one_step_and_it_stays_under_the_mouse(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    before, curve = workspace.session.document, panel.span.curve
    drag_handle(panel, 0, curve.position(0.75, 0.25))
    easing = layer(workspace).keyframes[1].easing
    assert (easing.x1, easing.y1) == pytest.approx((0.75, 0.25), abs=0.01)
    assert (easing.x2, easing.y2) == (EASE_IN.x2, EASE_IN.y2)
    assert panel.span.preset.currentIndex() == -1
    assert workspace.session.undo_stack.count() == 1
    workspace.session.undo()
    assert workspace.session.document is before


def test_a_handle_stays_within_time_but_may_overshoot(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    curve = panel.span.curve
    drag_handle(panel, 1, QPointF(curve.width() + 300, -300))
    easing = layer(workspace).keyframes[1].easing
    assert easing.x2 == 1.0
    assert easing.y2 > 1.2


def test_escape_takes_a_dragged_handle_back(panel: PropertiesPanel, workspace: Workspace) -> None:
    before = workspace.session.document
    drag_handle(panel, 0, panel.span.curve.position(0.75, 0.25), escape=True)
    assert workspace.session.document is before
    assert workspace.session.undo_stack.count() == 0


def test_the_curve_is_shaped_from_the_keyboard_in_one_step(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    curve = panel.span.curve
    curve.setFocus()
    for _ in range(3):
        QTest.keyClick(curve, Key.Key_Up)
    QTest.keyClick(curve, Key.Key_Left, SHIFT)
    QTest.keyClick(curve, Key.Key_Space)
    QTest.keyClick(curve, Key.Key_Down)
    easing = layer(workspace).keyframes[1].easing
    assert easing == Easing(0.41, 0.15, 1.0, 0.95)
    assert workspace.session.undo_stack.count() == 1


def test_the_easing_is_that_of_the_span_under_the_playhead(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    choose(panel.span.preset, "Hold")
    workspace.playhead.move_to(6)
    assert panel.span.preset.currentText() == "Ease in"
    choose(panel.span.preset, "Linear")
    easings = [key.easing for key in layer(workspace).keyframes]
    assert easings == [PRESETS["linear"], HOLD, EASE_IN]
    workspace.playhead.move_to(14)
    assert panel.span.preset.currentText() == "Hold"


def test_a_locked_layer_keeps_its_timing(panel: PropertiesPanel, workspace: Workspace) -> None:
    workspace.session.apply("Lock", update_layer, 1, locked=True)
    for field in (panel.keyframe.frame, panel.span.preset, panel.span.curve):
        assert not field.isEnabled()


# -- result ------------------------------------------------------------------------------------


def test_the_result_of_the_span_is_shown(
    panel: PropertiesPanel, workspace: Workspace, qtbot: QtBot
) -> None:
    workspace.playhead.move_to(3)
    qtbot.waitUntil(lambda: workspace.solver.state(1, 0) is SpanState.SOLVED)
    qtbot.waitUntil(lambda: "✓ Sound" in panel.result.state.text())
    text = panel.result.text
    assert text("mesh").split() == ["1234", "vertices", "2345", "triangles"]
    assert text("folds") == "⚠ 0 source, 2 target"
    assert (text("mean"), text("worst")) == ("1.062", "∞")
    assert text("time") == "12.5 ms"
    assert text("repairs") == "Removed 2 repeated points."


def test_a_failure_says_why_and_what_to_do(
    panel: PropertiesPanel, workspace: Workspace, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: workspace.solver.state(1, 1) is SpanState.FAILED)
    said = panel.result.state.text()
    assert "The outlines do not fit. Draw them anew." in said
    assert panel.result.text("mesh") == "–"


def test_a_result_from_before_the_last_change_is_marked_stale(
    panel: PropertiesPanel, workspace: Workspace, qtbot: QtBot
) -> None:
    workspace.playhead.move_to(3)
    qtbot.waitUntil(lambda: not workspace.solver.busy)
    workspace.session.apply("Move", move_nodes, 1, 0, 0, [0], (-1.0, 0.0))
    workspace.solver.cancel()
    assert "before the last change" in panel.result.state.text()
    assert "1234" in panel.result.text("mesh")
    workspace.solver.resume()
    qtbot.waitUntil(lambda: "✓" in panel.result.state.text())


def test_a_crossing_is_told_in_words_and_a_click_goes_from_frame_to_frame(
    open_workspace: Callable[..., Workspace], qtbot: QtBot
) -> None:
    eye = Eye(4, 5, 9)
    workspace = open_workspace(Document((a_layer(1, 1, 13),)), solve, eye)
    panel = PropertiesPanel(workspace)
    qtbot.addWidget(panel)
    panel.show()
    said, go = panel.result.state, panel.result.go
    qtbot.waitUntil(lambda: said.text() == "⚠ Crosses itself at frames 4 to 5, 9.")
    for frame in (4, 5, 9, 4):
        assert go.text() == f"Go to frame {frame}"
        QTest.mouseClick(go, Qt.MouseButton.LeftButton)
        assert workspace.playhead.frame == frame
    workspace.playhead.move_to(6)
    assert go.text() == "Go to frame 9"
    eye.gate.clear()
    workspace.session.apply("Move", move_nodes, 1, 0, 0, [0], (-1.0, 0.0))
    assert "Crosses" not in said.text()
    assert not go.isVisible()
    eye.crossing = set()
    eye.gate.set()
    qtbot.waitUntil(lambda: "✓ Sound" in said.text())
    assert not go.isVisible()


# -- looks -------------------------------------------------------------------------------------


def test_every_control_has_a_name_and_room_to_be_hit(panel: PropertiesPanel) -> None:
    kinds = (QAbstractButton, QAbstractSpinBox, QComboBox)
    inner = (QAbstractSpinBox, QComboBox)
    controls = [c for c in panel.widget().findChildren(QWidget) if isinstance(c, kinds)]
    controls = [c for c in controls if not isinstance(c.parent(), inner)]
    assert len(controls) > 20
    for control in controls:
        assert control.accessibleName(), control
        assert min(control.width(), control.height()) >= 24, control.accessibleName()


def test_nothing_is_clipped_at_the_width_of_a_dock(
    panel: PropertiesPanel, workspace: Workspace, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: not workspace.solver.busy)
    room = panel.viewport().width()
    assert panel.widget().minimumSizeHint().width() <= room
    for label in panel.findChildren(QLabel):
        if label.isVisible() and not label.wordWrap():
            needed = label.fontMetrics().horizontalAdvance(label.text())
            assert needed <= label.width(), label.text()
    for box in panel.findChildren(QComboBox):
        for i in range(box.count()):
            needed = box.fontMetrics().horizontalAdvance(box.itemText(i)) + 26
            assert needed <= box.width(), box.itemText(i)


def test_an_empty_document_shows_only_its_own_properties(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    workspace.session.replace(replace(Document(), fps=12.0))
    visible = [
        s
        for s in ("layer", "keyframe", "span", "mapping", "result", "document", "onion")
        if getattr(panel, s).isVisible()
    ]
    assert visible == ["document"]


# -- onion skin --------------------------------------------------------------------------------


def test_the_onion_skin_is_set_without_touching_the_document(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    before, view = workspace.session.document, workspace.view
    view.update(onion=False)
    type_in(panel.onion.before, "3")
    type_in(panel.onion.after, "0")
    assert (view.onion_before, view.onion_after) == (3, 0)
    assert view.onion  # what is set is seen
    line = panel.onion.tint_after.findChild(QLineEdit)
    type_in(line, "00ff00")
    QTest.keyClick(line, Key.Key_Return)
    assert view.tint_after == "#00ff00"
    assert workspace.session.document is before
    assert workspace.session.undo_stack.count() == 0


def test_a_tint_cannot_be_none(panel: PropertiesPanel, workspace: Workspace) -> None:
    tint = workspace.view.tint_before
    line = panel.onion.tint_before.findChild(QLineEdit)
    type_in(line, "none")
    QTest.keyClick(line, Key.Key_Return)
    assert workspace.view.tint_before == line.text() == tint
    assert not panel.onion.tint_before.findChild(QToolButton).isVisible()


def test_a_tint_that_was_only_tried_is_put_back(
    panel: PropertiesPanel, workspace: Workspace
) -> None:
    tint = workspace.view.tint_before
    picker = open_picker(panel, panel.onion.tint_before)
    picker.setCurrentColor(QColor("#101010"))
    assert workspace.view.tint_before == "#101010"
    picker.reject()
    assert workspace.view.tint_before == tint
