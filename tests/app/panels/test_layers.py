"""The layers panel is in step with the document and the selection, both ways."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QToolButton
from pytestqt.qtbot import QtBot

from app.panels.layer_table import LOCKED, NAME, SHOWN
from app.panels.layers import LayersPanel
from app.workspace import Workspace
from core.model import Document
from core.model.edits import update_layer
from tests.app.panels.conftest import a_layer

Key = Qt.Key
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def panel(workspace: Workspace, qtbot: QtBot) -> LayersPanel:
    panel = LayersPanel(workspace)
    qtbot.addWidget(panel)
    panel.resize(260, 240)
    panel.show()
    qtbot.waitExposed(panel)
    return panel


def shown_names(panel: LayersPanel) -> list[str]:
    model = panel.list.model()
    return [model.index(row, NAME).data() for row in range(model.rowCount())]


def stack(workspace: Workspace) -> list[int]:
    """Ids of the layers, top first."""
    return [layer.id for layer in reversed(workspace.session.document.layers)]


def cell(panel: LayersPanel, row: int, column: int) -> QPoint:
    return panel.list.visualRect(panel.table.index(row, column)).center()


def click(panel: LayersPanel, row: int, column: int) -> None:
    QTest.mouseClick(panel.list.viewport(), LEFT, pos=cell(panel, row, column))


def press(panel: LayersPanel, tip: str) -> None:
    button = next(b for b in panel.findChildren(QToolButton) if b.toolTip().startswith(tip))
    QTest.mouseClick(button, LEFT)


def drop(panel: LayersPanel, dragged: int, above: int) -> None:
    """Drop a row above another, as the view does it."""
    mime = panel.table.mimeData([panel.table.index(dragged, NAME)])
    parent = panel.table.index(-1, -1)
    panel.table.dropMimeData(mime, Qt.DropAction.MoveAction, above, 0, parent)


def test_the_top_layer_is_listed_first(panel: LayersPanel) -> None:
    assert shown_names(panel) == ["layer 3", "layer 2", "layer 1"]


def test_a_click_on_a_name_chooses_the_layer_and_edits_nothing(
    panel: LayersPanel, workspace: Workspace
) -> None:
    click(panel, 2, NAME)
    assert workspace.selection.layer.id == 1
    assert workspace.session.undo_stack.count() == 0


def test_a_layer_chosen_elsewhere_is_chosen_here(panel: LayersPanel, workspace: Workspace) -> None:
    workspace.selection.select_key(1, 2)
    assert panel.list.currentIndex().row() == 2
    assert workspace.selection.key == 2


def test_eye_and_padlock_are_one_step_each_and_follow_undo(
    panel: LayersPanel, workspace: Workspace
) -> None:
    before = workspace.session.document
    click(panel, 1, SHOWN)
    click(panel, 1, LOCKED)
    layer = workspace.session.document.layer(2)
    assert (layer.visible, layer.locked) == (False, True)
    assert panel.table.index(1, SHOWN).data(Qt.ItemDataRole.ToolTipRole) == "Show"
    workspace.session.undo()
    workspace.session.undo()
    assert workspace.session.document is before
    assert panel.table.index(1, SHOWN).data(Qt.ItemDataRole.ToolTipRole) == "Hide"


def test_a_name_is_edited_in_place_in_one_step(
    panel: LayersPanel, workspace: Workspace, qtbot: QtBot
) -> None:
    click(panel, 2, NAME)
    QTest.mouseDClick(panel.list.viewport(), LEFT, pos=cell(panel, 2, NAME))
    editor = panel.list.viewport().findChild(QLineEdit)
    editor.selectAll()
    QTest.keyClicks(editor, "Fish")
    QTest.keyClick(editor, Key.Key_Return)
    qtbot.waitUntil(lambda: workspace.session.document.layer(1).name == "Fish")
    assert workspace.session.undo_stack.count() == 1
    workspace.session.undo()
    assert shown_names(panel)[2] == "layer 1"


def test_an_empty_name_is_not_taken(panel: LayersPanel, workspace: Workspace) -> None:
    before = workspace.session.document
    panel.table.setData(panel.table.index(0, NAME), "  ")
    assert workspace.session.document is before


@pytest.mark.parametrize(
    ("dragged", "above", "order"),
    [
        (0, 2, [2, 3, 1]),
        (0, -1, [2, 1, 3]),
        (2, 0, [1, 3, 2]),
        (1, 1, [3, 2, 1]),
        (1, 2, [3, 2, 1]),
    ],
)
def test_a_layer_dropped_above_another_lies_there(
    panel: LayersPanel, workspace: Workspace, dragged: int, above: int, order: list[int]
) -> None:
    before = workspace.session.document
    drop(panel, dragged, above)
    assert stack(workspace) == order
    moved = order != [3, 2, 1]
    assert workspace.session.undo_stack.count() == moved
    workspace.session.undo()
    assert workspace.session.document is before


def test_the_buttons_raise_and_lower_the_current_layer(
    panel: LayersPanel, workspace: Workspace
) -> None:
    workspace.selection.select_layer(2)
    press(panel, "Raise")
    assert stack(workspace) == [2, 3, 1]
    press(panel, "Raise")  # it is on top: the button is off
    press(panel, "Lower")
    press(panel, "Lower")
    assert stack(workspace) == [3, 1, 2]
    assert workspace.session.undo_stack.count() == 3
    assert workspace.selection.layer.id == 2
    assert panel.list.currentIndex().row() == 2


def test_a_new_layer_is_a_circle_on_the_artboard_at_the_current_frame(
    panel: LayersPanel, workspace: Workspace
) -> None:
    workspace.playhead.move_to(7)
    press(panel, "Add")
    layer = workspace.session.document.layers[-1]
    assert workspace.selection.layer is layer
    assert [key.frame for key in layer.keyframes] == [7]
    left, top, right, bottom = layer.keyframes[0].outline.bounds()
    width, height = workspace.session.document.size
    assert ((left + right) / 2, (top + bottom) / 2) == pytest.approx((width / 2, height / 2))
    press(panel, "Add")
    names = shown_names(panel)
    assert len(set(names)) == len(names)


def test_a_duplicate_is_chosen_and_lies_above(panel: LayersPanel, workspace: Workspace) -> None:
    workspace.selection.select_layer(1)
    press(panel, "Duplicate")
    assert shown_names(panel) == ["layer 3", "layer 2", "layer 1 copy", "layer 1"]
    assert workspace.selection.layer.name == "layer 1 copy"
    assert workspace.session.undo_stack.count() == 1


def test_delete_removes_the_current_layer_by_button_and_by_key(
    panel: LayersPanel, workspace: Workspace
) -> None:
    before = workspace.session.document
    workspace.selection.select_layer(2)
    press(panel, "Delete")
    assert stack(workspace) == [3, 1]
    QTest.keyClick(panel.list, Key.Key_Delete)
    assert len(stack(workspace)) == 1
    workspace.session.undo()
    workspace.session.undo()
    assert workspace.session.document is before
    assert shown_names(panel) == ["layer 3", "layer 2", "layer 1"]


def test_without_layers_only_adding_is_offered(panel: LayersPanel, workspace: Workspace) -> None:
    workspace.session.replace(Document())
    buttons = panel.findChildren(QToolButton)
    enabled = [b.toolTip() for b in buttons if b.isEnabled() and b.toolTip()]
    assert enabled == ["Add a layer"]


def test_another_document_shows_its_own_layers_and_the_top_one_is_chosen(
    panel: LayersPanel, workspace: Workspace
) -> None:
    workspace.session.replace(Document((a_layer(7, 1, 5), a_layer(8, 1))))
    assert shown_names(panel) == ["layer 8", "layer 7"]
    assert workspace.selection.layer.id == 8
    assert panel.list.currentIndex().row() == 0


def test_a_change_of_colour_keeps_the_row_that_is_being_looked_at(
    panel: LayersPanel, workspace: Workspace
) -> None:
    workspace.selection.select_layer(1)
    workspace.session.apply("Lock", update_layer, 3, locked=True)
    assert panel.list.currentIndex().row() == 2
    assert workspace.selection.layer.id == 1
