"""A timeline on a document of two layers, whose spans are solved as the test says."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from app.timeline.rows import ROW
from app.timeline.timeline import Timeline
from app.timeline.track_painter import MIDDLE
from app.workspace import Workspace
from core.errors import SolveError
from core.model import Document, Keyframe, Layer, Outline
from core.morph.scene import Span
from core.progress import Progress

SQUARE = Outline.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])
BROKEN = 3.0
"""A keyframe of this scale makes its spans unsolvable."""


def layer(layer_id: int, *frames: int) -> Layer:
    keys = (Keyframe(f, SQUARE.transformed(np.eye(2) * (1 + i))) for i, f in enumerate(frames))
    return Layer(layer_id, f"layer {layer_id}", tuple(keys))


class Nothing:
    """A solution that nobody looks at."""


def solve(span: Span, progress: Progress) -> Nothing:
    """Solve nothing, at once."""
    if span.source.rings[0].points.max() == 10 * BROKEN:
        raise SolveError("The outlines do not fit.", hint="Draw them anew.")
    return Nothing()


@pytest.fixture
def workspace(open_workspace: Callable[..., Workspace]) -> Workspace:
    document = Document((layer(1, 1, 13, 25), layer(2, 1, 9)))
    return open_workspace(document, solve)


@pytest.fixture
def timeline(workspace: Workspace, qtbot: QtBot) -> Timeline:
    timeline = Timeline(workspace)
    qtbot.addWidget(timeline)
    timeline.resize(1000, 200)
    timeline.show()
    qtbot.waitExposed(timeline)
    return timeline


class Mouse:
    """A hand on the mouse: presses, moves pixel by pixel, releases."""

    def __init__(self, widget: QWidget) -> None:
        self.widget = widget

    def at(self, x: float, y: float) -> QPoint:
        return QPoint(round(x), round(y))

    def click(
        self, x: float, y: float, modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier
    ) -> None:
        QTest.mouseClick(self.widget, Qt.MouseButton.LeftButton, modifiers, self.at(x, y))

    def press(
        self,
        x: float,
        y: float,
        button: Qt.MouseButton = Qt.MouseButton.LeftButton,
        modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier,
    ) -> None:
        self._button, self._from = button, self.at(x, y)
        QTest.mousePress(self.widget, button, modifiers, self._from)

    def move(self, x: float, y: float) -> None:
        """Go there by every pixel on the way."""
        end = self.at(x, y)
        way = end - self._from
        steps = max(abs(way.x()), abs(way.y()), 1)
        for i in range(1, steps + 1):
            QTest.mouseMove(self.widget, self._from + way * (i / steps))
        self._from = end

    def release(self) -> None:
        modifiers = Qt.KeyboardModifier.NoModifier
        QTest.mouseRelease(self.widget, self._button, modifiers, self._from)

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        self.press(*start)
        self.move(*end)
        self.release()


def row_y(row: int) -> float:
    """The height at which the keys of a row lie, top row = 0."""
    return row * ROW + MIDDLE
