"""Letters and digits into one another, from the fonts that Qt finds on this machine."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QFont, QFontDatabase, QPainterPath

from core.io.importers.nesting import group_rings
from core.model import Outline
from tests.benchmarks.pairs import Pair

PAIRS = "S5 AR OD 8B ea cs WM 69 gq Kk 17 hn PF CG"
"""Different shapes with, in most fonts, equal numbers of holes."""
SIZE = 80
"""Pixels: curves are flattened to a fraction of one."""


def glyph_pairs() -> list[Pair]:
    """Return the pairs in a proportional and in a fixed font; none where there is no font.

    Needs a running application.
    """
    if not QFontDatabase.families():
        return []
    kinds = QFontDatabase.SystemFont.GeneralFont, QFontDatabase.SystemFont.FixedFont
    fonts = {QFontDatabase.systemFont(kind).family() for kind in kinds}
    pairs = [
        Pair(f"{a} → {b} ({font})", glyph(a, font), glyph(b, font))
        for font in sorted(fonts)
        for a, b in PAIRS.split()
    ]
    return [pair for pair in pairs if len(pair.source.rings) == len(pair.target.rings)]


def glyph(letter: str, family: str) -> Outline:
    """Return the outline of a letter; of several parts, the first."""
    font = QFont(family)
    font.setPixelSize(SIZE)
    path = QPainterPath()
    path.addText(0, 0, font, letter)
    loops = [
        np.array(
            [point.toTuple() for point in polygon.toList()[:-1]]
        )  # the first point is repeated
        for polygon in path.simplified().toSubpathPolygons()
    ]
    return group_rings([Outline.polygon(loop).rings[0] for loop in loops])[0]
