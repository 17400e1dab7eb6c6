"""Which hole of the target belongs to which of the source, and how it is turned."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from core.geometry.polyline import arc_lengths, points_at, resample
from core.geometry.rotation import Complex, to_complex
from core.model.outline import Array
from core.morph.marks.alignment import fit_limbs
from core.morph.marks.rings import RingMatch

SAMPLES = 100
REACH = 0.5
"""How far the exterior carries what is inside it, as a fraction of its radius."""
SIZE = 0.2
"""How much a difference in size counts against a difference in place."""


@dataclass(frozen=True)
class RingPair:
    """A ring of the source and the one of the target that belongs to it."""

    source: int
    target: int
    rotation: complex | None = None
    """How the source's is turned, of length one, if it is known."""

    def reversed(self) -> RingPair:
        """Return the pair, seen from the target."""
        turned = None if self.rotation is None else self.rotation.conjugate()
        return RingPair(self.target, self.source, turned)


def paired_holes(
    source: Sequence[Array], target: Sequence[Array], exterior: RingMatch, known: Mapping[int, int]
) -> list[RingPair]:
    """Pair the holes of two outlines, given as rings (n, 2), exterior first.

    Each goes to where the match of the exteriors carries it and is turned like what is around it;
    those ``known``, source to target, are kept. Holes that are left over, because the other outline
    has fewer, have no partner.
    """
    if min(len(source), len(target)) < 2:
        return []
    from scipy.optimize import linear_sum_assignment  # loads slowly, and few shapes have holes

    lengths = arc_lengths(source[0])
    at = np.arange(SAMPLES) * (lengths[-1] / SAMPLES)
    here = to_complex(points_at(source[0], lengths, at))
    there = to_complex(points_at(target[0], arc_lengths(target[0]), exterior.images(at)))
    radius = float(np.sqrt(np.mean(np.abs(here - here.mean()) ** 2)))
    (centres, sizes), (others, other_sizes) = _extents(source[1:]), _extents(target[1:])
    carried = fit_limbs(centres, here, there, np.ones(SAMPLES), REACH * radius)
    scale = np.abs(carried.factor[0])
    away = np.abs(carried(centres)[:, None] - others) / (scale * radius)
    unlike = np.abs(np.log(scale * sizes[:, None] / other_sizes))
    cost = away + SIZE * unlike
    for i, j in known.items():
        cost[i - 1, j - 1] = -1e6
    rows, columns = linear_sum_assignment(cost)
    return [
        RingPair(int(i) + 1, int(j) + 1, complex(carried.rotation[i]))
        for i, j in zip(rows, columns, strict=True)
    ]


def _extents(rings: Sequence[Array]) -> tuple[Complex, Array]:
    """Return the centres of rings and their radii."""
    even = np.array([to_complex(resample(ring, SAMPLES)) for ring in rings])
    centres = even.mean(axis=1)
    radii = np.sqrt(np.mean(np.abs(even - centres[:, None]) ** 2, axis=1))
    return centres, np.maximum(radii, 1e-300)
