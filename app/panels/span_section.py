"""When the chosen key comes, and how the span under the playhead is timed."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QWidget

from app.fields.choice import Choice
from app.fields.number import NumberField
from app.panels.easing_editor import EasingEditor
from app.panels.section import Section
from app.workspace import Workspace
from core.model import Easing
from core.model.easing import PRESETS
from core.model.edits import move_keyframe, set_easing

MOST_FRAMES = 1_000_000


class KeyframeSection(Section):
    """The frame of the chosen keyframe."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__("", workspace, parent)
        self.frame = NumberField(self.tr("Frame of the keyframe"), 1, MOST_FRAMES)
        self.frame.setToolTip(self.tr("When the keyframe comes; between its neighbours"))
        self.frame.edited.connect(self._move)
        self.add_row(self.tr("Frame"), self.frame)

    def refresh(self) -> None:
        """Show the chosen keyframe."""
        selection = self.workspace.selection
        layer, key = selection.layer, selection.key
        self.setVisible(layer is not None)
        if layer is None:
            return
        count = len(layer.keyframes)
        self.set_title(self.tr("Keyframe {} of {}").format(key + 1, count))
        least, most = layer.room(key)
        self.frame.limit(max(least, self.workspace.playhead.lowest), min(most, MOST_FRAMES))
        self.frame.show_value(layer.keyframes[key].frame)
        self.frame.setEnabled(not layer.locked)

    def _move(self, frame: float) -> None:
        selection = self.workspace.selection
        if selection.layer is not None:
            target = (selection.layer.id, selection.key)
            gesture = (self.frame.gesture, target)
            text = self.tr("Move keyframe")
            self.workspace.session.amend(gesture, text, move_keyframe, *target, int(frame))


class SpanSection(Section):
    """The easing of the span under the playhead."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__("", workspace, parent)
        names = {name: QCoreApplication.translate("Timeline", name) for name in PRESETS}
        options = [(text.capitalize(), PRESETS[name]) for name, text in names.items()]
        self.preset = Choice(self.tr("Easing"), options)
        self.preset.setPlaceholderText(self.tr("Own curve"))
        self.preset.edited.connect(self._set_easing)
        self.curve = EasingEditor()
        self.curve.began.connect(self._begin)
        self.curve.edited.connect(self._shape)
        self.curve.ended.connect(self.end_drag)
        self.add_row(self.tr("Easing"), self.preset)
        self.add_wide(self.curve)

    def refresh(self) -> None:
        """Show the easing of the span under the playhead, and where in it the playhead is."""
        layer = self.workspace.selection.layer
        self.setVisible(layer is not None and layer.spans > 0)
        if layer is None or not layer.spans:
            return
        index, t = layer.span_at(self.workspace.playhead.frame)
        first, last = layer.keyframes[index : index + 2]
        self.set_title(self.tr("Span {} → {}").format(first.frame, last.frame))
        self.preset.show_value(first.easing)
        self.curve.show_value(first.easing)
        self.curve.show_time(t)
        for field in (self.preset, self.curve):
            field.setEnabled(not layer.locked)

    def _begin(self) -> None:
        self.workspace.session.begin(self.tr("Change easing"))

    def _set_easing(self, easing: Easing) -> None:
        self._apply(object(), easing)

    def _shape(self, easing: Easing) -> None:
        """Take a curve from the editor; steps of its keyboard in a row are one undo step."""
        self._apply(self.curve, replace(easing, hold=False))

    def _apply(self, gesture: object, easing: Easing) -> None:
        layer = self.workspace.selection.layer
        if layer is None or not layer.spans:
            return
        target = (layer.id, layer.span_at(self.workspace.playhead.frame)[0])
        text = self.tr("Change easing")
        self.workspace.session.amend((gesture, target), text, set_easing, *target, easing)
