"""What the timeline says about keys and spans: in tooltips, and to screen readers."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from app.jobs.inspector import Standing
from app.timeline.rows import Place
from app.verdict import describe_span
from app.workspace import Workspace
from core.model import Easing
from core.model.easing import PRESETS


def _tr(text: str) -> str:
    return QCoreApplication.translate("Timeline", text)


def easing_name(easing: Easing) -> str:
    """Return the name of a preset, or that it is none."""
    names = (name for name, preset in PRESETS.items() if preset == easing)
    return _tr(next(names, "own easing"))


def describe_place(workspace: Workspace, key: Place | None, span: Place | None) -> str:
    """Return the tooltip for a key or else a span; empty for neither."""
    if key is not None:
        return _describe_key(workspace, key)
    return "" if span is None else _describe_span(workspace, span)


def describe_selection(workspace: Workspace) -> str:
    """Return one sentence about what is chosen."""
    layer, key = workspace.selection.layer, workspace.selection.key
    if layer is None:
        return _tr("No layers.")
    return _tr("Layer {}, keyframe {} of {}, at frame {}.").format(
        layer.name, key + 1, len(layer.keyframes), layer.keyframes[key].frame
    )


def _describe_key(workspace: Workspace, place: Place) -> str:
    layer = workspace.session.document.layer(place[0])
    head = _tr("{}: keyframe at frame {}").format(layer.name, layer.keyframes[place[1]].frame)
    if layer.passes(place[1]):
        head += "\n" + _tr("The motion passes through")
    use = _tr("Drag moves it in time, Alt+drag a copy of it; Del deletes it")
    if layer.locked:
        use = _tr("Locked")
    return f"{head}\n{use}"


def _describe_span(workspace: Workspace, place: Place) -> str:
    layer = workspace.session.document.layer(place[0])
    first, last = layer.keyframes[place[1] : place[1] + 2]
    head = _tr("{}: {} to {}, {}").format(
        layer.name, first.frame, last.frame, easing_name(first.easing)
    )
    hidden = not layer.visible and workspace.inspector.standing(*place) is Standing.NONE
    verdict = (
        _tr("Not solved while hidden.") if hidden else describe_span(workspace.inspector, *place)
    )
    return f"{head}\n{verdict}\n" + _tr("Double click to play only this")
