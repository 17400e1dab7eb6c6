"""A frame that would fold or cross, settled where it does neither.

Only vertices near a fold or a contact are held. All others follow them as the fit's own linear
system has it, so that a frame settles in a system of the few (static condensation).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from core.geometry.rotation import Complex, to_complex, to_points
from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.motion.barrier import Gaps, settle
from core.morph.motion.contact import Contact
from core.morph.motion.fit import GradientFit
from core.morph.motion.guard import FoldGuard
from core.progress import Watch, unwatched

WARY = 1.2
"""How many times further than they are felt folds and contacts are watched while settling."""
ROUNDS = 8
"""How often more is held, where a settled frame folds or crosses elsewhere."""


@dataclass(frozen=True, eq=False)
class Wanted:
    """What a frame is to be close to."""

    fitted: Complex
    """(n,) the positions it would have if nothing were near."""
    determinants: Array
    """(m,) of the ideal gradients."""


@dataclass(frozen=True, eq=False)
class Tight:
    """Where a frame is close to a fold or a contact."""

    triangles: Indices
    pairs: Indices

    def __bool__(self) -> bool:
        return len(self.triangles) > 0 or len(self.pairs) > 0

    def __or__(self, other: Tight) -> Tight:
        return Tight(
            np.union1d(self.triangles, other.triangles), np.union1d(self.pairs, other.pairs)
        )

    def __sub__(self, other: Tight) -> Tight:
        return Tight(_without(self.triangles, other.triangles), _without(self.pairs, other.pairs))


@dataclass(frozen=True, eq=False)
class Grip:
    """What is held, and how stiffly the rest of the shape answers."""

    tight: Tight
    vertices: Indices
    """(k,) in order."""
    stiffness: Array
    """(k, k)"""


class Hold:
    """Keeps frames from folding and crossing: fit, folds and contact are one energy."""

    def __init__(self, fit: GradientFit, guard: FoldGuard, contact: Contact) -> None:
        self._fit, self._guard, self._contact = fit, guard, contact

    def leaving(self, frames: Sequence[tuple[Complex, Wanted]]) -> Self:
        """Return the hold that does not touch some frames (n,) that were settled."""
        margins = (self._guard.margins(z, wanted.determinants) for z, wanted in frames)
        contact = self._contact.leaving(*(z for z, _ in frames))
        return type(self)(self._fit, self._guard.leaving(*margins), contact)

    def margin(self, z: Complex, wanted: Wanted) -> float:
        """Return the smallest ratio of a triangle's area to the ideal one: a fold is 0 or less."""
        return float(self._guard.margins(z, wanted.determinants).min())

    def tight(
        self, z: Complex, wanted: Wanted, within: float = 1.0, among: Indices | None = None
    ) -> Tight:
        """Return where positions z (n,) come within so many times what is felt.

        ``among`` are the pairs that may, if that is known.
        """
        triangles = self._guard.near(z, wanted.determinants, within)
        return Tight(triangles, self._contact.near(z, within, among))

    def sound(self, z: Complex, wanted: Wanted) -> bool:
        """Whether positions z (n,) neither fold nor cross."""
        return self.margin(z, wanted) > 0 and not self._contact.crosses(z)

    def free(self, wanted: Wanted, among: Indices | None = None) -> bool:
        """Whether what is wanted is sound, and nothing of what holds frames is felt.

        Where no pair may come near there is no crossing either.
        """
        if self.tight(wanted.fitted, wanted, among=among):
            return False
        return (among is not None and not len(among)) or not self._contact.crosses(wanted.fitted)

    def meetings(self, frames: Sequence[Complex]) -> list[Indices]:
        """Return the pairs of the boundary that may be felt from each frame (n,) to the next."""
        return self._contact.meetings(frames)

    def _grip(self, tight: Tight) -> Grip:
        corners = self._guard.triangles[tight.triangles], self._contact.corners(tight.pairs)
        vertices = np.unique(np.concatenate(corners))
        return Grip(tight, vertices, self._fit.stiffness(vertices))

    def __call__(
        self,
        wanted: Wanted,
        start: Complex,
        among: Indices | None = None,
        watch: Watch = unwatched,
    ) -> Complex:
        """Return the settled frame (n,) from a sound start (n,); it is sound, too.

        Where it folds or crosses although all that is held is open, it is settled anew with more.
        """
        grip = self._grip(self.tight(start, wanted, WARY, among))
        for _ in range(ROUNDS):
            z = self._settled(wanted, start, grip, watch)
            missing = self.tight(z, wanted, among=among) - grip.tight
            crosses = self._contact.crosses(z)
            if not missing and not crosses:
                break
            if crosses:
                missing |= Tight(missing.triangles, self._contact.meeting(start, z))
            elif self.margin(z, wanted) > 0:
                start = z
            grip = self._grip(grip.tight | missing)
        return z if self.sound(z, wanted) else start

    def _settled(self, wanted: Wanted, start: Complex, grip: Grip, watch: Watch) -> Complex:
        held, tight = grip.vertices, grip.tight
        kinds: tuple[Gaps, ...] = (
            self._guard.gaps(tight.triangles, held, wanted.determinants),
            self._contact.gaps(tight.pairs, held),
        )
        fitted = wanted.fitted[held]
        felt = [kind for kind in kinds if len(kind.corners)]
        offset = settle(fitted, grip.stiffness, felt, start[held], watch) - fitted
        force = np.zeros(len(start), dtype=complex)
        force[held] = grip.stiffness @ offset
        return wanted.fitted + to_complex(self._fit.solve(to_points(force)))


def _without(some: Indices, others: Indices) -> Indices:
    """Return those of some numbers that are not among others, both in order."""
    if not len(others):
        return some
    place = np.searchsorted(others, some)
    return some[others[np.minimum(place, len(others) - 1)] != some]
