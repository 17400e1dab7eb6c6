from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from PySide6.QtCore import Qt
from shapely.geometry import LinearRing
from shapely.geometry import Point as Spot

from app.canvas.moment import Role
from core.geometry.flatten import flatten
from core.model import Document
from tests.app.canvas.conftest import Hand
from tests.card import a_document

SOURCE, TARGET = Role.SOURCE, Role.TARGET


def stroke() -> list[np.ndarray]:
    angle = np.linspace(0, 2 * np.pi, 16)
    return list(np.array([480, 270]) + np.column_stack([180 * np.cos(angle), 120 * np.sin(angle)]))


@pytest.fixture
def empty(open_canvas: Callable[..., Hand]) -> Hand:
    hand = open_canvas(Document())
    hand.canvas.set_tool("freehand")
    return hand


def test_a_stroke_becomes_an_outline_of_few_nodes_close_to_it(empty: Hand):
    empty.drag(SOURCE, *stroke())
    outline = empty.document.layers[0].keyframes[0].outline
    assert 3 <= len(outline.rings[0]) <= 16
    drawn = LinearRing(flatten(outline)[0].points)
    reach = 5 * empty.pane(SOURCE).view.pixel
    assert max(drawn.distance(Spot(point)) for point in stroke()) < reach
    assert empty.steps == ["Draw layer"]


def test_a_stroke_on_the_target_makes_the_second_key(open_canvas):
    hand = open_canvas(a_document(target=False))
    hand.canvas.set_tool("freehand")
    hand.drag(TARGET, *stroke())
    assert [key.frame for key in hand.document.layers[0].keyframes] == [1, 25]


def test_escape_abandons_the_stroke(empty: Hand):
    before = empty.document
    empty.pull(SOURCE, *stroke())
    empty.key(SOURCE, Qt.Key.Key_Escape)
    empty.release(SOURCE, stroke()[-1])
    assert empty.document is before
    assert empty.canvas.tool == "freehand"


def test_a_stroke_around_nothing_is_refused_with_advice(empty: Hand):
    hints: list[str] = []
    empty.canvas.hint_changed.connect(hints.append)
    empty.drag(SOURCE, (300, 200), (500, 202))
    assert not empty.document.layers
    assert "Draw around the whole shape" in hints[-1]
