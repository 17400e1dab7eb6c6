"""The hand: while its key is held, the left button moves the view."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, Qt

from app.canvas.camera import Camera
from app.canvas.view import View

HAND_KEYS = (Qt.Key.Key_Space, Qt.Key.Key_H)


class Hand:
    """Knows whether it is held, and whether anything was moved since."""

    def __init__(self, camera: Camera, views: Sequence[View]) -> None:
        self._camera, self._views = camera, tuple(views)
        self._start: tuple[QPointF, float] | None = None

    @property
    def held(self) -> bool:
        """Whether its key is down."""
        return self._start is not None

    def take(self) -> None:
        """Begin; a key that repeats begins only once."""
        if not self.held:
            self._start = self._camera.centre, self._camera.zoom
            self._show()

    def let_go(self) -> bool:
        """End; return whether nothing was moved, so that it was a mere tap."""
        unmoved = self._start == (self._camera.centre, self._camera.zoom)
        self._start = None
        self._show()
        return unmoved

    def _show(self) -> None:
        for view in self._views:
            view.hand = self.held
