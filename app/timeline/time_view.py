"""The part of time that the timeline shows, shared by ruler and tracks."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from app.timeline.scale import TimeScale
from app.workspace import Workspace

SHORTEST = 24
"""Frames shown at least when all is fitted in, so that a new key finds room."""


class TimeView(QObject):
    """Holds the scale. It fits everything in until the artist zooms or pans."""

    changed = Signal()

    def __init__(self, workspace: Workspace, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self._scale = TimeScale()
        self._width = 600.0
        self._fitted = True
        workspace.session.replaced.connect(self.fit)
        workspace.session.changed.connect(self._keep_fitted)
        workspace.playhead.moved.connect(self._follow)

    @property
    def scale(self) -> TimeScale:
        """Which frame lies at which pixel."""
        return self._scale

    @property
    def width(self) -> float:
        """How many pixels there are."""
        return self._width

    def set_width(self, width: float) -> None:
        """Note how many pixels there are."""
        self._width = width
        if self._fitted:
            self.fit()

    def fit(self) -> None:
        """Show every keyframe, the playback range and the playhead."""
        playhead = self._workspace.playhead
        frames = (*self._workspace.session.document.frames, *playhead.range, playhead.frame)
        first, last = min(frames), max(frames)
        self._set(TimeScale.fitted(first, max(last, first + SHORTEST - 1), self._width))
        self._fitted = True

    def zoom(self, factor: float, x: float) -> None:
        """Zoom at a pixel."""
        self._fitted = False
        self._set(self._scale.zoomed(factor, x))

    def pan(self, dx: float) -> None:
        """Shift by so many pixels to the right."""
        self._fitted = False
        self._set(self._scale.panned(dx))

    def _keep_fitted(self) -> None:
        """Find room for new keys; but a key that is dragged stays under the mouse."""
        if self._fitted and not self._workspace.session.dragging:
            self.fit()

    def _follow(self, frame: float) -> None:
        self._set(self._scale.showing(frame, self._width))

    def _set(self, scale: TimeScale) -> None:
        if scale != self._scale:
            self._scale = scale
            self.changed.emit()
