"""The context menu of a key or a span."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtWidgets import QMenu, QWidget

from app.document.keyframes import delete_key
from app.icons import set_icon
from app.timeline import keys
from app.timeline.rows import Place
from app.workspace import Workspace
from core.model.easing import PRESETS


class TrackMenu(QMenu):
    """What can be done with a key and with the span that it begins; gone once it is closed."""

    def __init__(self, workspace: Workspace, place: Place, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        layer = workspace.session.document.layer(place[0])
        if place[1] < layer.spans:
            easing = self.addMenu(self.tr("Easing"))
            for name, preset in PRESETS.items():
                text = QCoreApplication.translate("Timeline", name).capitalize()
                action = easing.addAction(text, partial(keys.ease, workspace, place, preset))
                action.setCheckable(True)
                action.setChecked(layer.keyframes[place[1]].easing == preset)
        if layer.passable(place[1]):
            passes = layer.passes(place[1])
            through = self.addAction(
                self.tr("Pass through this key"),
                partial(keys.let_pass, workspace, place, not passes),
            )
            through.setCheckable(True)
            through.setChecked(passes)
        if place[1] < layer.spans:
            play = partial(keys.play_only, workspace, place)
            set_icon(self.addAction(self.tr("Play only this span"), play), "play")
        everything = self.addAction(
            self.tr("Play everything"), partial(workspace.playhead.set_range, None)
        )
        everything.setEnabled(workspace.playhead.limited)
        self.addSeparator()
        delete = self.addAction(
            self.tr("Delete keyframe"), partial(delete_key, workspace.session, workspace.selection)
        )
        set_icon(delete, "delete")
        delete.setEnabled(len(layer.keyframes) > 1 and not layer.locked)
