"""What a span on the timeline says about itself: by shape, by colour and in words."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QHelpEvent, QImage, QPainter
from PySide6.QtWidgets import QApplication, QToolTip
from pytestqt.qtbot import QtBot

from app.jobs.inspector import Standing
from app.style import colours
from app.timeline.badge import RADIUS, paint_badge
from app.timeline.rows import ROW
from app.timeline.timeline import Timeline
from app.timeline.track_painter import BAND, MIDDLE
from app.workspace import Workspace
from core.model import Document
from core.model.edits import move_nodes
from tests.app.eye import Eye
from tests.app.timeline.conftest import layer, solve


@pytest.fixture
def eye() -> Eye:
    return Eye(4, 5, 9)


@pytest.fixture
def workspace(open_workspace: Callable[..., Workspace], eye: Eye) -> Workspace:
    return open_workspace(Document((layer(1, 1, 13, 25),)), solve, eye)


def picture(timeline: Timeline) -> QImage:
    return timeline.tracks.grab().toImage()


def marked(timeline: Timeline, image: QImage) -> list[int]:
    """The frames at which the band has the colour of errors."""
    y, error = round(BAND), QColor(colours().error)
    return [k for k in range(2, 25) if image.pixelColor(x_of(timeline, k), y) == error]


def x_of(timeline: Timeline, frame: float) -> int:
    return int(timeline.view.scale.x(frame))


def tooltip(timeline: Timeline, frame: float) -> str:
    at = QPoint(x_of(timeline, frame), round(MIDDLE))
    QApplication.sendEvent(
        timeline.tracks, QHelpEvent(QEvent.Type.ToolTip, at, timeline.tracks.mapToGlobal(at))
    )
    return QToolTip.text()


def around(timeline: Timeline, image: QImage, frame: float) -> set[str]:
    """The colours around the middle of a badge."""
    x, y = x_of(timeline, frame), round(MIDDLE)
    reach = range(-7, 8)
    return {image.pixelColor(x + i, y + j).name() for i in reach for j in reach}


def test_troubled_frames_are_ticked_and_the_span_warns(
    timeline: Timeline, workspace: Workspace, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: workspace.inspector.standing(1, 1) is Standing.SOUND)
    workspace.playhead.move_to(25)
    image = picture(timeline)
    assert marked(timeline, image) == [4, 5, 9]
    assert colours().error in around(timeline, image, 7)
    assert colours().solved in around(timeline, image, 19)
    assert "Crosses itself at frames 4 to 5, 9." in tooltip(timeline, 8)
    assert "Sound" in tooltip(timeline, 20)


def test_the_warning_and_its_ticks_go_with_the_next_edit(
    timeline: Timeline, workspace: Workspace, eye: Eye, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: workspace.inspector.standing(1, 0) is Standing.UNSOUND)
    eye.gate.clear()
    workspace.session.apply("Move", move_nodes, 1, 0, 0, [0], (-1.0, 0.0))
    assert marked(timeline, picture(timeline)) == []
    assert "Solving" in tooltip(timeline, 8)
    qtbot.waitUntil(lambda: workspace.inspector.standing(1, 0) is Standing.CHECKING)
    assert marked(timeline, picture(timeline)) == []
    assert "checking" in tooltip(timeline, 8)
    eye.crossing = set()
    eye.gate.set()
    qtbot.waitUntil(lambda: workspace.inspector.standing(1, 0) is Standing.SOUND)
    assert "Sound" in tooltip(timeline, 8)


def test_badges_differ_in_shape_as_well_as_in_colour() -> None:
    different = [s for s in Standing if s not in (Standing.STALE, Standing.CHECKING)]
    shapes = {standing: shape(standing) for standing in different}
    for one, other in combinations(shapes.values(), 2):
        assert one != other


def shape(standing: Standing) -> list[bool]:
    """The pixels of a badge that are lighter than its ground, whatever their colours."""
    image = QImage(24, 24, QImage.Format.Format_ARGB32)
    image.fill(Qt.GlobalColor.transparent)
    with QPainter(image) as painter:
        paint_badge(painter, QPointF(12, 12), standing)
    reach = round(RADIUS) + 2
    pixels = [(x, y) for x in range(12 - reach, 12 + reach) for y in range(12 - reach, 12 + reach)]
    ground = image.pixelColor(12, 18).lightness()
    return [abs(image.pixelColor(*pixel).lightness() - ground) > 40 for pixel in pixels]


def test_a_span_too_short_for_a_badge_shows_its_keys(
    open_workspace: Callable[..., Workspace], eye: Eye, qtbot: QtBot
) -> None:
    workspace = open_workspace(Document((layer(1, 1, 2, 60),)), solve, eye)
    timeline = Timeline(workspace)
    qtbot.addWidget(timeline)
    timeline.resize(1000, 200)
    timeline.show()
    qtbot.waitUntil(lambda: workspace.inspector.standing(1, 1) is Standing.UNSOUND)
    assert timeline.tracks.height() >= ROW
    assert colours().solved not in around(timeline, picture(timeline), 1.5)
    assert colours().error in around(timeline, picture(timeline), 31)
