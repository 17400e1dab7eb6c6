"""A first look at an SVG file: what is in it, what its parts are called, and is it harmless.

The parser that follows expands every ``use``, draws symbols where they are defined, and keeps no
titles; so the tree is checked and prepared here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from core.errors import FileError
from core.io.importers.part import Warn

SVG = "{http://www.w3.org/2000/svg}"
HREFS = ("href", "{http://www.w3.org/1999/xlink}href")
LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
SHELVED = ("symbol", "mask", "marker")
"""What holds shapes that are drawn by reference only."""
SHAPES = ("path", "rect", "circle", "ellipse", "polygon", "polyline", "line")

NAME = "betwixt-name"
"""The attribute that carries a shape's name through the parser."""
MAX_ELEMENTS = 50_000
"""Elements a file may have after every ``use`` is expanded."""

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_LENGTH = re.compile(r"\s*\+?(?=[\d.]*[1-9])[\d.]")
"""The beginning of a length that is not zero."""
_UNSUPPORTED = {
    "svg": "A nested <svg> may sit at the wrong place or size.",
    "text": "Text is left out; turn it into paths first.",
    "image": "Images are left out.",
    "foreignObject": "Foreign objects are left out.",
}
_UNSUPPORTED_ATTRIBUTES = {
    "clip-path": "Clipping is ignored; whole shapes are read.",
    "mask": "Masks are ignored; whole shapes are read.",
    "filter": "Filters are ignored.",
}


def survey(data: bytes, name: str, warn: Warn) -> bytes:
    """Check an SVG file and return it with names on its shapes; FileError if it is no SVG.

    ``name`` is that of the drawing, for shapes that have none of their own.
    """
    try:
        root = ElementTree.fromstring(data)
    except ElementTree.ParseError as error:
        raise FileError(f"This is not well-formed SVG: {error}.") from error
    if root.tag not in (f"{SVG}svg", "svg"):
        raise FileError(f"This is XML, but not SVG: it begins with <{_tag(root)}>.")
    _check_budget(root)
    for warning in sorted(set(_warnings(root))):
        warn(warning)
    _name_shapes(root, name)
    _drop_broken_frame(root)
    _drop_broken_paths(root, warn)
    _shelve(root)
    return ElementTree.tostring(root)


def _warnings(root: Element) -> Iterator[str]:
    for element in root.iter():
        tag = _tag(element)
        style = element.get("style", "") + (element.text or "" if tag == "style" else "")
        if element is not root and tag in _UNSUPPORTED:
            yield _UNSUPPORTED[tag]
        if tag == "symbol" and element.get("viewBox"):
            yield "A <symbol> may sit at the wrong place or size."
        if "transform" in style or element.get("transform-origin"):
            yield "Transforms in CSS may be misplaced; use transform attributes."
        for attribute, warning in _UNSUPPORTED_ATTRIBUTES.items():
            if element.get(attribute) or f"{attribute}:" in style:
                yield warning
        if "url(" in element.get("fill", "") + element.get("stroke", "") + style:
            yield "Gradients and patterns are not read; a plain colour stands for them."


def _check_budget(root: Element) -> None:
    """Count the elements with every ``use`` expanded, without expanding any."""
    by_id = {element.get("id"): element for element in root.iter() if element.get("id")}
    counts: dict[Element, int] = {}
    open_elements: set[Element] = set()

    def count(element: Element) -> int:
        if element in open_elements:
            raise FileError("A <use> element contains itself.")
        if element not in counts:
            open_elements.add(element)
            total = 1 + sum(count(child) for child in element)
            if _tag(element) == "use":
                target = by_id.get(_href(element).removeprefix("#"))
                total += count(target) if target is not None else 0
            open_elements.discard(element)
            counts[element] = total
        return counts[element]

    if count(root) > MAX_ELEMENTS:
        raise FileError(f"The drawing has more than {MAX_ELEMENTS} elements.")


def _name_shapes(root: Element, drawing: str) -> None:
    """Name every shape by its label, title or id, or else by the drawing it is in."""
    shapes = [element for element in root.iter() if _tag(element) in SHAPES]
    for number, element in enumerate(shapes, start=1):
        title = next((child.text for child in element if _tag(child) == "title"), None)
        name = element.get(LABEL) or (title or "").strip() or element.get("id")
        element.set(NAME, name or (drawing if len(shapes) == 1 else f"{drawing} {number}"))


def _drop_broken_frame(root: Element) -> None:
    """Drop a size or a view box without extent: the parser would find nothing to draw."""
    for name in ("width", "height"):
        if not _LENGTH.match(root.get(name, "")):
            root.attrib.pop(name, None)
    *_, width, height = (*_NUMBER.findall(root.get("viewBox", "")), "0", "0")[:4]
    if not (float(width) > 0 and float(height) > 0):
        root.attrib.pop("viewBox", None)


def _drop_broken_paths(root: Element, warn: Warn) -> None:
    """Empty the paths on which the parser would give up the whole drawing."""
    from svgelements import Path

    for element in root.iter():
        if _tag(element) != "path":
            continue
        element.attrib.setdefault("d", "")
        try:
            Path(element.get("d"))
        except ValueError:
            pass  # it is drawn up to the mistake, as SVG asks
        except (ArithmeticError, LookupError, AttributeError, TypeError):
            warn(f"“{element.get(NAME)}” is no path and is left out.")
            element.set("d", "")


def _shelve(root: Element) -> None:
    """Put what is drawn by reference only on the shelf that ``defs`` are."""
    for parent in list(root.iter()):
        for i, child in enumerate(parent):
            if _tag(child) in SHELVED:
                parent[i] = Element(f"{SVG}defs")
                parent[i].append(child)


def _href(element: Element) -> str:
    return next((element.get(name, "") for name in HREFS if element.get(name)), "")


def _tag(element: Element) -> str:
    return str(element.tag).removeprefix(SVG)
