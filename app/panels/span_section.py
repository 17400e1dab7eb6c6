"""The chosen key: when, and how it is passed; and how the span under the playhead moves."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QLabel, QWidget

from app.fields.choice import Choice
from app.fields.number import NumberField
from app.jobs.solver import SpanState
from app.panels.easing_editor import EasingEditor
from app.panels.section import Section
from app.workspace import Workspace
from core.model import Document, Easing
from core.model.easing import PRESETS
from core.model.edits import move_keyframe, set_easing, set_passing, set_turning
from core.model.structure import MAX_FRAME
from core.model.turning import MOST_TURNS, About, Direction, Path
from core.morph.scene import turn_of


class KeyframeSection(Section):
    """The frame of the chosen keyframe, and whether the motion passes through it."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__("", workspace, parent)
        self.frame = NumberField(self.tr("Frame of the keyframe"), 1, MAX_FRAME)
        self.frame.setToolTip(self.tr("When the keyframe comes; between its neighbours"))
        self.frame.edited.connect(self._move)
        self.passes = Choice(
            self.tr("Motion at the keyframe"),
            [(self.tr("Starts anew"), False), (self.tr("Passes through"), True)],
        )
        self.passes.setToolTip(
            self.tr(
                "Passes through: one velocity before and after the key, which no easing slows.\n"
                "It takes a span on either side that moves as rigidly as possible and is no hold."
            )
        )
        self.passes.edited.connect(self._pass)
        self.add_row(self.tr("Frame"), self.frame)
        self.add_row(self.tr("Motion"), self.passes)

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
        self.frame.limit(max(least, self.workspace.playhead.lowest), min(most, MAX_FRAME))
        self.frame.show_value(layer.keyframes[key].frame)
        self.frame.setEnabled(not layer.locked)
        self.passes.show_value(layer.keyframes[key].passes)
        self.passes.setEnabled(not layer.locked and layer.passable(key))

    def _pass(self, passes: bool) -> None:
        selection = self.workspace.selection
        if selection.layer is not None:
            text = self.tr("Pass through keyframe") if passes else self.tr("End motion at keyframe")
            target = (selection.layer.id, selection.key)
            self.workspace.session.apply(text, set_passing, *target, passes)

    def _move(self, frame: float) -> None:
        selection = self.workspace.selection
        if selection.layer is not None:
            target = (selection.layer.id, selection.key)
            gesture = (self.frame.gesture, target)
            text = self.tr("Move keyframe")
            self.workspace.session.amend(gesture, text, move_keyframe, *target, int(frame))


class SpanSection(Section):
    """The easing of the span under the playhead, and how its shape turns and travels."""

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
        self._make_turning_fields()
        self.add_row(self.tr("Easing"), self.preset)
        self.add_wide(self.curve)
        self.add_row(self.tr("Turn"), self.direction)
        self.add_row(self.tr("Extra turns"), self.turns)
        self.add_row(self.tr("About"), self.about)
        self.add_row(self.tr("In all"), self.angle)
        self.add_row(self.tr("Path"), self.path)

    def _make_turning_fields(self) -> None:
        self.direction = Choice(
            self.tr("Direction of turning"),
            [
                (self.tr("Shorter way"), "automatic"),
                (self.tr("Clockwise"), "clockwise"),
                (self.tr("Counter-clockwise"), "counter-clockwise"),
            ],
        )
        self.direction.setToolTip(self.tr("Which way the shape turns to the next key"))
        self.direction.edited.connect(self._set_direction)
        self.turns = NumberField(self.tr("Extra whole turns"), 0, MOST_TURNS)
        self.turns.setToolTip(
            self.tr(
                "Whole turns besides.\n"
                "A part that turns by itself, like a propeller, is a layer that hangs on another."
            )
        )
        self.turns.edited.connect(self._set_turns)
        self.about = Choice(
            self.tr("What extra turns are about"),
            [(self.tr("Its centre"), "centre"), (self.tr("Where it hangs"), "joint")],
        )
        self.about.setToolTip(
            self.tr(
                "A propeller turns about its centre; an arm or a clock's hand where it hangs.\n"
                "That is the place that stays the same from key to key on what carries it."
            )
        )
        self.about.edited.connect(self._set_about)
        self.path = Choice(
            self.tr("Path of the centre"),
            [(self.tr("Arc"), "arc"), (self.tr("Straight"), "straight")],
        )
        self.path.setToolTip(
            self.tr(
                "Arc: round the point that the shape turns and grows about, as a limb does.\n"
                "A layer that hangs on another goes where that one carries it."
            )
        )
        self.path.edited.connect(self._set_path)
        self.angle = QLabel()
        self.angle.setToolTip(
            self.tr("How far the shape turns as a whole, as seen from what it hangs on")
        )

    def refresh(self) -> None:
        """Show the span under the playhead, and where in it the playhead is."""
        layer = self.workspace.selection.layer
        self.setVisible(layer is not None and layer.spans > 0)
        if layer is None or not layer.spans:
            return
        index, t = layer.span_at(self.workspace.playhead.frame)
        first, last = layer.keyframes[index : index + 2]
        self.set_title(self.tr("Span {} → {}").format(first.frame, last.frame))
        self.preset.show_value(first.easing)
        self.curve.show_value(layer.easing_of(index))
        self.curve.show_time(t)
        self.direction.show_value(first.turning.direction)
        self.turns.show_value(first.turning.turns)
        self.about.show_value(first.turning.about)
        self.path.show_value(first.turning.path)
        for field in (self.preset, self.curve):
            field.setEnabled(not layer.locked)
        turns = not layer.locked and layer.recipe.method != "linear"
        for field in (self.direction, self.turns):
            field.setEnabled(turns)
        self.about.setEnabled(turns and layer.carrier is not None)
        self.path.setEnabled(turns and layer.carrier is None)
        self.show_angle()

    def show_angle(self) -> None:
        """Show how far the shape turns, once that is known."""
        layer = self.workspace.selection.layer
        if layer is None or not layer.spans:
            return
        index, _ = layer.span_at(self.workspace.playhead.frame)
        solver, document = self.workspace.solver, self.workspace.session.document
        solved = solver.state(layer.id, index) is SpanState.SOLVED
        angle = turn_of(document, layer, index, solver.morph_of) if solved else None
        self.angle.setText("–" if angle is None else self._turned(angle))

    def _turned(self, angle: float) -> str:
        rounded = round(math.degrees(angle))
        way = self.tr("{}° clockwise") if rounded > 0 else self.tr("{}° counter-clockwise")
        return way.format(abs(rounded)) if rounded else self.tr("no turn")

    def _begin(self) -> None:
        self.begin_drag(self.tr("Change easing"))

    def _set_easing(self, easing: Easing) -> None:
        self._apply(object(), self.tr("Change easing"), set_easing, easing)

    def _shape(self, easing: Easing) -> None:
        """Take a curve from the editor; steps of its keyboard in a row are one undo step."""
        easing = replace(easing, hold=False)
        self._apply(self.curve, self.tr("Change easing"), set_easing, easing)

    def _set_direction(self, direction: Direction) -> None:
        self._turn(object(), self.tr("Change turn"), direction=direction)

    def _set_turns(self, turns: float) -> None:
        self._turn(self.turns.gesture, self.tr("Change extra turns"), turns=int(turns))

    def _set_about(self, about: About) -> None:
        self._turn(object(), self.tr("Change extra turns"), about=about)

    def _set_path(self, path: Path) -> None:
        self._turn(object(), self.tr("Change path"), path=path)

    def _turn(self, gesture: object, text: str, **changes: Any) -> None:
        layer = self.workspace.selection.layer
        if layer is not None and layer.spans:
            index, _ = layer.span_at(self.workspace.playhead.frame)
            turning = replace(layer.keyframes[index].turning, **changes)
            self._apply(gesture, text, set_turning, turning)

    def _apply(
        self, gesture: object, text: str, edit: Callable[..., Document], value: object
    ) -> None:
        layer = self.workspace.selection.layer
        if layer is not None and layer.spans:
            target = (layer.id, layer.span_at(self.workspace.playhead.frame)[0])
            self.edit((gesture, target), text, edit, *target, value)
