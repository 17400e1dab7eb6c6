"""SVG pictures: one path a layer, filled by the even-odd rule."""

from __future__ import annotations

import re
from pathlib import Path
from xml.sax.saxutils import escape

from core.io.exporters.film import Size
from core.io.exporters.sequence import SequenceFormat
from core.io.replacing import replacing
from core.model.outline import Array
from core.model.picture import Picture, Shape

_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def write_picture(picture: Picture, path: Path, size: Size | None = None) -> None:
    """Write a picture, fitted into a size in pixels; without one it has the document's."""
    with replacing(path, flush=False) as draft:
        draft.write_text(drawing(picture, size), encoding="utf-8")


def drawing(picture: Picture, size: Size | None = None) -> str:
    """Return a picture as the text of an SVG file."""
    width, height = picture.size
    shown_width, shown_height = size or (max(round(width), 1), max(round(height), 1))
    # the picture keeps its proportions; the background fills what is left at two sides
    scale = min(shown_width / width, shown_height / height)
    view = (shown_width / scale, shown_height / scale)
    left, top = (width - view[0]) / 2, (height - view[1]) / 2
    box = f"{left:.7g} {top:.7g} {view[0]:.7g} {view[1]:.7g}"
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{shown_width}" height="{shown_height}"'
        f' viewBox="{box}">'
    ]
    if picture.background:
        lines.append(
            f'<rect x="{left:.7g}" y="{top:.7g}" width="{view[0]:.7g}" height="{view[1]:.7g}"'
            f"{_paint('fill', picture.background)}/>"
        )
    lines += [_path(shape) for shape in picture.shapes]
    return "\n".join([*lines, "</svg>", ""])


def _path(shape: Shape) -> str:
    style = shape.style
    paint = _paint("fill", style.fill)
    if style.stroke and style.stroke_width > 0:
        paint += (
            f'{_paint("stroke", style.stroke)} stroke-width="{style.stroke_width:.7g}"'
            ' stroke-linejoin="round"'
        )
    title = escape(_NOT_XML.sub("", shape.name))
    outline = " ".join(_closed(ring) for ring in shape.rings)
    return f'<path d="{outline}" fill-rule="evenodd"{paint}><title>{title}</title></path>'


def _closed(ring: Array) -> str:
    return "M" + " ".join(f"{x:.7g},{y:.7g}" for x, y in ring.tolist()) + "Z"


def _paint(what: str, colour: str) -> str:
    """Write a colour as an attribute; opacity goes apart, as SVG 1.1 asks."""
    if not colour:
        return f' {what}="none"'
    opacity = f' {what}-opacity="{int(colour[7:], 16) / 255:.4g}"' if colour[7:] else ""
    return f' {what}="{colour[:7]}"{opacity}'


SVG = SequenceFormat("svg", "SVG sequence", ".svg", write_picture)
