"""Copy and paste: keyframes go to other frames, layers and projects; drawings come from outside."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QMimeData, QObject, Signal
from PySide6.QtGui import QGuiApplication

from app.commands import Commands
from app.files.files import Files
from app.workspace import Workspace
from core.geometry.flatten import flatten
from core.io.exporters.svg import drawing
from core.model import Document, Keyframe, Layer
from core.model.edits import add_layer, remove_keyframe, update_layer
from core.model.picture import Picture, Shape
from core.morph.edits import paste_key

SVG = "image/svg+xml"


@dataclass(frozen=True)
class _Copied:
    """A keyframe, and the layer it is from."""

    layer: Layer
    keyframe: Keyframe
    text: str
    """What other programs get of it."""


class Clipboard(QObject):
    """Holds the keyframe that was copied last, and shares it with other programs as SVG."""

    noted = Signal(str)
    """What was copied, or why nothing was pasted."""

    def __init__(
        self, workspace: Workspace, commands: Commands, files: Files, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._workspace, self._commands, self._files = workspace, commands, files
        self._copied: _Copied | None = None

    def copy(self) -> None:
        """Copy the current keyframe."""
        selection = self._workspace.selection
        layer, keyframe = selection.layer, selection.keyframe
        if layer is None or keyframe is None:
            return
        document = self._workspace.session.document
        text = _as_svg(document, layer, keyframe)
        self._copied = _Copied(layer, keyframe, text)
        data = QMimeData()
        data.setText(text)
        data.setData(SVG, text.encode())
        QGuiApplication.clipboard().setMimeData(data)
        told = self.tr("Copied frame {frame} of “{name}”. Ctrl+V puts it where the playhead is.")
        self.noted.emit(told.format(frame=keyframe.frame, name=layer.name))

    def cut(self) -> None:
        """Copy the current keyframe and delete it, wherever the playhead is."""
        self.copy()
        layer, key = self._commands.unlocked(), self._workspace.selection.key
        self._workspace.session.apply(self.tr("Cut keyframe"), remove_keyframe, layer.id, key)

    def paste(self) -> None:
        """Put the copied keyframe at the playhead, or import a drawing from another program."""
        data = QGuiApplication.clipboard().mimeData()
        text = bytes(data.data(SVG).data()).decode(errors="replace") or data.text()
        if self._copied is not None and text == self._copied.text:
            self._paste(self._copied)
        elif "<svg" in text:
            self._files.import_drawing(text.encode())
        else:
            told = self.tr("There is nothing to paste: copy a keyframe, or a drawing as SVG.")
            self.noted.emit(told)

    def _paste(self, copied: _Copied) -> None:
        session, selection = self._workspace.session, self._workspace.selection
        frame = max(round(self._workspace.playhead.frame), 1)
        text = self.tr("Paste keyframe")
        if selection.layer is None:
            if session.apply(text, _as_layer, copied.layer, copied.keyframe, frame):
                selection.select_layer(session.document.layers[-1].id)
            return
        layer = self._commands.unlocked()
        session.apply(text, paste_key, layer.id, frame, copied.keyframe, copied.layer.labels)
        selection.select_key_at(frame)


def _as_layer(document: Document, layer: Layer, keyframe: Keyframe, frame: int) -> Document:
    """Add a layer with one keyframe that looks as it did in another."""
    document = add_layer(document, layer.name, frame, keyframe.outline)
    return update_layer(document, document.layers[-1].id, style=layer.style)


def _as_svg(document: Document, layer: Layer, keyframe: Keyframe) -> str:
    rings = tuple(line.points for line in flatten(keyframe.outline))
    shape = Shape(layer.id, layer.name, layer.style, rings)
    return drawing(Picture(keyframe.frame, document.size, "", (shape,)))
