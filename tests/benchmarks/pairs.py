"""Pairs of real outlines: two of a kind, and any two.

The outlines are MPEG-7 silhouettes that lie beside the checkout; they are not part of the project.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import numpy as np

from core.geometry.flatten import flatten
from core.model import Outline

SHARED = Path(__file__).parents[3] / "shared" / "data"
OUTLINES = SHARED / "mpeg7_outlines.npz"
SEED = 2013

Rings = list[np.ndarray]
"""Closed polylines (k, 2), the exterior first."""


@dataclass(frozen=True, eq=False)
class Pair:
    """A source and a target."""

    name: str
    source: Outline
    target: Outline

    @property
    def drawn(self) -> tuple[Rings, Rings]:
        """Both outlines as rings of points."""
        return rings_of(self.source), rings_of(self.target)


def rings_of(outline: Outline) -> Rings:
    """Return an outline as the solver follows it."""
    return [line.points for line in flatten(outline)]


def load_outlines(path: Path = OUTLINES) -> dict[str, Outline]:
    """Return the outlines by name, such as ``camel-03``, in order."""
    with np.load(path) as file:
        return {name: Outline.polygon(file[name].astype(float)) for name in sorted(file.files)}


def within_classes(outlines: Mapping[str, Outline]) -> list[Pair]:
    """Pair instance 2k of each class with instance 2k + 1, where both are there."""
    mates = ((name, f"{kind(name)}-{instance(name) + 1:02}") for name in outlines)
    return [_pair(outlines, a, b) for a, b in mates if instance(a) % 2 == 0 and b in outlines]


def across_classes(outlines: Mapping[str, Outline], count: int, seed: int = SEED) -> list[Pair]:
    """Draw pairs of two classes at random; equal seeds give equal pairs."""
    random = np.random.default_rng(seed)
    classes = [list(names) for _, names in groupby(sorted(outlines), kind)]
    pairs = []
    for _ in range(count):
        first, second = random.choice(len(classes), 2, replace=False)
        pairs.append(_pair(outlines, random.choice(classes[first]), random.choice(classes[second])))
    return pairs


def kind(name: str) -> str:
    """Return the class of an outline."""
    return name.rpartition("-")[0]


def instance(name: str) -> int:
    """Return the number of an outline in its class."""
    return int(name.rpartition("-")[2])


def _pair(outlines: Mapping[str, Outline], a: str, b: str) -> Pair:
    return Pair(f"{a} → {b}", outlines[a], outlines[b])
