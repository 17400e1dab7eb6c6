"""Point lists as text: one point a line, a blank line between rings.

Numbers are parted by commas, semicolons, tabs or spaces. Lines of words may stand before them, of
which the last may name the columns. What follows # is a comment. Where the separator is not a
comma, a decimal comma is understood.
"""

from __future__ import annotations

from codecs import BOM_UTF16_BE, BOM_UTF16_LE

from core.errors import FileError
from core.io.importers.part import Part, Warn
from core.io.importers.points import Points, parts_of
from core.model.structure import FARTHEST


def read(data: bytes, name: str, warn: Warn) -> list[Part]:
    """Return the polygons of a point list."""
    encoding = "utf-16" if data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) else "utf-8-sig"
    try:
        lines = data.decode(encoding).splitlines()
    except UnicodeDecodeError as error:
        raise FileError("This is not a text file.", hint="Save it as text in UTF-8.") from error
    return parts_of(_rings(lines), name)


def _rings(lines: list[str]) -> list[Points]:
    rings: list[list[tuple[float, float]]] = [[]]
    columns: tuple[int, int] | None = None
    named: tuple[int, int] | None = None
    for number, whole in enumerate(lines, 1):
        line, mark, _ = whole.partition("#")
        cells = _cells(line)
        if not cells:
            if not mark:
                rings.append([])
            continue
        if columns is None:
            if _is_header(cells):
                named = _named(cells)
                continue
            columns = named or (0, 1)
            if len(cells) > 2 and not named:
                raise FileError(
                    f"Line {number}: expected two numbers, found {len(cells)} columns.",
                    hint="A header line that names the columns x and y tells which to take.",
                )
        rings[-1].append(_point(cells, columns, number))
    return [ring for ring in rings if ring]


def _cells(line: str) -> list[str]:
    """Split a line; a separator at its end adds no cell."""
    line = line.strip()
    for separator in (";", "\t"):
        if separator in line:
            cells = line.split(separator)
            break
    else:
        if "," in line and not _decimal_commas(line):
            cells = line.split(",")
        else:
            return [cell.replace(",", ".") for cell in line.split()]
        separator = ","
    while cells and not cells[-1].strip():
        cells.pop()
    cells = [cell.strip().strip("\"'") for cell in cells]
    return cells if separator == "," else [cell.replace(",", ".") for cell in cells]


def _decimal_commas(line: str) -> bool:
    """Whether the line is two numbers like ``1,5 2,5``, parted by spaces."""
    cells = line.split()
    return len(cells) > 1 and all(cell.count(",") == 1 and cell[-1] != "," for cell in cells)


def _is_header(cells: list[str]) -> bool:
    """Whether the line holds no number at all: a title, or the names of the columns."""
    return all(_number(cell) is None for cell in cells)


def _named(cells: list[str]) -> tuple[int, int] | None:
    """Return the columns that are called x and y, if there are any."""
    names = [cell.lower() for cell in cells]
    return (names.index("x"), names.index("y")) if {"x", "y"} <= set(names) else None


def _point(cells: list[str], columns: tuple[int, int], line: int) -> tuple[float, float]:
    if len(cells) <= max(columns):
        raise FileError(f"Line {line}: expected two numbers, found {len(cells)}.")
    x, y = (_number(cells[column]) for column in columns)
    if x is None or y is None:
        wrong = cells[columns[0] if x is None else columns[1]]
        raise FileError(f"Line {line}: {wrong!r} is not a number.")
    if not (abs(x) <= FARTHEST and abs(y) <= FARTHEST):  # nor is NaN
        raise FileError(f"Line {line}: the point is not finite, or too far away.")
    return x, y


def _number(cell: str) -> float | None:
    try:
        return float(cell)
    except ValueError:
        return None
