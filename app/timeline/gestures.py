"""What the mouse does on the timeline, one class a gesture, from press to release."""

from __future__ import annotations

from typing import Protocol

from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtWidgets import QApplication

from app.document.session import Drag
from app.timeline.rows import Place
from app.timeline.time_view import TimeView
from app.workspace import Workspace
from core.model import Keyframe
from core.model.edits import insert_keyframe, move_keyframe

FINEST_SCRUB = 2
"""Decimals of a frame when scrubbing between frames."""
EDGE_SPEED = 0.2
"""How much of the way beyond the edge is scrolled at each move of the mouse."""


class Gesture(Protocol):
    """A drag under way."""

    def move(self, x: float, modifiers: Qt.KeyboardModifier) -> None:
        """Follow the mouse to pixel x."""

    def finish(self) -> None:
        """The button was released."""

    def cancel(self) -> None:
        """The artist pressed Escape: leave everything as it was before."""


class Scrub:
    """Moves the playhead: to whole frames, or anywhere while Shift is held."""

    def __init__(self, workspace: Workspace, view: TimeView) -> None:
        self._playhead, self._view = workspace.playhead, view
        self._before = self._playhead.frame
        self._playhead.stop()

    def move(self, x: float, modifiers: Qt.KeyboardModifier) -> None:
        """Go to the frame under the mouse; beyond an edge, time scrolls along."""
        beyond = min(x, 0.0) + max(x - self._view.width, 0.0)
        if beyond:
            self._view.pan(-EDGE_SPEED * beyond)
        frame = self._view.scale.frame(x - beyond)
        between = modifiers & Qt.KeyboardModifier.ShiftModifier
        self._playhead.move_to(round(frame, FINEST_SCRUB) if between else round(frame))

    def finish(self) -> None:
        """Stay there."""

    def cancel(self) -> None:
        """Go back."""
        self._playhead.move_to(self._before)


class KeyDrag:
    """Moves a keyframe in time, between its neighbours; the playhead goes with it."""

    def __init__(self, workspace: Workspace, view: TimeView, place: Place, x: float) -> None:
        self._workspace, self._view = workspace, view
        self._layer_id, self._key = place
        layer = workspace.session.document.layer(self._layer_id)
        self._start = self._frame = layer.keyframes[self._key].frame
        least, self._most = layer.room(self._key)
        self._least = max(least, workspace.playhead.lowest)
        self._grabbed = x
        self._drag: Drag | None = None

    def move(self, x: float, modifiers: Qt.KeyboardModifier) -> None:
        """Follow the mouse, once it has left the place where it was pressed."""
        if self._drag is None:
            if abs(x - self._grabbed) < QApplication.startDragDistance():
                return
            text = QCoreApplication.translate("Timeline", "Move keyframe")
            self._drag = self._workspace.session.begin(text)
        frame = self._start + round((x - self._grabbed) / self._view.scale.pixels)
        frame = int(min(max(frame, self._least), self._most))
        if frame != self._frame and self._drag.open:
            self._frame = frame
            self._drag.apply(move_keyframe, self._layer_id, self._key, frame)
            self._workspace.playhead.move_to(frame)

    def finish(self) -> None:
        """Keep it there, as one undo step."""
        if self._drag is not None:
            self._drag.commit()

    def cancel(self) -> None:
        """Put it back."""
        if self._drag is not None and self._drag.open:
            self._drag.abandon()
            self._workspace.playhead.move_to(self._start)


class KeyCopy:
    """Puts a copy of a keyframe at a frame that is free; the playhead goes with it."""

    def __init__(self, workspace: Workspace, view: TimeView, place: Place, x: float) -> None:
        self._workspace, self._view = workspace, view
        self._layer_id, key = place
        self._layer = workspace.session.document.layer(self._layer_id)
        self._copied = self._layer.keyframes[key]
        self._grabbed = x
        text = QCoreApplication.translate("Timeline", "Copy keyframe")
        self._drag = workspace.session.begin(text)

    def move(self, x: float, modifiers: Qt.KeyboardModifier) -> None:
        """Follow the mouse, but not to other keys; back where it began there is no copy."""
        if not self._drag.open:
            return
        frame = self._copied.frame + round((x - self._grabbed) / self._view.scale.pixels)
        frame = max(frame, self._workspace.playhead.lowest)
        if frame == self._copied.frame:
            self._drag.apply(lambda document: document)
        elif self._layer.key_at(frame) is None:
            copy = Keyframe(frame, self._copied.outline, self._copied.marks)
            self._drag.apply(insert_keyframe, self._layer_id, copy)
        else:
            return
        self._go_to(frame)

    def finish(self) -> None:
        """Keep it there, as one undo step."""
        self._drag.commit()

    def cancel(self) -> None:
        """Take it away."""
        if self._drag.open:
            self._drag.abandon()
            self._go_to(self._copied.frame)

    def _go_to(self, frame: int) -> None:
        """Choose the key at a frame, and go there."""
        self._workspace.playhead.move_to(frame)
        self._workspace.selection.select_key_at(frame)


class RangeDrag:
    """Moves one end of the playback range."""

    def __init__(self, workspace: Workspace, view: TimeView, end: int) -> None:
        self._playhead, self._view, self._end = workspace.playhead, view, end
        self._before = self._playhead.range if self._playhead.limited else None

    def move(self, x: float, modifiers: Qt.KeyboardModifier) -> None:
        """Follow the mouse, up to the other end."""
        frame = round(self._view.scale.frame(x))
        first, last = self._playhead.range
        if self._end == 0:
            self._playhead.set_range((min(frame, last), last))
        else:
            self._playhead.set_range((first, max(frame, first)))

    def finish(self) -> None:
        """Keep it."""

    def cancel(self) -> None:
        """Go back to the range before."""
        self._playhead.set_range(self._before)


class Pan:
    """Shifts the part of time that is shown."""

    def __init__(self, view: TimeView, x: float) -> None:
        self._view, self._x, self._moved = view, x, 0.0

    def move(self, x: float, modifiers: Qt.KeyboardModifier) -> None:
        """Follow the mouse."""
        self._view.pan(x - self._x)
        self._moved += x - self._x
        self._x = x

    def finish(self) -> None:
        """Stay there."""

    def cancel(self) -> None:
        """Go back."""
        self._view.pan(-self._moved)
