"""Mending, step by step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from core.geometry.crossing import crosses_itself
from core.geometry.mending import BeyondRepair
from core.geometry.mending.meetings import separate
from core.geometry.mending.opening import Opened, Opening
from core.geometry.mending.walks import Walks
from core.geometry.origin import Origin
from core.model.outline import Array

HAIRS = 5e-4, 5e-5, 5e-6, 5e-7
"""How far drawn vertices may move where a touch is opened: the first that fits."""


@dataclass(frozen=True, eq=False)
class Mended:
    """Rings that are simple and disjoint, exterior positive, holes negative; and what was wrong."""

    opened: Opened
    hair: float
    """How far vertices moved where it was opened, at most."""
    touches: Array
    """(k, 2) where it was opened."""
    spikes: Array
    """(k, 2) tips that were cut off."""
    loops: Array
    """(k, 2) crossings whose loops were cut off."""
    lost: float
    """Area of those loops."""


def mend(rings: Sequence[Array], origins: Sequence[Origin], most_lost: float) -> Mended:
    """Mend rings (n, 2) at unit size, exterior first.

    Neighbouring vertices are distinct; ``origins`` tells where they were drawn. Loops are cut off
    up to the area ``most_lost``. Raises ``BeyondRepair`` where that does not do.
    """
    walks = Walks.of(rings, origins)
    walks.cut_spikes()
    walks.cut_loops(most_lost)
    walks.cut_spikes()
    for index, walk in enumerate(walks.walks):
        if len(walk) < 3:
            raise BeyondRepair(index)
    if walks.lost > most_lost:
        raise BeyondRepair
    walks.orient()
    opening = Opening(walks)
    for hair in HAIRS:
        opened = opening.by(hair)
        if not crosses_itself(opened.rings) and separate(opened.rings):
            places = (sorted(walks.shared()), walks.spikes, walks.loops)
            touches, spikes, loops = (walks.points[nodes] for nodes in places)
            return Mended(opened, hair, touches, spikes, loops, walks.lost)
    raise BeyondRepair
