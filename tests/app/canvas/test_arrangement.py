from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.canvas.moment import Role
from tests.app.canvas.conftest import LEFT, NO_KEYS, Hand
from tests.card import SQUARE, a_document

SOURCE, BETWEEN, TARGET, OVERLAY = Role.SOURCE, Role.IN_BETWEEN, Role.TARGET, Role.OVERLAY
HIGH, WIDE = (940, 540), (1200, 460)


@pytest.fixture
def hand(open_canvas: Callable[..., Hand]) -> Hand:
    return open_canvas()


def resize(hand: Hand, size: tuple[int, int]) -> None:
    hand.canvas.resize(*size)
    QApplication.processEvents()


def corner(hand: Hand, role: Role) -> QPoint:
    """Where a pane begins."""
    return hand.pane(role).mapTo(hand.canvas, QPoint())


def stacked(hand: Hand) -> bool:
    source, target = corner(hand, SOURCE), corner(hand, TARGET)
    assert (target.x() == source.x()) != (target.y() == source.y())
    return target.x() == source.x()


def drag_handle(hand: Hand, index: int, by: QPoint) -> None:
    """Drag a handle between the panes."""
    handle = hand.canvas._arranged.handle(index)
    start = handle.rect().center()
    QTest.mousePress(handle, LEFT, NO_KEYS, start)
    QTest.mouseMove(handle, start + by)
    QTest.mouseRelease(handle, LEFT, NO_KEYS, start + by)
    QApplication.processEvents()


def test_the_target_is_where_the_artboard_is_seen_largest(hand: Hand):
    for size, is_stacked in ((HIGH, True), (WIDE, False), (HIGH, True)):
        resize(hand, size)
        assert stacked(hand) == is_stacked
        assert corner(hand, BETWEEN).y() == corner(hand, SOURCE).y()


def test_a_tall_artboard_puts_the_panes_in_a_row(open_canvas: Callable[..., Hand]):
    hand = open_canvas(replace(a_document(), size=(400.0, 800.0)))
    resize(hand, HIGH)
    assert not stacked(hand)
    hand.workspace.session.apply("", lambda document: replace(document, size=(800.0, 400.0)))
    QApplication.processEvents()
    assert stacked(hand)


def test_arranging_anew_shows_the_artboard_larger(hand: Hand):
    resize(hand, HIGH)
    width = hand.canvas.camera.zoom * hand.document.size[0]
    assert width > 1.2 * HIGH[0] * 4 / 13  # all that it could have in a row


def test_a_drawing_and_the_focus_survive_another_arrangement(open_canvas: Callable[..., Hand]):
    hand = open_canvas(a_document(target=False), tool="pen")
    for place in SQUARE:
        hand.click(TARGET, place)
    resize(hand, HIGH)
    view = hand.pane(TARGET).view
    assert view.hasFocus()
    QTest.keyClick(view, Qt.Key.Key_Return)
    assert len(hand.document.layers[0].keyframes) == 2


def test_tab_goes_from_source_to_target_however_they_are_arranged(hand: Hand):
    for size in (WIDE, HIGH, WIDE):
        resize(hand, size)
        hand.pane(SOURCE).view.setFocus()
        for role in (BETWEEN, TARGET):
            QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
            assert hand.pane(role).view.hasFocus()


def test_the_overlay_has_all_the_room(hand: Hand):
    for size in (WIDE, HIGH):
        resize(hand, size)
        hand.workspace.view.update(layout="overlay")
        QApplication.processEvents()
        assert hand.pane(OVERLAY).size().toTuple() == size
        assert hand.pane(SOURCE).isHidden()
        hand.workspace.view.update(layout="side by side")
        assert hand.pane(OVERLAY).isHidden()


def test_the_artists_own_division_stays_when_the_window_grows(hand: Hand):
    before = hand.pane(SOURCE).width() / hand.canvas.width()
    drag_handle(hand, 1, QPoint(-150, 0))
    narrower = hand.pane(SOURCE).width() / hand.canvas.width()
    assert narrower < before - 0.05
    resize(hand, (1500, 460))
    assert hand.pane(SOURCE).width() / hand.canvas.width() == pytest.approx(narrower, abs=0.01)
