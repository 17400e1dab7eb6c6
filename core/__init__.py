"""Betwixt's core: map one outline onto another and draw the in-betweens, without a window.

    import core

    morph = core.solve(source, target)        # (n, 2) and (k, 2) points, or outlines with holes
    morph.at(0.5)                             # (v, 2) vertices halfway
    [morph.at(0.5)[ring] for ring in morph.rings]

Nothing heavy is imported until it is used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from core.errors import (
    Cancelled,
    EditError,
    FileError,
    MarkError,
    MorphError,
    OutlineError,
    SolveError,
)

if TYPE_CHECKING:
    from core.model import Document, Outline, Recipe
    from core.morph.library import solve
    from core.morph.morph import Morph
    from core.morph.report import Report

__all__ = [
    "Cancelled",
    "Document",
    "EditError",
    "FileError",
    "MarkError",
    "Morph",
    "MorphError",
    "Outline",
    "OutlineError",
    "Recipe",
    "Report",
    "SolveError",
    "solve",
]

_LAZY = {
    "Document": "core.model",
    "Outline": "core.model",
    "Recipe": "core.model",
    "Morph": "core.morph.morph",
    "Report": "core.morph.report",
    "solve": "core.morph.library",
}


def __dir__() -> list[str]:
    return __all__


def __getattr__(name: str) -> Any:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_LAZY[name]), name)
