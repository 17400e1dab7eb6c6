"""A canvas on a document, and a hand that drives it with real mouse and key events."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from types import SimpleNamespace
from typing import ClassVar

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.canvas.canvas import Canvas
from app.canvas.moment import Role
from app.canvas.pane import Pane
from app.workspace import Workspace
from core.geometry.flatten import flatten
from core.geometry.polyline import resample
from core.model import Document
from core.morph.scene import Span
from core.progress import Progress

NO_KEYS = Qt.KeyboardModifier.NoModifier
LEFT = Qt.MouseButton.LeftButton


@dataclass(frozen=True, eq=False)
class Fan:
    """A solution of 48 points on each exterior, and a fan of triangles."""

    rest: np.ndarray
    target: np.ndarray
    rings: ClassVar = (np.arange(48),)
    triangles: ClassVar = np.column_stack(
        [np.arange(48), np.roll(np.arange(48), -1), np.full(48, 48)]
    )
    report: ClassVar = SimpleNamespace(proposed=())

    def at(self, s: float) -> np.ndarray:
        return (1 - s) * self.rest + s * self.target

    plain = at


def fan(span: Span, progress: Progress) -> Fan:
    """Solve a span in no time."""
    ends = [resample(flatten(outline)[0].points, 48) for outline in (span.source, span.target)]
    return Fan(*(np.vstack([end, end.mean(axis=0)]) for end in ends))


@dataclass
class Hand:
    """Mouse and keys over one canvas; places are in the document."""

    canvas: Canvas
    workspace: Workspace

    @property
    def document(self) -> Document:
        return self.workspace.session.document

    @property
    def steps(self) -> list[str]:
        """The undo steps so far."""
        stack = self.workspace.session.undo_stack
        return [stack.text(i) for i in range(stack.index())]

    def points(self, key: int = 0) -> np.ndarray:
        """The nodes of the exterior of the top layer's keyframe."""
        return self.document.layers[-1].keyframes[key].outline.rings[0].points

    def pane(self, role: Role) -> Pane:
        return self.canvas.panes[role]

    def pixel(self, role: Role, place: Sequence[float]) -> QPoint:
        x, y = self.pane(role).view.to_screen(place)
        return QPoint(round(x), round(y))

    def place(self, role: Role, place: Sequence[float]) -> np.ndarray:
        """Where in the document a mouse on whole pixels really is."""
        pixel = self.pixel(role, place)
        return self.pane(role).view.to_document([pixel.x(), pixel.y()])

    def move(
        self,
        role: Role,
        place: Sequence[float],
        keys: Qt.KeyboardModifier = NO_KEYS,
        held: Qt.MouseButton = Qt.MouseButton.NoButton,
    ) -> None:
        viewport = self.pane(role).view.viewport()
        at = QPointF(self.pixel(role, place))
        there, none = viewport.mapToGlobal(at), Qt.MouseButton.NoButton
        event = QMouseEvent(QEvent.Type.MouseMove, at, there, none, held, keys)
        QApplication.sendEvent(viewport, event)
        QApplication.processEvents()

    def press(
        self,
        role: Role,
        place: Sequence[float],
        keys: Qt.KeyboardModifier = NO_KEYS,
        button: Qt.MouseButton = LEFT,
    ) -> None:
        QTest.mousePress(self.pane(role).view.viewport(), button, keys, self.pixel(role, place))

    def release(
        self,
        role: Role,
        place: Sequence[float],
        keys: Qt.KeyboardModifier = NO_KEYS,
        button: Qt.MouseButton = LEFT,
    ) -> None:
        QTest.mouseRelease(self.pane(role).view.viewport(), button, keys, self.pixel(role, place))
        QApplication.processEvents()

    def click(
        self, role: Role, place: Sequence[float], keys: Qt.KeyboardModifier = NO_KEYS
    ) -> None:
        self.move(role, place, keys)
        self.press(role, place, keys)
        self.release(role, place, keys)

    def double_click(self, role: Role, place: Sequence[float]) -> None:
        self.click(role, place)
        viewport = self.pane(role).view.viewport()
        QTest.mouseDClick(viewport, LEFT, NO_KEYS, self.pixel(role, place))
        QApplication.processEvents()

    def pull(
        self,
        role: Role,
        *places: Sequence[float],
        keys: Qt.KeyboardModifier = NO_KEYS,
        button: Qt.MouseButton = LEFT,
    ) -> None:
        """Press at the first place and move through the others, without letting go."""
        self.move(role, places[0], keys)
        self.press(role, places[0], keys, button)
        for start, end in pairwise(places):
            for u in (0.25, 0.5, 0.75, 1.0):
                between = (1 - u) * np.asarray(start) + u * np.asarray(end)
                self.move(role, between, keys, button)

    def drag(
        self,
        role: Role,
        *places: Sequence[float],
        keys: Qt.KeyboardModifier = NO_KEYS,
        button: Qt.MouseButton = LEFT,
    ) -> None:
        self.pull(role, *places, keys=keys, button=button)
        self.release(role, places[-1], keys, button)

    def key(self, role: Role, key: Qt.Key, keys: Qt.KeyboardModifier = NO_KEYS) -> None:
        view = self.pane(role).view
        view.setFocus()
        QTest.keyClick(view, key, keys)
        QApplication.processEvents()


@pytest.fixture
def open_canvas(qtbot: QtBot, open_workspace: Callable[..., Workspace]) -> Callable[..., Hand]:
    """Open a canvas on a document, with spans that are solved in no time, and a tool in hand."""

    def open_it(document: Document | None = None, tool: str = "", **options: object) -> Hand:
        workspace = open_workspace(document, **{"solve": fan, **options})
        canvas = Canvas(workspace)
        qtbot.addWidget(canvas)
        canvas.resize(1200, 460)
        canvas.show()
        canvas.activateWindow()
        qtbot.waitUntil(lambda: not workspace.solver.busy and not workspace.inspector.busy)
        QApplication.processEvents()  # all of that is shown
        if tool:
            canvas.set_tool(tool)
            qtbot.waitUntil(lambda: tool != "marks" or workspace.suggestions.current)
        return Hand(canvas, workspace)

    return open_it
