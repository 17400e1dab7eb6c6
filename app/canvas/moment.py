"""What the artist looks at: the current layer's span under the playhead, and how it stands."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from app.jobs.frames import Shown
from app.jobs.solver import SpanState
from app.workspace import Workspace
from core.model import Document, Layer
from core.model.outline import Array
from core.model.picture import Picture
from core.morph.scene import Span, carrying, picture_at, span_of

if TYPE_CHECKING:
    from core.morph.morph import Morph


class Role(Enum):
    """What a pane is for."""

    SOURCE = "source"
    IN_BETWEEN = "in-between"
    TARGET = "target"
    OVERLAY = "overlay"


@dataclass(frozen=True, eq=False)
class Moment:
    """One look at the workspace, taken once for all panes."""

    document: Document
    frame: float
    layer: Layer | None
    span: int = 0
    t: float = 0.0
    s: float = 0.0
    """Progress in time and in shape."""
    morph: Morph | None = None
    positions: Array | None = None
    """(n, 2) vertices of the current layer's mesh, as they are on screen."""
    state: SpanState = SpanState.NONE
    late: bool = False
    """Whether the current layer's in-between is still to be made, and the one nearest is seen."""
    stale: frozenset[int] = frozenset()
    """Layers whose in-between on screen is not what the document says by now."""
    trouble: Array | None = None
    """(k, 2) where the in-between folds or crosses itself, as far as it was looked at."""


def moment_of(workspace: Workspace, *, patient: bool = False) -> Moment:
    """Take a look; a patient one takes what will be there in a moment for what it shows now."""
    document, now = workspace.session.document, workspace.playhead.frame
    frame = document.drawn_at(now)
    layer = workspace.selection.layer

    def state_of(layer: Layer, span: int) -> SpanState:
        state = workspace.solver.state(layer.id, span)
        return SpanState.SOLVED if patient and state is SpanState.SOLVING else state

    late = {other.id for other in document.moving if _late(workspace, other, frame)}
    stale = {
        other.id
        for other in document.layers
        if other.progress_at(frame)[1] not in (0.0, 1.0)  # an easing may also overshoot
        and state_of(other, other.span_at(frame)[0]) is not SpanState.SOLVED
    }
    stale = frozenset(stale if patient else stale | late)

    def astray(carrier: Layer) -> bool:
        """Whether what hangs on a layer may be elsewhere: it is followed through all spans."""
        return carrier.id in stale or any(
            state_of(carrier, span) is not SpanState.SOLVED
            for span in range(carrier.spans)
            if not carrier.easing_of(span).hold
        )

    hanging = [other for other in document.layers if other.key_at(frame) is None]
    stale |= {other.id for other in hanging if any(map(astray, document.carriers(other)))}
    if layer is None or not layer.spans:
        return Moment(document, now, layer, stale=stale)
    span, t = layer.span_at(frame)
    s = layer.progress_at(frame)[1]
    morph = workspace.solver.morph_of(span_of(layer, span))
    moved = carrying(document, shown_by(workspace))(layer, frame)
    positions = None if morph is None else moved(workspace.frames.at(morph, s))
    known = frame.is_integer() and layer.id not in late
    check = workspace.inspector.frame_check(layer.id, frame) if known else None
    return Moment(
        document,
        now,
        layer,
        span,
        t,
        s,
        morph,
        positions,
        state_of(layer, span),
        layer.id in late,
        stale,
        None if check is None else moved(check.places),
    )


def _late(workspace: Workspace, layer: Layer, frame: float) -> bool:
    """Return whether a layer's in-between, or that of what it hangs on, is still to be made."""
    if layer.carrier is not None:
        carrier = workspace.session.document.layer(layer.carrier)
        if _late(workspace, carrier, frame):
            return True
    if not layer.spans:
        return False
    index, s = layer.progress_at(frame)
    morph = workspace.solver.morph_of(span_of(layer, index))
    return morph is not None and workspace.frames.exact(morph, s) is None


def picture_on_screen(workspace: Workspace, frame: float) -> Picture:
    """Return the visible layers at a frame, as far as they are there."""
    return picture_at(workspace.session.document, frame, shown_by(workspace))


def shown_by(workspace: Workspace) -> Callable[[Span], Shown | None]:
    """Return what looks up what is there of a span."""

    def shown(span: Span) -> Shown | None:
        morph = workspace.solver.morph_of(span)
        return None if morph is None else Shown(morph, workspace.frames)

    return shown


def keys_in_view(layer: Layer, frame: float) -> range:
    """Return which keyframes of a layer are seen at a frame: both ends of the span there."""
    span, _ = layer.span_at(frame)
    return range(span, len(layer.keyframes))[:2]


def nearest_in_view(layer: Layer, frame: float) -> int:
    """Return which of the keyframes that are seen at a frame is nearer to it."""
    return keys_in_view(layer, frame)[round(layer.span_at(frame)[1])]


def edited_key(workspace: Workspace, role: Role) -> int | None:
    """Return the keyframe of the current layer that the tools change in a pane, if any.

    In the overlay it is the key under the playhead, or else the one of the span around it that is
    selected, or else the nearer one.
    """
    layer, frame = workspace.selection.layer, workspace.playhead.frame
    if layer is None or role is Role.IN_BETWEEN:
        return None
    seen = keys_in_view(layer, frame)
    if role is not Role.OVERLAY:
        key = seen[0] + (role is Role.TARGET)
        return key if key in seen else None
    here, selected = layer.key_at(frame), workspace.selection.key
    if here is not None:
        return here
    return selected if selected in seen else nearest_in_view(layer, frame)
