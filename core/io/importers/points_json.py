"""Point lists as JSON.

``[[x, y], …]``, a list of such rings, or an object that holds either under ``points`` or
``rings``.
"""

from __future__ import annotations

import json
from typing import Any

from core.errors import FileError
from core.io.importers.part import Part, Warn
from core.io.importers.points import Points, parts_of
from core.model.structure import FARTHEST

EXPECTED = 'Expected [[x, y], …], a list of such rings, {"points": …} or {"rings": …}.'


def read(data: bytes, name: str, warn: Warn) -> list[Part]:
    """Return the polygons of a point list."""
    try:
        content = json.loads(data)
    except json.JSONDecodeError as error:
        what = f"Line {error.lineno}, column {error.colno}: {error.msg}."
        raise FileError(what) from error
    except (ValueError, RecursionError) as error:
        raise FileError("This is not JSON.") from error
    path = ""
    if isinstance(content, dict):
        path = next((key for key in ("rings", "points") if key in content), "")
        content = content.get(path)
    if not isinstance(content, list) or not content:
        raise FileError(EXPECTED)
    if _holds_rings(content):
        return parts_of([_ring(ring, f"{path}[{i}]") for i, ring in enumerate(content)], name)
    return parts_of([_ring(content, path)], name)


def _holds_rings(content: list[Any]) -> bool:
    """Whether a list is one of rings rather than of points, right or wrong."""
    first = content[0]
    return isinstance(first, list) and bool(first) and isinstance(first[0], list)


def _ring(content: Any, path: str) -> Points:
    if not isinstance(content, list):
        raise FileError(f"{path}: expected a list of points. {EXPECTED}")
    for i, point in enumerate(content):
        if not _is_point(point):
            raise FileError(f"{path}[{i}]: expected a point [x, y], found {_short(point)}.")
    return [(float(x), float(y)) for x, y in content]


def _is_point(value: Any) -> bool:
    return (
        isinstance(value, list)
        and len(value) == 2
        and all(isinstance(v, int | float) and not isinstance(v, bool) for v in value)
        and all(abs(v) <= FARTHEST for v in value)  # nor is NaN
    )


def _short(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 40 else f"{text[:37]}…"
