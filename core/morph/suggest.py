"""Proposals for marks: where a ring starts when nobody said, and the mate of a clicked point."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from core.geometry.places import Track, tracks
from core.geometry.polyline import arc_lengths, nearest_length, resample, turning_angles
from core.model.outline import Array, Outline, RingPoint

SAMPLES = 256
CORNER = np.radians(20)
"""A vertex that turns by more than this is a corner."""
REACH = 0.05
"""How far a proposed mate may be drawn to a corner, as a fraction of the perimeter."""


def best_shift(
    source: Array, target: Array, rotation: complex | None = None
) -> tuple[float, float, complex]:
    """Find corresponding starts of two clean rings (n, 2) and (k, 2).

    Returns the arc length on the source, that on the target, and the rotation between them as a
    unit complex number. Each cyclic shift is scored by how well the rings then fit under their best
    similarity (Procrustes); between near equals the smaller rotation wins, or the one closest to
    ``rotation`` if that is given.
    """
    start = _prominent_vertex(source)
    a, b = (_samples(p, s) for p, s in ((source, arc_lengths(source)[start]), (target, 0.0)))
    fit = np.fft.ifft(np.conj(np.fft.fft(a)) * np.fft.fft(b))  # Σ conj(a_i) b_{i+k}
    turn = fit / np.maximum(np.abs(fit), 1e-300)
    wish = turn.real if rotation is None else (turn * np.conj(rotation)).real
    weight = 0.02 if rotation is None else 0.5
    shift = int(np.argmax(np.abs(fit) * (1 + weight * wish)))
    lengths = arc_lengths(target)
    at = shift * lengths[-1] / SAMPLES
    return (
        float(arc_lengths(source)[start]),
        _to_vertex(target, lengths, at, 1.5 * lengths[-1] / SAMPLES),
        complex(turn[shift]),
    )


def mate(
    source: Outline,
    target: Outline,
    place: RingPoint,
    marks: Sequence[tuple[RingPoint, RingPoint]] = (),
) -> RingPoint:
    """Propose the place on the target that corresponds to ``place`` on the source.

    Between the marks already set on that ring it keeps its fraction of the arc's length; with none
    it follows the best cyclic shift. From there it is drawn to the nearest similar corner.
    """
    ring = min(place.ring, len(target.rings) - 1)
    here, there = tracks(source)[place.ring], tracks(target)[ring]
    length = here.length_of(place.at)
    arcs = [
        (here.length_of(a.at), there.length_of(b.at))
        for a, b in marks
        if a.ring == place.ring and b.ring == ring
    ]
    if not arcs:
        arcs = [_start_pair(here, there)]
    guess, room = _proportional(
        length, arcs, here.perimeter, there.perimeter, _same_turn(here, there)
    )
    return RingPoint(ring, there.place_of(_to_similar_corner(here, length, there, guess, room)))


def snap(outline: Outline, place: RingPoint, radius: float) -> RingPoint:
    """Return the node nearest to a place, within ``radius``, or the place itself."""
    ring = outline.rings[place.ring]
    away = ring.points - ring.position(place.at)
    distance = np.hypot(away[:, 0], away[:, 1])
    nearest = int(np.argmin(distance))
    return RingPoint(place.ring, float(nearest)) if distance[nearest] <= radius else place


def _samples(points: Array, start: float) -> Array:
    """Return (SAMPLES,) centred points as complex numbers."""
    even = resample(points, SAMPLES, start)
    z = even[:, 0] + 1j * even[:, 1]
    return z - z.mean()


def _prominent_vertex(points: Array) -> int:
    """The vertex farthest from the centre: the same wherever the list of points starts."""
    away = points - resample(points, SAMPLES).mean(axis=0)
    return int(np.argmax(np.round(np.hypot(away[:, 0], away[:, 1]) / np.ptp(points), 9)))


def _to_vertex(points: Array, lengths: Array, at: float, reach: float) -> float:
    """Move an arc length to the nearest vertex within reach."""
    perimeter = lengths[-1]
    gap = np.abs(np.mod(lengths[:-1] - at + perimeter / 2, perimeter) - perimeter / 2)
    nearest = int(np.argmin(gap))
    return float(lengths[nearest]) if gap[nearest] <= reach else float(at)


def _same_turn(here: Track, there: Track) -> bool:
    """Whether both polylines run the same way round."""
    return _turn(here) == _turn(there)


def _turn(track: Track) -> bool:
    return bool(np.sum(turning_angles(track.polyline.points)) > 0)


def _start_pair(here: Track, there: Track) -> tuple[float, float]:
    """Best cyclic shift of two tracks, in the arc lengths of their own directions."""
    a, b = here.polyline.points, there.polyline.points
    mirrored = b if _same_turn(here, there) else b[::-1]
    s, t, _ = best_shift(a, mirrored)
    point = resample(mirrored, 1, t)[0]
    return s, nearest_length(b, there.lengths, point)[0]


def _proportional(
    length: float,
    arcs: Sequence[tuple[float, float]],
    here: float,
    there: float,
    same_turn: bool,
) -> tuple[float, tuple[float, float]]:
    """Carry an arc length over by its fraction of the arc it lies in.

    Returns it on the target, and how much room there is before and after it to the next marks.
    """
    ordered = sorted(arcs)
    starts = np.array([s for s, _ in ordered])
    i = int(np.searchsorted(starts, length, side="right")) - 1  # -1 is the arc across the seam
    (s0, t0), (s1, t1) = ordered[i], ordered[(i + 1) % len(ordered)]
    alone = len(ordered) == 1
    arc = here if alone else (s1 - s0) % here
    fraction = ((length - s0) % here) / arc if arc else 0.0
    sign = 1 if same_turn else -1
    image = there if alone else (sign * (t1 - t0)) % there
    room = (fraction * image, (1 - fraction) * image)
    return (t0 + sign * fraction * image) % there, room if same_turn else room[::-1]


def _to_similar_corner(
    here: Track, length: float, there: Track, guess: float, room: tuple[float, float]
) -> float:
    """Draw a guess to the corner within reach that turns most like the source does."""
    turn = _turn_at(here, length)
    if abs(turn) < CORNER:
        return guess
    sign = 1 if _same_turn(here, there) else -1
    perimeter = there.perimeter
    reach = REACH * perimeter
    gap = np.mod(there.lengths[:-1] - guess + perimeter / 2, perimeter) - perimeter / 2
    turns = sign * turning_angles(there.polyline.points)
    near = (gap > -min(reach, 0.9 * room[0])) & (gap < min(reach, 0.9 * room[1]))
    near &= turns * np.sign(turn) > CORNER
    if not near.any():
        return guess
    cost = np.abs(gap) / reach + np.abs(turns - turn) / np.pi
    return float(there.lengths[np.argmin(np.where(near, cost, np.inf))])


def _turn_at(track: Track, length: float) -> float:
    """Turning angle of the vertex at an arc length; 0 on an edge."""
    gap = np.abs(track.lengths[:-1] - length)
    nearest = int(np.argmin(np.minimum(gap, track.perimeter - gap)))
    near = min(gap[nearest], track.perimeter - gap[nearest]) < 1e-6 * track.perimeter
    return float(turning_angles(track.polyline.points)[nearest]) if near else 0.0
