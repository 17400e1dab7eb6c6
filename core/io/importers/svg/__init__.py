"""SVG drawings: paths and basic shapes, with transforms, styles and holes; Béziers are kept."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

from core.errors import FileError
from core.io.importers.nesting import Rule, group_rings
from core.io.importers.part import MAX_NODES, Part, Warn, numbered, uniquely_named
from core.io.importers.svg.curves import rings_of
from core.io.importers.svg.survey import NAME, survey
from core.model import Style
from core.model.structure import MOST_SIDE

if TYPE_CHECKING:
    from svgelements import Color, Shape

PIXELS_PER_INCH = 96
BROKEN = (ValueError, ArithmeticError, LookupError, AttributeError, TypeError)
"""What the parser raises on data that makes no sense."""


def read(data: bytes, name: str, warn: Warn) -> list[Part]:
    """Return the shapes of a drawing that are shown, in drawing order."""
    import svgelements

    try:
        drawing = svgelements.SVG.parse(
            io.BytesIO(survey(data, name, warn)), reify=False, ppi=PIXELS_PER_INCH
        )
        shapes = [e for e in drawing.elements() if isinstance(e, svgelements.Shape)]
    except RecursionError as error:
        raise FileError("The drawing is nested too deeply.") from error
    except BROKEN as error:
        raise FileError(f"The drawing cannot be understood ({error}).") from error
    parts = [part for shape in shapes if _visible(shape) for part in _parts(shape, warn)]
    if sum(len(ring) for part in parts for ring in part.outline.rings) > MAX_NODES:
        raise FileError(f"The drawing has more than {MAX_NODES} nodes.")
    return uniquely_named(parts)


def _parts(shape: Shape, warn: Warn) -> list[Part]:
    from svgelements import Path

    name = shape.values["attributes"].get(NAME, type(shape).__name__.lower())
    try:
        path = Path(shape)
        rings, opened = rings_of(path)
        style = _style(path)
    except BROKEN as error:
        why = f" ({error})" if isinstance(error, ValueError) else ""
        warn(f"“{name}” cannot be understood and is left out{why}.")
        return []
    if not rings:
        warn(f"“{name}” has no area and is left out.")
        return []
    if opened and style is not None and not style.fill:
        warn(f"“{name}” is an open line; it is closed by a straight edge.")
    rule: Rule = "evenodd" if shape.values.get("fill-rule") == "evenodd" else "nonzero"
    return numbered(name, group_rings(rings, rule), style)


def _visible(shape: Shape) -> bool:
    return shape.values.get("visibility", "visible") == "visible"


def _style(path: Any) -> Style | None:
    """Return how a reified path is painted; None for a shape that is not painted at all."""
    opacity = path.values.get("opacity", 1)
    fill, stroke = _colour(path.fill, opacity), _colour(path.stroke, opacity)
    if "url(" in str(path.values.get("fill")):
        fill = Style().fill
    if not fill and not stroke:
        return None
    if not stroke:
        return Style(fill, stroke)
    return Style(fill, stroke, min(max(float(path.stroke_width), 0.0), MOST_SIDE))


def _colour(colour: Color | None, opacity: Any) -> str:
    """Write a colour the way the model does."""
    if colour is None or colour.value is None:
        return ""
    alpha = round(colour.alpha * _share(opacity))
    solid = f"#{colour.red:02x}{colour.green:02x}{colour.blue:02x}"
    return solid if alpha == 255 else f"{solid}{alpha:02x}"


def _share(opacity: Any) -> float:
    """Return a number or a percentage as one in [0, 1]; 1 for what is neither."""
    text = str(opacity).strip()
    try:
        share = float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
    except ValueError:
        return 1.0
    return max(0.0, min(1.0, share))  # in this order 1 for NaN
