"""The document: everything the artist made, and nothing that can be computed from it."""

from __future__ import annotations

from dataclasses import dataclass

from core.model.layer import Layer


@dataclass(frozen=True)
class Document:
    """Immutable; edits (``core.model.edits``) return a new one that shares what did not change.

    y points down, units are pixels at 100 %.
    """

    layers: tuple[Layer, ...] = ()
    """Bottom first."""
    fps: float = 24.0
    size: tuple[float, float] = (960.0, 540.0)
    """Width and height of the artboard."""
    background: str = "#ffffff"
    """"#rrggbb", "#rrggbbaa", or an empty string for none."""
    hold: int = 1
    """For how many frames a drawing is held: 1 is "on ones", 2 "on twos"."""

    def layer(self, layer_id: int) -> Layer:
        """Return a layer by its id; KeyError when there is none."""
        for layer in self.layers:
            if layer.id == layer_id:
                return layer
        raise KeyError(layer_id)

    def carriers(self, layer: Layer) -> list[Layer]:
        """Return what a layer hangs on, and what that hangs on, and so forth."""
        found: list[Layer] = []
        while layer.carrier is not None:
            layer = self.layer(layer.carrier)
            found.append(layer)
        return found

    @property
    def moving(self) -> tuple[Layer, ...]:
        """The layers whose motion is seen: the visible ones, and those that carry them."""
        seen = {
            other.id
            for layer in self.layers
            if layer.visible
            for other in (layer, *self.carriers(layer))
        }
        return tuple(layer for layer in self.layers if layer.id in seen)

    def drawn_at(self, frame: float) -> float:
        """Return the frame whose drawing is held at a whole frame; other moments are their own.

        All layers change together, from frame 1 on; a key is always seen at its own frame.
        """
        if self.hold == 1 or frame != int(frame):
            return frame
        held = frame - (frame - 1) % self.hold
        keys = (key.frame for layer in self.layers for key in layer.keyframes)
        return float(max((key for key in keys if held < key <= frame), default=held))

    @property
    def frames(self) -> tuple[int, int]:
        """First and last frame that has a key; (1, 1) for an empty document."""
        frames = [key.frame for layer in self.layers for key in layer.keyframes]
        return (min(frames), max(frames)) if frames else (1, 1)
