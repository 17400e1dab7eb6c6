from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QColor, QImage
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.canvas.mesh_overlay import MeshOverlay, edges_of
from app.canvas.moment import Role
from app.canvas.pane import Pane
from app.jobs.inspector import Standing
from app.style import colours
from core.errors import MarkError, OutlineError, Where
from core.model import Document, Outline, Style
from core.model.easing import HOLD, Easing
from core.model.edits import add_layer, move_nodes, set_easing, update_layer
from core.morph.quality import folds
from core.progress import Progress
from tests.app.canvas.conftest import Hand, fan
from tests.app.eye import PLACE, Eye
from tests.card import LEANING, SQUARE, a_document

SOURCE, BETWEEN, TARGET, OVERLAY = Role.SOURCE, Role.IN_BETWEEN, Role.TARGET, Role.OVERLAY
RED = Style(fill="#ff0000", stroke="", stroke_width=0.0)
GREEN = Style(fill="#00ff00", stroke="", stroke_width=0.0)


@pytest.fixture
def hand(open_canvas: Callable[..., Hand]) -> Hand:
    hand = open_canvas(update_layer(a_document(marks=False), 1, style=RED))
    hand.workspace.view.update(onion=False)
    return hand


def show(hand: Hand, frame: float) -> None:
    hand.workspace.playhead.move_to(frame)
    QApplication.processEvents()


def image(pane: Pane) -> QImage:
    return pane.view.viewport().grab().toImage()


def colour_at(hand: Hand, role: Role, place: tuple[float, float]) -> str:
    view = hand.pane(role).view
    picture = image(hand.pane(role))
    x, y = view.to_screen(place) * picture.devicePixelRatio()
    return picture.pixelColor(round(x), round(y)).name()


def count(picture: QImage, colour: str) -> int:
    """How many pixels have a colour."""
    bits = np.frombuffer(picture.convertToFormat(QImage.Format.Format_RGB32).constBits(), np.uint32)
    return int(np.sum((bits & 0xFFFFFF) == (QColor(colour).rgb() & 0xFFFFFF)))


def test_titles_say_what_each_pane_shows(hand: Hand):
    show(hand, 7)
    assert hand.pane(SOURCE).title == "Source · frame 1"
    assert hand.pane(BETWEEN).title == "In-between · frame 7 · t 0.25"
    assert hand.pane(TARGET).title == "Target · frame 25"
    hand.workspace.view.update(layout="overlay")
    assert hand.pane(OVERLAY).title == "Overlay · frame 7 · t 0.25 · editing frame 1"
    show(hand, 25)
    assert hand.pane(OVERLAY).title == "Overlay · frame 25 · t 1.00 · editing frame 25"


def test_the_overlay_edits_a_key_of_the_span_that_is_seen(open_canvas):
    document = a_document(marks=False)
    layer = document.layers[0]
    keys = [replace(layer.keyframes[0], frame=frame) for frame in (1, 11, 21, 31)]
    hand = open_canvas(replace(document, layers=(replace(layer, keyframes=tuple(keys)),)))
    hand.workspace.view.update(layout="overlay")

    def edited() -> int:
        return hand.pane(OVERLAY).keyframe.frame

    for frame, seen in ((2, 1), (10, 1), (11, 11), (18, 11), (21, 21), (29, 21)):
        show(hand, frame)
        assert edited() == seen, frame
    hand.workspace.selection.select_key(1, 3)
    for frame, chosen in ((22, 31), (30, 31), (21, 21), (14, 21)):
        show(hand, frame)
        assert edited() == chosen, frame


def test_the_selected_key_is_one_that_is_seen(open_canvas):
    document = a_document(marks=False)
    layer = document.layers[0]
    keys = [replace(layer.keyframes[0], frame=frame) for frame in (1, 11, 21, 31)]
    hand = open_canvas(replace(document, layers=(replace(layer, keyframes=tuple(keys)),)))
    selection = hand.workspace.selection
    selection.select_key(1, 0)
    selection.select_nodes(frozenset({(0, 1)}))
    hand.pane(BETWEEN).view.setFocus()
    for frame, key in ((8, 0), (14, 1), (18, 1), (29, 3), (22, 3), (11, 1)):
        show(hand, frame)
        assert selection.key == key, frame
    assert selection.nodes == frozenset()  # those of a key that is out of sight
    hand.pane(TARGET).view.setFocus()
    show(hand, 28)
    assert selection.key == 3
    hand.workspace.playhead.play(from_start=True)
    QApplication.processEvents()
    assert selection.key == 3  # while it plays, nothing is chosen


def test_the_panes_show_source_in_between_and_target(hand: Hand):
    show(hand, 13)
    only_source, only_target = (310, 200), (660, 160)
    halfway = (335, 200)
    assert colour_at(hand, SOURCE, only_source) == "#ff0000"
    assert colour_at(hand, TARGET, only_source) == "#ffffff"
    assert colour_at(hand, TARGET, only_target) == "#ff0000"
    assert colour_at(hand, SOURCE, only_target) == "#ffffff"
    assert colour_at(hand, BETWEEN, only_source) == "#ffffff"
    assert colour_at(hand, BETWEEN, halfway) == "#ff0000"


def test_the_panes_follow_the_span_under_the_playhead(open_canvas):
    document = a_document(marks=False)
    layer = document.layers[0]
    third = replace(layer.keyframes[0], frame=49)
    hand = open_canvas(
        replace(document, layers=(replace(layer, keyframes=(*layer.keyframes, third)),))
    )
    for frame, source, target in ((1, 1, 25), (24, 1, 25), (25, 25, 49), (60, 25, 49)):
        show(hand, frame)
        assert hand.pane(SOURCE).title == f"Source · frame {source}"
        assert hand.pane(TARGET).title == f"Target · frame {target}"


def test_a_held_span_shows_its_first_key(open_canvas):
    document = update_layer(a_document(marks=False), 1, style=RED)
    hand = open_canvas(set_easing(document, 1, 0, HOLD))
    hand.workspace.view.update(onion=False)
    show(hand, 20)
    assert colour_at(hand, BETWEEN, (310, 200)) == "#ff0000"


def test_other_layers_are_dimmed_in_the_panes_of_keys_and_in_order_in_between(open_canvas):
    small = Outline.polygon([(400, 200), (500, 200), (500, 300), (400, 300)])
    document = update_layer(a_document(marks=False), 1, style=RED)
    document = update_layer(add_layer(document, "Small", 1, small), 2, style=GREEN)
    hand = open_canvas(document)
    hand.workspace.view.update(onion=False)
    hand.workspace.selection.select_layer(1)
    QApplication.processEvents()
    assert colour_at(hand, BETWEEN, (450, 250)) == "#00ff00"
    assert colour_at(hand, SOURCE, (450, 250)) not in ("#00ff00", "#ff0000")
    hand.workspace.session.apply("Hide", update_layer, 2, visible=False)
    QApplication.processEvents()
    assert colour_at(hand, BETWEEN, (450, 250)) == "#ff0000"


def test_the_background_and_its_absence_are_shown(open_canvas):
    hand = open_canvas(Document(background="#224466"))
    assert colour_at(hand, BETWEEN, (20, 20)) == "#224466"
    hand = open_canvas(Document(background=""))
    seen = {colour_at(hand, BETWEEN, (x, 20)) for x in range(20, 80, 5)}
    assert len(seen) == 2


def test_the_onion_skin_shows_so_many_keys_on_either_side_fainter_farther_away(open_canvas):
    layer = a_document(marks=False).layers[0]
    keys = tuple(replace(layer.keyframes[0], frame=frame) for frame in (1, 5, 9, 13))
    keys = tuple(
        replace(key, outline=key.outline.transformed(np.eye(2), [60.0 * i - 120.0, 0.0]))
        for i, key in enumerate(keys)
    )
    hand = open_canvas(replace(a_document(), layers=(replace(layer, keyframes=keys, labels=()),)))
    hand.canvas.set_tool("freehand")
    hand.workspace.view.update(tint_before="#ff0000", tint_after="#00ff00")

    def ghosts() -> list[float]:
        """How much colour there is where only the first, second … key has its left side."""
        picture = image(hand.pane(BETWEEN))
        view = hand.pane(BETWEEN).view
        places = [view.to_screen((300 + 60 * i - 120 + dx, 270)) for i, dx in ((0, 30), (1, 30))]
        right = view.to_screen((600 + 60 * 3 - 120 - 30, 270))
        return [picture.pixelColor(*map(round, at)).saturationF() for at in (*places, right)]

    show(hand, 9)
    first, second, last = ghosts()
    assert first == 0
    assert second > 0
    assert last > 0
    hand.workspace.view.update(onion_before=2, onion_after=0)
    QApplication.processEvents()
    farther, nearer, last = ghosts()
    assert 0 < farther < nearer
    assert last == 0


def test_an_in_between_is_dimmed_and_tagged_until_it_is_solved(open_canvas, qtbot):
    gate = threading.Event()

    def wait_then_solve(span, progress: Progress):
        gate.wait(10)
        return fan(span, progress)

    gate.set()
    document = update_layer(a_document(marks=False), 1, style=RED)
    hand = open_canvas(document, solve=wait_then_solve)
    hand.workspace.view.update(onion=False)
    show(hand, 13)
    assert hand.pane(BETWEEN).state == ""
    gate.clear()
    hand.canvas.set_tool("nodes")
    hand.drag(SOURCE, SQUARE[2], (620, 420))
    qtbot.waitUntil(lambda: hand.pane(BETWEEN).state == "updating…")
    assert colour_at(hand, BETWEEN, (450, 250)) not in ("#ff0000", "#ffffff")
    gate.set()
    qtbot.waitUntil(lambda: hand.pane(BETWEEN).state == "")
    assert colour_at(hand, BETWEEN, (450, 250)) == "#ff0000"


@pytest.mark.parametrize("frame", [4, 13, 22])
def test_a_stale_in_between_is_dimmed_also_where_its_easing_overshoots(open_canvas, qtbot, frame):
    def refuse(span, progress):
        raise MarkError("Marks a and b are out of order.")

    document = update_layer(a_document(marks=False), 1, style=RED)
    easing = Easing(0.2, -1.5, 0.8, 2.5)
    hand = open_canvas(set_easing(document, 1, 0, easing), solve=refuse)
    hand.workspace.view.update(onion=False)
    show(hand, frame)
    assert colour_at(hand, BETWEEN, (450, 250)) not in ("#ff0000", "#ffffff")


def test_a_span_that_cannot_be_solved_says_so(open_canvas, qtbot):
    def refuse(span, progress):
        raise MarkError("Marks a and b are out of order.")

    hand = open_canvas(a_document(), solve=refuse)
    qtbot.waitUntil(lambda: hand.pane(BETWEEN).state == "not solved")


def test_box_and_marks_are_out_of_sight_while_playing(open_canvas: Callable[..., Hand]):
    hand = open_canvas(a_document())
    hand.workspace.view.update(onion=False)
    for tool, ink in (("marks", colours().mark), ("select", colours().selection)):
        hand.canvas.set_tool(tool)
        assert count(image(hand.pane(SOURCE)), ink) > 0
    hand.workspace.playhead.play()
    QApplication.processEvents()
    for role in (SOURCE, BETWEEN, TARGET):
        picture = image(hand.pane(role))
        assert count(picture, colours().selection) == count(picture, colours().mark) == 0
    hand.canvas.set_tool("marks")  # marks can be put right while the motion repeats
    assert count(image(hand.pane(SOURCE)), colours().mark) > 0
    assert count(image(hand.pane(BETWEEN)), colours().mark) == 0
    hand.workspace.playhead.stop()
    QApplication.processEvents()
    assert count(image(hand.pane(BETWEEN)), colours().mark) > 0


def test_onion_skin_shows_both_keys_in_between_but_not_while_playing(hand: Hand):
    show(hand, 13)
    plain = image(hand.pane(BETWEEN))
    hand.workspace.view.update(onion=True)
    QApplication.processEvents()
    assert image(hand.pane(BETWEEN)) != plain
    hand.workspace.playhead.play()
    hand.workspace.playhead.stop()
    hand.workspace.view.update(onion=False)
    show(hand, 13)
    assert image(hand.pane(BETWEEN)) == plain


def test_a_key_has_no_onion_skin_of_itself(hand: Hand):
    pictures = []
    for onion in (False, True):
        hand.workspace.view.update(onion=onion)
        show(hand, 25)
        pictures.append(image(hand.pane(BETWEEN)))
    plain, skinned = pictures
    assert plain != skinned
    right = hand.pixel(BETWEEN, (605, 0)).x()  # only the later key, which is shown, is there
    assert plain.copy(right, 0, 400, 400) == skinned.copy(right, 0, 400, 400)


def test_a_hidden_layer_is_not_said_to_be_out_of_date(hand: Hand):
    hand.workspace.session.apply("Hide", update_layer, 1, visible=False)
    show(hand, 13)
    assert hand.pane(BETWEEN).state == "layer is hidden"


def test_an_empty_document_invites_to_draw(open_canvas):
    hand = open_canvas(Document())
    for role, words in ((SOURCE, "Draw the source outline here"), (TARGET, "Then the target")):
        assert hand.pane(role).invitation.title == words


def test_a_single_key_invites_to_draw_the_target(open_canvas):
    hand = open_canvas(a_document(target=False))
    assert hand.pane(TARGET).invitation.title == "Draw or import the target here"
    assert hand.pane(SOURCE).invitation.title == ""


@pytest.mark.parametrize("role", [SOURCE, BETWEEN, TARGET])
def test_the_mesh_is_shown_in_every_pane(hand: Hand, role: Role):
    show(hand, 13)
    plain = image(hand.pane(role))
    hand.workspace.view.update(mesh=True)
    QApplication.processEvents()
    assert image(hand.pane(role)) != plain
    hand.workspace.view.update(mesh=False)
    QApplication.processEvents()
    assert image(hand.pane(role)) == plain


def test_each_edge_of_the_mesh_is_drawn_once():
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    assert edges_of(triangles).tolist() == [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]


def test_folded_triangles_are_filled_in_the_error_colour(open_canvas):
    def fold(span, progress):
        morph = fan(span, progress)
        morph.target[-1] = (900, 100)  # the middle leaves the shape: some triangles turn over
        return morph

    hand = open_canvas(a_document(marks=False), solve=fold)
    hand.workspace.view.update(mesh=True, onion=False)
    show(hand, 13)
    assert count(image(hand.pane(SOURCE)), colours().error) == 0
    assert count(image(hand.pane(TARGET)), colours().error) > 50


def test_folds_are_shown_as_exactly_as_the_verdict_counts_them(hand: Hand):
    overlay, step = MeshOverlay(hand.pane(SOURCE).view, 99), 2.0**-53
    sliver = np.array([[0.5 - 40 * step, 0.5 - 39 * step], [12.0, 12.0], [24.0, 24.0]])
    for triangle in (np.array([[0, 1, 2]]), np.array([[0, 2, 1]])):
        overlay.show_mesh(triangle, sliver, "#ffffff")
        assert overlay._folds.isVisible() == (len(folds(sliver, triangle)) > 0)


def test_an_error_is_ringed_on_its_side_until_it_is_cleared(hand: Hand):
    error = MarkError("Here.", where=Where(side="target", point=(450.0, 300.0)))
    hand.canvas.show_error(error)
    QApplication.processEvents()
    assert count(image(hand.pane(TARGET)), colours().error) > 50
    assert count(image(hand.pane(SOURCE)), colours().error) == 0
    hand.canvas.clear_error()
    QApplication.processEvents()
    assert count(image(hand.pane(TARGET)), colours().error) == 0


@pytest.mark.parametrize(
    "where",
    [
        Where(marks=(0, 1)),
        Where(ring=0, node=2),
        Where(side="source", point=(400.0, 200.0)),
        Where(marks=(7,), ring=5, node=1, point=(400.0, 200.0)),
    ],
)
def test_marks_and_nodes_that_an_error_names_are_ringed(open_canvas, where: Where):
    hand = open_canvas(a_document())
    hand.canvas.show_error(OutlineError("Look here.", where=where))
    QApplication.processEvents()
    assert count(image(hand.pane(SOURCE)), colours().error) > 50


@pytest.mark.parametrize("where", [Where(), Where(ring=0, node=7), Where(ring=5, node=1)])
def test_an_error_without_a_place_that_is_drawn_rings_nothing(hand: Hand, where: Where):
    hand.canvas.show_error(OutlineError("Somewhere.", where=where))
    QApplication.processEvents()
    assert count(image(hand.pane(SOURCE)), colours().error) == 0


def test_marks_follow_the_in_between(open_canvas):
    hand = open_canvas(a_document())
    hand.canvas.set_tool("marks")
    show(hand, 13)
    with_marks = count(image(hand.pane(BETWEEN)), colours().mark)
    assert with_marks > 50
    hand.workspace.view.update(marks=False)
    QApplication.processEvents()
    assert count(image(hand.pane(BETWEEN)), colours().mark) == 0


def test_another_document_is_shown_at_once_and_the_tool_starts_over(hand: Hand):
    hand.canvas.set_tool("pen")
    hand.click(SOURCE, (100, 100))
    hand.workspace.session.replace(Document())
    QApplication.processEvents()
    assert hand.pane(SOURCE).invitation.title == "Draw the source outline here"
    assert hand.canvas.tool == "pen"


def test_every_pane_paints_with_every_tool_at_the_edges_of_time(open_canvas):
    for document in (Document(), a_document(), a_document(target=False)):
        hand = open_canvas(document)
        hand.workspace.view.update(mesh=True)
        for layout in ("side by side", "overlay"):
            hand.workspace.view.update(layout=layout)
            for tool in ("nodes", "pen", "freehand", "marks", "select"):
                hand.canvas.set_tool(tool)
                for frame in (1, 12.5, 25, 80):
                    show(hand, frame)
                    assert not hand.canvas.grab().isNull()


def test_hints_are_never_empty(open_canvas):
    for document in (Document(), a_document(), a_document(target=False)):
        hand = open_canvas(document)
        hints: list[str] = []
        hand.canvas.hint_changed.connect(hints.append)
        for tool in ("nodes", "pen", "freehand", "marks", "select"):
            hand.canvas.set_tool(tool)
            for role in (SOURCE, BETWEEN, TARGET):
                for place in (SQUARE[0], LEANING[1], (450, 300), (600, 275), (20, 20)):
                    hand.move(role, place)
        assert len(set(hints)) > 5
        assert all(hints)


def test_what_is_solved_in_a_moment_never_flickers(open_canvas, monkeypatch):
    monkeypatch.setattr("app.canvas.canvas.PATIENCE_MS", 60_000)
    hand = open_canvas(a_document())
    show(hand, 13)
    states: list[str] = []
    hand.workspace.solver.updated.connect(lambda: states.append(hand.pane(BETWEEN).state))
    hand.canvas.set_tool("nodes")
    hand.drag(SOURCE, SQUARE[2], (620, 420))
    QApplication.processEvents()
    assert states
    assert set(states) == {""}


def test_the_place_of_a_crossing_is_ringed_at_its_frames_until_the_span_changes(
    open_canvas: Callable[..., Hand], qtbot: QtBot
) -> None:
    eye = Eye(7, 8)
    document = update_layer(a_document(marks=False), 1, style=RED)
    hand = open_canvas(document, look=eye)
    inspector = hand.workspace.inspector
    qtbot.waitUntil(lambda: inspector.standing(1, 0) is Standing.UNSOUND)
    rings = hand.pane(BETWEEN).trouble_rings
    for frame, places in ((6, []), (7, PLACE.tolist()), (7.5, []), (8, PLACE.tolist()), (9, [])):
        show(hand, frame)
        assert rings.places.tolist() == places
        assert (count(image(hand.pane(BETWEEN)), colours().error) > 0) == bool(places)
    show(hand, 7)
    assert not len(hand.pane(SOURCE).trouble_rings.places)
    eye.gate.clear()
    hand.workspace.session.apply("Move", move_nodes, 1, 0, 0, [0], (-1.0, 0.0))
    QApplication.processEvents()
    assert not len(rings.places)
    eye.gate.set()
    qtbot.waitUntil(lambda: len(rings.places) == 1)
    hand.workspace.playhead.play()
    QApplication.processEvents()
    assert not len(rings.places)  # what plays is looked at, not worked on
    hand.workspace.playhead.stop()
