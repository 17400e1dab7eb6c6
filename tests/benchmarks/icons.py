"""Icons into one another: outlines that lie beside the checkout, all brought to one size."""

from __future__ import annotations

from itertools import pairwise
from operator import itemgetter
from pathlib import Path

import numpy as np

from core.geometry.polyline import signed_area
from core.io import importers
from core.model import Outline
from tests.benchmarks.pairs import SHARED, Pair, rings_of

ICONS = SHARED / "svg"
PLAIN = 4
"""Shapes of so few nodes are backgrounds and buttons."""


def icon_pairs(folder: Path = ICONS) -> list[Pair]:
    """Return each icon with the next that has as many holes; none without the folder."""
    icons = [(path.stem, shape) for path in sorted(folder.glob("*.svg")) if (shape := main(path))]
    icons.sort(key=lambda icon: len(icon[1].rings))
    return [
        Pair(f"{a} → {b}", source, target)
        for (a, source), (b, target) in pairwise(icons)
        if len(source.rings) == len(target.rings)
    ]


def main(path: Path) -> Outline | None:
    """Return the largest shape of a file that is not plain, at unit area."""
    shapes = [part.outline for part in importers.read(path)]
    drawn = [rings_of(shape) for shape in shapes if len(shape.rings[0]) > PLAIN]
    if not drawn:
        return None
    size, rings = max(((abs(signed_area(rings[0])), rings) for rings in drawn), key=itemgetter(0))
    return Outline.polygon(*(ring / np.sqrt(size) for ring in rings))
