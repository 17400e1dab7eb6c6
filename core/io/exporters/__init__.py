"""Frames to files: one module a format, behind this registry.

PNG and animations need Qt to paint; ``app.render.formats`` adds them.
"""

from core.io.exporters.film import LONGEST_SIDE, Film, MovingMesh, Size
from core.io.exporters.sequence import SequenceFormat
from core.io.exporters.svg import SVG
from core.io.exporters.vertices import VERTICES, VertexFormat

ExportFormat = SequenceFormat | VertexFormat
FORMATS: tuple[ExportFormat, ...] = (SVG, VERTICES)

__all__ = [
    "FORMATS",
    "LONGEST_SIDE",
    "SVG",
    "VERTICES",
    "ExportFormat",
    "Film",
    "MovingMesh",
    "SequenceFormat",
    "Size",
]
