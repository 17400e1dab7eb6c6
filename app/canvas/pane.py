"""A pane: a title that says what is seen, and a view with everything that is painted in it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QVBoxLayout, QWidget

from app.canvas.artboard import Artboard
from app.canvas.artwork import Artwork
from app.canvas.camera import Camera
from app.canvas.error_ring import ErrorRing, places_of
from app.canvas.header import Header
from app.canvas.invitation import Invitation
from app.canvas.marks_overlay import MarksOverlay
from app.canvas.mesh_overlay import MeshOverlay
from app.canvas.moment import Moment, Role, edited_key, picture_on_screen
from app.canvas.onion import OnionSkin, ghosts_at
from app.canvas.overlay import ToolOverlay
from app.canvas.pins import NO_PINS, pins_between, pins_on_key
from app.canvas.suggestions_overlay import SuggestedPins, SuggestionsOverlay
from app.canvas.trouble_rings import TroubleRings
from app.canvas.view import View
from app.jobs.solver import SpanState
from app.style import colours
from app.workspace import Workspace
from core.errors import Trouble
from core.model import Keyframe

if TYPE_CHECKING:
    from app.canvas.tools.tool import Tool

DIMMED = 0.22
"""Opacity of the layers that are not being edited, in the panes of keys."""
STALE = 0.55
"""Opacity of an in-between that does not match the document yet."""


class Pane(QWidget):
    """Shows one side of a moment: a keyframe of the current layer, or the in-between of all."""

    def __init__(self, role: Role, workspace: Workspace, camera: Camera, parent: QWidget) -> None:
        super().__init__(parent)
        self.role = role
        self._workspace = workspace
        self._header, self.view = Header(self), View(self, camera)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._header)
        column.addWidget(self.view, 1)
        self._board, self._onion, self.artwork = Artboard(), OnionSkin(), Artwork()
        for z, item in enumerate((self._board, self._onion, self.artwork)):
            self.view.add_artwork(item, z)
        self._mesh = MeshOverlay(self.view, 5)
        self.suggested = SuggestedPins()
        """The suggested marks that are seen here: of a key, or in the overlay of both."""
        self.invitation, self.tool_overlay = Invitation(self.view), ToolOverlay(self.view)
        self._suggestions, self._marks = SuggestionsOverlay(self.view), MarksOverlay(self.view)
        self.trouble_rings, self.error_ring = TroubleRings(self.view), ErrorRing(self.view)
        overlays = (
            self.invitation,
            self.trouble_rings,
            self._suggestions,
            self._marks,
            self.tool_overlay,
            self.error_ring,
        )
        for z, item in enumerate(overlays):
            self.view.add_overlay(item, 10 + z)

    @property
    def live(self) -> bool:
        """Whether the pane follows the playhead within a span."""
        return self.role in (Role.IN_BETWEEN, Role.OVERLAY)

    # -- what tools ask ------------------------------------------------------------------------

    @property
    def key(self) -> int | None:
        """Index of the keyframe that is edited here; None in the in-between."""
        return edited_key(self._workspace, self.role)

    @property
    def keyframe(self) -> Keyframe | None:
        """The keyframe that is edited here."""
        layer, key = self._workspace.selection.layer, self.key
        return None if layer is None or key is None else layer.keyframes[key]

    @property
    def tint(self) -> str:
        """The colour of outlines edited here: that of the side they are on."""
        key = self.key
        layer = self._workspace.selection.layer
        if layer is None or key is None:
            return colours().accent
        span, _ = layer.span_at(self._workspace.playhead.frame)
        return colours().source if key <= span else colours().target

    @property
    def state(self) -> str:
        """What the title says about being up to date; empty when there is nothing to say."""
        return self._header.tag

    def follow(self, tool: Tool, *, repaint: bool) -> None:
        """Show what the tool in hand has changed about itself."""
        self.view.rest_cursor(tool.cursor)
        self.tool_overlay.tool = tool
        at_rest = not self._workspace.playhead.playing or (tool.aims and not self.live)
        for item in (self.tool_overlay, self._suggestions, self._marks):
            # what plays is looked at, not worked on
            item.setVisible(at_rest or tool.busy)
        self._marks.stand_back(not tool.places_marks)
        if repaint:
            self.tool_overlay.update()
        self.invitation.make_room(tool.busy)

    def set_focused(self, focused: bool) -> None:
        """Show whether the keys go here."""
        self._header.set_focused(focused)

    # -- what the canvas shows -----------------------------------------------------------------

    def look(self, moment: Moment, error: Trouble | None) -> None:
        """Show a moment, and the place of an error if there is one."""
        self._name(moment)
        self._board.show_board(moment.document.size, moment.document.background)
        self._show_artwork(moment)
        self._show_onion(moment)
        self._show_mesh(moment)
        self._show_marks(moment)
        self._show_suggestions()
        self._show_error(moment, error)
        self._show_trouble(moment)
        self.invitation.show_text(*self._invite(moment), moment.document.background)
        self.view.update_all()

    def _show_artwork(self, moment: Moment) -> None:
        keyframe = None if self.live else self.keyframe
        frame = moment.frame if keyframe is None else keyframe.frame
        picture = picture_on_screen(self._workspace, frame)
        if self.live:
            opacities = dict.fromkeys(moment.stale, STALE)
            self.artwork.show_shapes(picture.shapes, opacities)
        elif keyframe is None:
            self.artwork.show_shapes((), {})
        else:
            assert moment.layer is not None
            others = {s.layer_id: DIMMED for s in picture.shapes if s.layer_id != moment.layer.id}
            self.artwork.show_shapes(picture.shapes, others)

    def _show_onion(self, moment: Moment) -> None:
        wanted = self._workspace.view.onion and not self._workspace.playhead.playing
        keys = moment.layer.keyframes if moment.layer and self.live and wanted else ()
        self._onion.show_ghosts(ghosts_at(moment.frame, keys, self._workspace.view))

    def _show_mesh(self, moment: Moment) -> None:
        if not self._workspace.view.mesh or moment.morph is None or moment.layer is None:
            self._mesh.hide()
            return
        morph = moment.morph
        ends = {Role.SOURCE: morph.rest, Role.TARGET: morph.target}
        positions = ends.get(self.role, moment.positions)
        self._mesh.show_mesh(morph.triangles, positions, moment.layer.style.fill)

    def _show_marks(self, moment: Moment) -> None:
        layer, keyframe = moment.layer, self.keyframe
        selected = self._workspace.selection.mark
        if not self._workspace.view.marks or layer is None:
            self._marks.show_marks((), NO_PINS, None)
        elif keyframe is not None:
            self._marks.show_marks(layer.labels, pins_on_key(keyframe), selected)
        elif self.role is Role.IN_BETWEEN and moment.morph is not None:
            source = layer.keyframes[moment.span]
            pins = pins_between(source, moment.morph, moment.positions)
            self._marks.show_marks(layer.labels, pins, selected)
        else:
            self._marks.show_marks((), NO_PINS, None)

    def _show_suggestions(self) -> None:
        suggestions, layer = self._workspace.suggestions, self._workspace.selection.layer
        shown, span = suggestions.shown, suggestions.span
        self.suggested, marks = SuggestedPins(), NO_PINS
        if layer is not None and shown and self.role is not Role.IN_BETWEEN:
            keys = {Role.SOURCE: [span], Role.TARGET: [span + 1]}.get(self.role, [span, span + 1])
            keys.sort(key=lambda key: key != self.key)  # numbers go to the one that is edited
            self.suggested = SuggestedPins.on(layer, keys, shown, suggestions.current)
            marks = pins_on_key(layer.keyframes[keys[0]])
        self._suggestions.show_suggestions(self.suggested, marks)

    def _show_error(self, moment: Moment, error: Trouble | None) -> None:
        keyframe = self.keyframe
        side = error.where.side if error else ""
        if error is None or keyframe is None or (side and side != self._side(moment)):
            self.error_ring.hide()
        else:
            self.error_ring.show_error(places_of(error.where, keyframe), error)

    def _show_trouble(self, moment: Moment) -> None:
        playing = self._workspace.playhead.playing
        known = self.live and not playing and moment.trouble is not None
        self.trouble_rings.show_places(moment.trouble if known else NO_PINS.places)

    def _side(self, moment: Moment) -> str:
        """Return which side of the span the key shown here is on."""
        assert self.key is not None
        return "source" if self.key <= moment.span else "target"

    # -- words ---------------------------------------------------------------------------------

    @property
    def title(self) -> str:
        """What the pane shows, in words."""
        return self.view.accessibleName()

    def _name(self, moment: Moment) -> None:
        """Set the title: which key or which in-between, and whether it is up to date."""
        spanned = moment.layer is not None and moment.layer.spans > 0
        live = self.live
        name = {
            Role.SOURCE: self.tr("Source"),
            Role.IN_BETWEEN: self.tr("In-between"),
            Role.TARGET: self.tr("Target"),
            Role.OVERLAY: self.tr("Overlay"),
        }[self.role]
        frame, keyframe = self.tr("frame {frame}"), self.keyframe
        details = []
        if live:
            details.append(frame.format(frame=f"{moment.frame:.5g}"))
        if live and spanned:
            details.append(self.tr("t {t}").format(t=f"{moment.t:.2f}"))
        if keyframe and self.role is Role.OVERLAY:
            details.append(self.tr("editing frame {frame}").format(frame=keyframe.frame))
        elif keyframe:
            details.append(frame.format(frame=keyframe.frame))
        tag = ""
        if live and moment.layer is not None and not moment.layer.visible:
            tag = self.tr("layer is hidden")
        elif live and spanned:
            tag = self._state_text(moment)
        tints = {Role.SOURCE: colours().source, Role.TARGET: colours().target}
        tint = tints.get(self.role, colours().muted)
        self._header.show_title(name, " · ".join(details), tag, tint)
        self.view.setAccessibleName(" · ".join([name, *details]))

    def _state_text(self, moment: Moment) -> str:
        updating = self.tr("updating…")
        return {
            SpanState.SOLVED: updating if moment.late else "",
            SpanState.SOLVING: updating,
            SpanState.FAILED: self.tr("not solved"),
            SpanState.NONE: self.tr("not up to date"),
        }[moment.state]

    def _invite(self, moment: Moment) -> tuple[str, str]:
        """Return what an empty pane says."""
        nothing = ("", "")
        draw = self.tr("P pen · B freehand — or drop an SVG")
        if moment.layer is None:
            return {
                Role.SOURCE: (self.tr("Draw the source outline here"), draw),
                Role.OVERLAY: (self.tr("Draw the source outline here"), draw),
                Role.IN_BETWEEN: (
                    self.tr("In-betweens appear here"),
                    self.tr("as soon as there are two outlines"),
                ),
                Role.TARGET: (self.tr("Then the target"), self.tr("the pose to arrive at")),
            }[self.role]
        if self.role is Role.TARGET and self.key is None:
            return self.tr("Draw or import the target here"), draw
        return nothing
