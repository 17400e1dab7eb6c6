"""What can be done with keys and spans, by mouse, keyboard or menu alike."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from app.timeline.rows import Place
from app.workspace import Workspace
from core.model import Easing
from core.model.edits import move_keyframe, set_easing, set_passing


def _tr(text: str) -> str:
    return QCoreApplication.translate("Timeline", text)


def nudge_key(workspace: Workspace, frames: int) -> None:
    """Move the chosen key in time; nudges in a row are one undo step."""
    layer = workspace.selection.layer
    if layer is None:
        return
    key = workspace.selection.key
    least, most = layer.room(key)
    least = max(least, workspace.playhead.lowest)
    frame = min(max(layer.keyframes[key].frame + frames, least), most)
    gesture = ("nudge", layer.id, key)
    text, move = _tr("Move keyframe"), (layer.id, key, int(frame))
    if workspace.session.amend(gesture, text, move_keyframe, *move):
        workspace.playhead.move_to(frame)


def ease(workspace: Workspace, place: Place, easing: Easing) -> None:
    """Set the timing of a span."""
    workspace.session.apply(_tr("Change easing"), set_easing, *place, easing)


def let_pass(workspace: Workspace, place: Place, passes: bool) -> None:
    """Let the motion pass through a key, or end there and start anew."""
    text = _tr("Pass through keyframe") if passes else _tr("End motion at keyframe")
    workspace.session.apply(text, set_passing, *place, passes)


def play_only(workspace: Workspace, place: Place) -> None:
    """Limit playback to a span; if it is already, play everything again."""
    first, last = workspace.session.document.layer(place[0]).keyframes[place[1] : place[1] + 2]
    frames, playhead = (first.frame, last.frame), workspace.playhead
    alone = playhead.limited and playhead.range == frames
    playhead.set_range(None if alone else frames)


def choose_layer(workspace: Workspace, up: int) -> None:
    """Choose the layer above (1) or below (-1) the current one."""
    layers, current = workspace.session.document.layers, workspace.selection.layer
    if current is not None:
        index = min(max(layers.index(current) + up, 0), len(layers) - 1)
        workspace.selection.select_layer(layers[index].id)
