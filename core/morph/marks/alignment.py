"""How one contour would come to lie on another: as a whole, or limb by limb."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry.triangulation import Indices
from core.model.outline import Array
from core.morph.marks.contour import Complex, Contour, Samples
from core.morph.marks.misfit import direction_misfits, position_misfits, turn_misfits

ROTATIONS = 36
"""Rotations that are tried to lay one area on another."""
UPRIGHT = 0.02
"""What a half turn counts for, as a misfit."""
WORSE, LITTLE = 1.5, 0.4
"""The most upright way is followed unless it is so many times worse than the best, both misfits
counted from a little below zero: samples that miss the tips of petals may cost that much."""
AS_GOOD = 0.98
"""Shifts are as good as the best when they correlate at least so well."""


@dataclass(frozen=True, eq=False)
class Fit:
    """Similarities, one or one for each of k places, from a source to its target."""

    here: Complex
    """() or (k,) centres on the source."""
    there: Complex
    """Centres on the target."""
    factor: Complex
    """Rotation and scale."""

    def __call__(self, points: Complex) -> Complex:
        """Return where points of the source are expected."""
        return self.there + self.factor * (points - self.here)

    @property
    def rotation(self) -> Complex:
        """The rotations, of length one."""
        return _unit(self.factor)


def fit(source: Complex, target: Complex, weights: Array) -> Fit:
    """Return the similarity that fits pairs of points (n,) best (Procrustes).

    Its scale is the ratio of the sizes, so that the fit from target to source is its inverse.
    """
    w = weights / weights.sum()
    here, there = source @ w, target @ w
    a, b = source - here, target - there
    scale = np.sqrt((np.abs(b) ** 2 @ w) / (np.abs(a) ** 2 @ w))
    return Fit(here, there, scale * _unit((np.conj(a) * b) @ w))


def fit_limbs(
    places: Complex, source: Complex, target: Complex, weights: Array, reach: float
) -> Fit:
    """Return for each of ``places`` (k,) the similarity that fits the pairs around it best.

    The weights (n,) of the pairs fall with their distance on the source like a bell of width
    ``reach`` (moving least squares). All take the scale of the whole: what is around a place moves
    and turns it, but does not swell it.
    """
    near = np.exp(-(np.abs(places[:, None] - source) ** 2) / (2 * reach**2)) * weights
    near /= np.maximum(near.sum(axis=1, keepdims=True), 1e-300)
    moments = np.column_stack([source, target, np.conj(source) * target])
    # as real numbers: a product that is too small for threads, which would wait for each other
    here, there, turn = (near @ moments.view(np.float64)).view(np.complex128).T
    scale = np.abs(fit(source, target, weights).factor)
    return Fit(here, there, scale * _unit(turn - np.conj(here) * there))


def shifts(source: Complex, target: Complex, most: int, rotation: complex | None = None) -> Indices:
    """Return the cyclic shifts (k,) of evenly spaced points (n,) that fit best, best first.

    Each fits better than those beside it: the correlation |Σ conj(aᵢ) bᵢ₊ₖ| is that of the rings
    under their best similarity. Where the upright shift is as good, as on a circle, it comes last.
    With a known ``rotation`` there is one best shift.
    """
    a, b = source - source.mean(), target - target.mean()
    fits = np.fft.ifft(np.conj(np.fft.fft(a)) * np.fft.fft(b))
    straight = np.argmax((fits * np.conj(rotation or 1.0)).real)
    if rotation is not None:
        return np.array([straight])
    size = np.abs(fits)
    best = peaks(size, most)
    return np.append(best, straight) if size[straight] > AS_GOOD * size.max() else best


def overlays(
    source: Contour, target: Contour, here: Samples, there: Samples, first: Complex, most: int
) -> list[Fit]:
    """Return the similarities that lay one area on the other so that their samples come closest.

    Unlike ``shifts`` this does not mind when detail takes a different share of the perimeter. The
    rotations that are tried are counted from ``first``, so that none depends on the axes.
    """
    rotations = first * np.exp(2j * np.pi * np.arange(ROTATIONS) / ROTATIONS)[:, None]
    shrink, grow = _to_unit_area(source), _to_unit_area(target)
    misfits = turn_misfits(here, there) + direction_misfits(here, rotations, there)
    misfits += position_misfits(rotations * shrink(here.points), grow(there.points))
    away = misfits.min(axis=2).mean(axis=1) + misfits.min(axis=1).mean(axis=1)
    lean = leaning(rotations[:, 0])
    best = peaks(-away - lean, ROTATIONS)
    straight = best[np.argmin(lean[best])]
    tried = best[:most]
    if straight not in tried and not far_worse(away[straight], away.min()):
        tried = np.append(tried, straight)
    return [
        Fit(shrink.here, grow.here, rotations[k, 0] * shrink.factor / grow.factor) for k in tried
    ]


def far_worse(misfit: float, best: float) -> bool:
    """Whether one way to lay a contour on another need not be followed, upright as it may be."""
    return misfit + LITTLE > WORSE * (best + LITTLE)


def leaning(rotation: Complex) -> Array:
    """Return what it costs to be turned: little, so that it only decides between equals."""
    return UPRIGHT * (1 - rotation.real) / 2


def _to_unit_area(contour: Contour) -> Fit:
    area, centre = contour.area_and_centre()
    return Fit(np.array(centre), np.array(0j), np.array(1 / np.sqrt(area) + 0j))


def peaks(values: Array, most: int) -> Indices:
    """Return the indices of cyclic maxima, the highest first; 0 if all values are the same."""
    peaks = np.flatnonzero((values >= np.roll(values, 1)) & (values > np.roll(values, -1)))
    peaks = peaks[np.argsort(-values[peaks], kind="stable")][:most]
    return peaks if len(peaks) else np.array([0])


def _unit(values: Complex) -> Complex:
    size = np.abs(values)
    return np.where(size > 1e-12, values / np.maximum(size, 1e-12), 1.0)
