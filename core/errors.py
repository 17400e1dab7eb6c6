"""What can go wrong, as one tree.

MorphError
├── OutlineError   an outline that is no finite, closed, simple polygon
├── MarkError      marks that contradict each other or the outlines
├── SolveError     a mapping or an in-between that could not be computed
├── FileError      a file that cannot be read or written
└── EditError      an edit that the document does not allow

Cancelled          the caller asked to stop; nothing is wrong, so it is none of these

Each error says *what* is wrong, *where*, and gives a *hint* how to mend it. The three parts stay
apart so that a window can highlight the place and a terminal can print one line.
A ``Repair`` says what and where of a fault that was mended.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Where:
    """The place of an error; every part is optional."""

    side: str = ""
    """Which outline: "source" or "target"."""
    ring: int | None = None
    node: int | None = None
    point: tuple[float, float] | None = None
    """The offending position, in the coordinates the outline was given in."""
    marks: tuple[int, ...] = ()
    """Indices of the marks involved."""
    path: str = ""
    """The file."""


@dataclass(frozen=True)
class Repair:
    """A fault that was mended instead of refused: what, how and where."""

    what: str
    how: str
    where: Where
    moved: float
    """How far the outline is now from what was drawn, as a fraction of its diagonal."""

    def __str__(self) -> str:
        near = " near ({:.4g}, {:.4g})".format(*self.where.point) if self.where.point else ""
        return f"{self.what}{near}: {self.how}."


class MorphError(Exception):
    """Base of all errors that are the input's fault rather than the program's."""

    def __init__(self, what: str, *, where: Where | None = None, hint: str = "") -> None:
        super().__init__(what)
        self.what = what
        self.where = where or Where()
        self.hint = hint

    def __str__(self) -> str:
        place = f"{self.where.path}: " if self.where.path else ""
        advice = f" {self.hint}" if self.hint else ""
        return f"{place}{self.what}{advice}"


class OutlineError(MorphError):
    """An outline is not a finite, closed, simple polygon, and could not be repaired."""


class MarkError(MorphError):
    """Marks are out of cyclic order, on top of each other, or do not fit the outlines."""


class SolveError(MorphError):
    """The mapping or an in-between could not be computed."""


class FileError(MorphError):
    """A file cannot be read, understood or written."""


class EditError(MorphError):
    """An edit is not possible on this document."""


class Cancelled(Exception):  # noqa: N818 - a request that was met, not an error
    """The work was stopped on request."""


Trouble = MorphError | Repair
"""What is wrong with an input, or was."""
