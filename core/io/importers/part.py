"""What an importer finds in a file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from core.model import Outline, Style

Warn = Callable[[str], None]
"""Called with one sentence for everything that was left out or changed on reading."""

MAX_NODES = 200_000
"""Nodes that a file may hold."""


@dataclass(frozen=True)
class Part:
    """One filled shape of a file."""

    name: str
    outline: Outline
    style: Style | None = None
    """How the file paints it; None where it does not say."""

    def style_on(self, background: str) -> Style:
        """Return the style for a layer; a shape that would not show on the background gets ours."""
        if self.style is None:
            return Style()
        hidden = self.style.fill[:7].lower() == background[:7].lower()
        return replace(self.style, fill=Style().fill) if hidden and background else self.style


def ignore(warning: str) -> None:
    """Drop a warning."""


def numbered(name: str, outlines: list[Outline], style: Style | None = None) -> list[Part]:
    """Make a part of each outline; several are told apart by a number."""
    if len(outlines) == 1:
        return [Part(name, outlines[0], style)]
    return [Part(f"{name} ({i})", outline, style) for i, outline in enumerate(outlines, 1)]


def uniquely_named(parts: Iterable[Part]) -> list[Part]:
    """Number the names that occur before, so that a name means one part."""
    taken: Counter[str] = Counter()
    named = []
    for part in parts:
        name = part.name
        while taken[name]:
            taken[part.name] += 1
            name = f"{part.name} ({taken[part.name]})"
        taken[name] += 1
        named.append(replace(part, name=name))
    return named
