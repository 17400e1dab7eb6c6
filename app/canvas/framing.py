"""Where the camera looks so that everything is seen."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF

from app.canvas.camera import Camera
from app.canvas.panes import Panes
from app.canvas.tools.transform_box import TransformBox
from app.document.session import Session


class Framing:
    """Frames the artboard or the drawing, in all panes alike."""

    def __init__(self, camera: Camera, session: Session, panes: Panes) -> None:
        self._camera, self._session, self._panes = camera, session, panes

    def fit(self) -> None:
        """Show the whole artboard in each pane, and all that was drawn beyond it."""
        board = QRectF(0, 0, *self._session.document.size)
        self._camera.fit(board.united(self._drawn()), self._panes.room)

    def fit_again(self) -> None:
        """Fit, as long as the artist has neither zoomed nor panned."""
        if self._camera.fitted:
            self.fit()

    def show_drawing(self) -> None:
        """Show everything that was drawn as large as each pane allows."""
        drawn = self._drawn()
        if not drawn.isEmpty():
            self._camera.show(drawn, self._panes.room)

    def show_pixels(self) -> None:
        """Show one document unit as one pixel."""
        self._camera.zoom_to(self._camera.centre, 1.0)

    def _drawn(self) -> QRectF:
        """Return what all keyframes of all layers cover."""
        bounds = QRectF()
        for layer in self._session.document.layers:
            for keyframe in layer.keyframes:
                box = TransformBox.around(keyframe.outline)
                bounds = bounds.united(QRectF(QPointF(*box.low), QPointF(*box.high)))
        return bounds
