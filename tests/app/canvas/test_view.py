from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QTransform, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.canvas.camera import MAX_ZOOM, MIN_ZOOM
from app.canvas.moment import Role
from core.model import Document, Style
from core.model.edits import update_layer
from tests.app.canvas.conftest import Hand
from tests.card import LEANING, SQUARE, a_document

SOURCE, BETWEEN, TARGET, OVERLAY = Role.SOURCE, Role.IN_BETWEEN, Role.TARGET, Role.OVERLAY
Key = Qt.Key
SIDE_BY_SIDE = (SOURCE, BETWEEN, TARGET)
SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def hand(open_canvas: Callable[..., Hand]) -> Hand:
    return open_canvas(a_document())


def wheel(
    hand: Hand,
    role: Role,
    place: tuple[float, float],
    notches: int,
    keys: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier,
    sideways: int = 0,
) -> None:
    viewport = hand.pane(role).view.viewport()
    at = QPointF(hand.pixel(role, place))
    event = QWheelEvent(
        at,
        viewport.mapToGlobal(at),
        QPoint(),
        QPoint(120 * sideways, 120 * notches),
        Qt.MouseButton.NoButton,
        keys,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(viewport, event)


@pytest.mark.parametrize("flipped", [False, True])
def test_pixels_and_document_points_map_back_and_forth(hand: Hand, flipped: bool):
    if flipped:
        hand.canvas.camera.flip()
    for role in SIDE_BY_SIDE:
        view = hand.pane(role).view
        np.testing.assert_allclose(view.to_document(view.to_screen(SQUARE)), SQUARE)
        x, y = view.to_screen([[0, 0], [10, 10]]).T
        assert y[1] > y[0]
        assert (x[1] > x[0]) != flipped


@pytest.mark.parametrize("flipped", [False, True])
def test_artwork_is_painted_where_the_mouse_finds_it(hand: Hand, flipped: bool):
    if flipped:
        hand.canvas.camera.flip()
    hand.canvas.camera.zoom_at(QPointF(333, 222), 1.7)
    for role in SIDE_BY_SIDE:
        pane = hand.pane(role)
        pane.view.grab()
        seen: QTransform = pane.artwork.deviceTransform(pane.view.viewportTransform())
        for x, y in SQUARE:
            at = seen.map(QPointF(x, y))
            np.testing.assert_allclose([at.x(), at.y()], pane.view.to_screen([x, y]), atol=1e-6)


def test_the_wheel_zooms_at_the_cursor_in_all_panes(hand: Hand):
    before, zoom = hand.pixel(SOURCE, SQUARE[1]), hand.canvas.camera.zoom
    wheel(hand, SOURCE, SQUARE[1], 2)
    assert hand.canvas.camera.zoom == pytest.approx(zoom * 1.2**2, rel=0.02)
    moved = hand.pixel(SOURCE, SQUARE[1]) - before
    assert moved.manhattanLength() <= 2
    assert hand.pane(TARGET).view.pixel == hand.pane(SOURCE).view.pixel


@pytest.mark.parametrize("flipped", [False, True])
def test_the_wheel_pans_sideways_or_with_shift(hand: Hand, flipped: bool):
    if flipped:
        hand.canvas.camera.flip()
    zoom = hand.canvas.camera.zoom
    for turn in ({"notches": 0, "sideways": 1}, {"notches": 1, "keys": SHIFT}):
        before = hand.pixel(SOURCE, SQUARE[0])
        wheel(hand, SOURCE, SQUARE[0], **turn)
        assert (hand.pixel(SOURCE, SQUARE[0]) - before).toTuple() == (60, 0)
    assert hand.canvas.camera.zoom == zoom


def test_zoom_has_limits(hand: Hand):
    for notches in (500, -1000):
        wheel(hand, SOURCE, SQUARE[0], notches)
        assert MIN_ZOOM <= hand.canvas.camera.zoom <= MAX_ZOOM


@pytest.mark.parametrize("flipped", [False, True])
def test_a_middle_drag_moves_the_picture_with_the_mouse(hand: Hand, flipped: bool):
    if flipped:
        hand.canvas.camera.flip()
    view = hand.pane(SOURCE).view
    place = view.to_document([100, 100])
    QTest.mousePress(view.viewport(), Qt.MouseButton.MiddleButton, pos=QPoint(100, 100))
    QTest.mouseMove(view.viewport(), QPoint(160, 70))
    QTest.mouseRelease(view.viewport(), Qt.MouseButton.MiddleButton, pos=QPoint(160, 70))
    np.testing.assert_allclose(view.to_screen(place), [160, 70], atol=1e-6)
    assert hand.steps == []


@pytest.mark.parametrize("key", [Key.Key_Space, Key.Key_H])
def test_a_drag_with_the_hand_key_held_moves_the_view_and_edits_nothing(hand: Hand, key: Qt.Key):
    view, before = hand.pane(SOURCE).view, hand.document
    view.setFocus()
    place = view.to_document([200, 200])
    QTest.keyPress(view, key)
    QTest.mousePress(view.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(200, 200))
    QTest.mouseMove(view.viewport(), QPoint(230, 190))
    QTest.mouseRelease(view.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(230, 190))
    QTest.keyRelease(view, key)
    np.testing.assert_allclose(view.to_screen(place), [230, 190], atol=1e-6)
    assert hand.document is before
    assert not hand.workspace.playhead.playing
    hand.drag(SOURCE, (450, 300), (500, 330))
    assert hand.steps == ["Move outline"]


def test_a_tap_of_space_plays_and_stops(hand: Hand):
    hand.key(BETWEEN, Key.Key_Space)
    assert hand.workspace.playhead.playing
    hand.key(BETWEEN, Key.Key_Space)
    assert not hand.workspace.playhead.playing


def test_fit_shows_every_keyframe_in_every_pane(hand: Hand):
    hand.canvas.camera.pan(3000, -2000)
    hand.canvas.framing.fit()
    for role in SIDE_BY_SIDE:
        view = hand.pane(role).view
        size = view.viewport().size()
        pixels = view.to_screen([*SQUARE, *LEANING])
        assert (pixels >= 0).all()
        assert (pixels <= [size.width(), size.height()]).all()


def test_fit_shows_the_whole_artboard_in_every_pane(hand: Hand):
    width, height = hand.document.size
    for layout in ("side by side", "overlay"):
        hand.workspace.view.update(layout=layout)
        QApplication.processEvents()
        hand.canvas.framing.fit()
        for pane in hand.canvas.panes.values():
            if pane.isVisible():
                size = pane.view.viewport().size()
                pixels = pane.view.to_screen([(0, 0), (width, height)])
                assert (pixels >= 0).all()
                assert (pixels <= [size.width(), size.height()]).all()


def test_the_drawing_can_be_seen_larger_than_the_artboard_allows(hand: Hand):
    hand.canvas.framing.fit()
    whole = hand.canvas.camera.zoom
    hand.canvas.framing.show_drawing()
    assert hand.canvas.camera.zoom > 1.2 * whole
    drawn = np.vstack([hand.points(0), hand.points(1)])
    assert (hand.pane(SOURCE).view.to_screen(drawn) >= 0).all()


def test_fit_shows_the_artboard_when_nothing_is_drawn(open_canvas):
    hand = open_canvas(Document(size=(400, 300)))
    hand.canvas.framing.fit()
    centre = hand.canvas.camera.centre
    assert (centre.x(), centre.y()) == (200, 150)


def test_100_percent_is_one_pixel_for_one_unit(hand: Hand):
    hand.canvas.framing.show_pixels()
    assert hand.pane(SOURCE).view.pixel == 1.0


def test_the_view_fits_again_on_resizing_until_the_artist_zooms(hand: Hand, qtbot):
    zoom = hand.canvas.camera.zoom
    hand.canvas.resize(700, 300)
    qtbot.waitUntil(lambda: hand.canvas.camera.zoom < zoom)
    wheel(hand, SOURCE, SQUARE[0], 1)
    zoom = hand.canvas.camera.zoom
    hand.canvas.resize(1200, 460)
    QApplication.processEvents()
    assert hand.canvas.camera.zoom == zoom


def test_the_view_is_not_part_of_the_document(hand: Hand):
    before = hand.document
    hand.canvas.camera.flip()
    hand.canvas.framing.show_pixels()
    hand.workspace.view.update(layout="overlay", mesh=True, onion=False)
    assert hand.document is before


def test_escape_puts_an_idle_tool_away(hand: Hand):
    changed: list[str] = []
    hand.canvas.tool_changed.connect(changed.append)
    hand.canvas.set_tool("marks")
    hand.key(SOURCE, Key.Key_Escape)
    assert hand.canvas.tool == "select"
    assert changed == ["marks", "select"]


def test_tab_leaves_the_canvas_while_the_tool_has_no_use_for_it(hand: Hand):
    hand.pane(SOURCE).view.setFocus()
    QTest.keyClick(hand.pane(SOURCE).view, Key.Key_Tab)
    assert not hand.pane(SOURCE).view.hasFocus()


def test_keys_go_to_the_key_of_the_pane_in_focus(hand: Hand):
    hand.pane(TARGET).view.setFocus()
    assert hand.workspace.selection.key == 1
    hand.pane(SOURCE).view.setFocus()
    assert hand.workspace.selection.key == 0


def test_switching_the_layout_switches_the_panes(hand: Hand):
    hand.workspace.view.update(layout="overlay")
    assert [role for role in Role if hand.pane(role).isVisible()] == [OVERLAY]
    hand.workspace.view.update(layout="side by side")
    assert [role for role in Role if hand.pane(role).isVisible()] == [SOURCE, BETWEEN, TARGET]


def test_panes_keep_their_shares_of_the_width(hand: Hand):
    def widths() -> list[int]:
        return [hand.pane(role).width() for role in SIDE_BY_SIDE]

    before = np.array(widths()) / sum(widths())
    hand.canvas.resize(800, 460)
    hand.workspace.view.update(layout="overlay")
    hand.workspace.view.update(layout="side by side")
    QApplication.processEvents()
    np.testing.assert_allclose(np.array(widths()) / sum(widths()), before, atol=0.01)
    assert widths()[1] == max(widths())


def test_plus_and_minus_zoom(hand: Hand):
    zoom = hand.canvas.camera.zoom
    hand.key(SOURCE, Key.Key_Plus)
    assert hand.canvas.camera.zoom == pytest.approx(1.25 * zoom)
    hand.key(SOURCE, Key.Key_Minus, Qt.KeyboardModifier.ControlModifier)
    assert hand.canvas.camera.zoom == pytest.approx(zoom)


def test_mere_hovering_repaints_nothing(hand: Hand):
    overlay = hand.pane(SOURCE).tool_overlay
    painted: list[object] = []
    overlay.draw = painted.append
    hand.move(SOURCE, (450, 300))
    painted.clear()
    for x in range(400, 450, 5):
        hand.move(SOURCE, (x, 300))
    assert painted == []


def test_what_changes_is_painted_once(open_canvas: Callable[..., Hand]):
    hand = open_canvas(a_document(), tool="nodes")
    painted: list[Role] = []
    for role in SIDE_BY_SIDE:
        hand.pane(role).tool_overlay.draw = lambda painter, role=role: painted.append(role)
    hand.workspace.playhead.move_to(13)
    hand.move(SOURCE, SQUARE[0])
    hand.canvas.grab()
    painted.clear()
    hand.workspace.playhead.move_to(9)
    for _ in range(3):
        QApplication.processEvents()
    assert painted == [BETWEEN]
    painted.clear()
    hand.workspace.session.apply("Fill", update_layer, 1, style=Style("#ff0000"))
    hand.move(SOURCE, SQUARE[1])  # the tool shows something else, too
    for _ in range(3):
        QApplication.processEvents()
    assert sorted(painted, key=SIDE_BY_SIDE.index) == [*SIDE_BY_SIDE]
