"""Where the letters of marks stand: beside the marked place, off the shape."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from core.geometry.places import measured
from core.geometry.polyline import points_at, signed_area
from core.model import Keyframe, Outline, RingPoint
from core.model.outline import Array

if TYPE_CHECKING:
    from core.morph.morph import Morph

LOOK = 0.008
"""Fraction of the perimeter to either side that tells which way a place faces."""


@dataclass(frozen=True, eq=False)
class Pins:
    """(k, 2) marked places in the document, and the unit directions in which letters stand off."""

    places: Array
    outward: Array


NO_PINS = Pins(np.empty((0, 2)), np.empty((0, 2)))


def pins_on_key(keyframe: Keyframe) -> Pins:
    """Return the pins of a keyframe's marks."""
    return pins_at(keyframe.outline, keyframe.marks)


def pins_at(outline: Outline, marks: Sequence[RingPoint]) -> Pins:
    """Return the pins of places on an outline."""
    if not marks:
        return NO_PINS
    places = np.array([outline.position(mark) for mark in marks])
    return Pins(places, np.array([outward_at(outline, mark) for mark in marks]))


def pins_between(source: Keyframe, morph: Morph, positions: Array) -> Pins:
    """Return the pins of an in-between, whose vertices are at (n, 2) ``positions``."""
    if not source.marks:
        return NO_PINS
    places, outward = [], []
    for mark in source.marks:
        ring = morph.rings[min(mark.ring, len(morph.rings) - 1)]
        away = morph.rest[ring] - source.outline.position(mark)
        i = int(np.argmin(np.hypot(away[:, 0], away[:, 1])))
        points = positions[ring]
        step = max(1, round(LOOK * len(ring)))
        places.append(points[i])
        before, after = points[i - step], points[(i + step) % len(ring)]
        outward.append(_off(before, points[i], after, points, hole=mark.ring > 0))
    return Pins(np.array(places), np.array(outward))


def outward_at(outline: Outline, place: RingPoint) -> Array:
    """Return the unit direction (2,) that leaves the shape at a place."""
    measure = measured(outline)[place.ring]
    points, length = measure.polyline.points, measure.length_of(place.at)
    around = length + LOOK * measure.perimeter * np.array([-1.0, 0.0, 1.0])
    before, here, after = points_at(points, measure.lengths, around)
    return _off(before, here, after, points, hole=place.ring > 0)


def _off(before: Array, here: Array, after: Array, ring: Array, *, hole: bool) -> Array:
    """Return the unit normal of a ring at ``here``, away from what is filled."""
    arriving, leaving = _unit(here - before), _unit(after - here)
    along = _unit(arriving + leaving)
    sign = 1.0 if (signed_area(ring) > 0) != hole else -1.0
    return sign * np.array([along[1], -along[0]])


def _unit(vector: Array) -> Array:
    length = float(np.hypot(*vector))
    return vector / length if length > 0 else np.array([0.0, -1.0])
