"""Outlines as the artist draws them: rings of nodes, straight or Bézier between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.model import cubic
from core.model.cubic import Array

MIN_NODES = 3
"""Fewest nodes of a ring."""
QUARTER = 4 / 3 * (2**0.5 - 1)
"""Handle length at which a cubic comes closest to a quarter of the unit circle."""


def _frozen(values: ArrayLike, rows: int | None = None) -> Array:
    array = np.array(values, dtype=float)
    if rows == 0 or array.size == 0:
        array = array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2 or (rows is not None and len(array) != rows):
        raise ValueError(
            f"expected ({'n' if rows is None else rows}, 2) numbers, got {array.shape}"
        )
    array.setflags(write=False)
    return array


@dataclass(frozen=True, eq=False)
class Ring:
    """One closed curve; the first node is not repeated at the end.

    Segment i runs from node i to node i+1 (cyclic). It is the cubic Bézier curve of the two nodes
    and the handles between them, and a straight line where both of those handles are zero.
    A *place* on the ring is one number ``at`` in [0, n): segment index plus curve parameter.
    """

    points: Array
    """(n, 2) node positions."""
    handles_in: Array
    """(n, 2) offsets from a node to the handle before it; zero where there is none."""
    handles_out: Array
    """(n, 2) offsets from a node to the handle after it; zero where there is none."""

    def __post_init__(self) -> None:
        points = _frozen(self.points)
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "handles_in", _frozen(self.handles_in, len(points)))
        object.__setattr__(self, "handles_out", _frozen(self.handles_out, len(points)))

    @classmethod
    def polygon(cls, points: ArrayLike) -> Self:
        """Make a ring of straight segments from (n, 2) points."""
        array = np.asarray(points, dtype=float)
        zero = np.zeros_like(array)
        return cls(array, zero, zero)

    @classmethod
    def ellipse(cls, centre: ArrayLike, radii: ArrayLike) -> Self:
        """Make an ellipse of four smooth nodes, true to 0.03 % of the radii (2,)."""
        compass = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
        ahead = QUARTER * np.roll(compass, -1, axis=0)
        r = np.asarray(radii, dtype=float)
        return cls(np.asarray(centre, dtype=float) + r * compass, -r * ahead, r * ahead)

    def __len__(self) -> int:
        return len(self.points)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Ring) and all(
            np.array_equal(a, b) for a, b in zip(self._arrays(), other._arrays(), strict=True)
        )

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.points + 0.0).tobytes())  # −0 equals 0, and must hash alike

    def _arrays(self) -> tuple[Array, Array, Array]:
        return self.points, self.handles_in, self.handles_out

    @property
    def curved(self) -> NDArray[np.bool_]:
        """(n,) whether each segment has a handle."""
        arriving = np.roll(self.handles_in, -1, axis=0)
        return np.any((self.handles_out != 0) | (arriving != 0), axis=1)

    def controls(self, segment: int) -> Array:
        """(4, 2) Bézier control points of a segment."""
        i, j = segment % len(self), (segment + 1) % len(self)
        p, q = self.points[i], self.points[j]
        return np.array([p, p + self.handles_out[i], q + self.handles_in[j], q])

    def position(self, at: float) -> Array:
        """(2,) the point at a place."""
        segment = int(at) % len(self)
        u = at - int(at)
        if not self.curved[segment]:  # a line is traversed evenly, whatever its control points say
            p, q = self.points[segment], self.points[(segment + 1) % len(self)]
            return (1 - u) * p + u * q
        return cubic.points_on(self.controls(segment), u)

    def extremes(self) -> Array:
        """(k, 2) points among which are those farthest left, up, right and down."""
        ends, arriving = (np.roll(a, -1, axis=0) for a in (self.points, self.handles_in))
        controls = self.points, self.points + self.handles_out, ends + arriving, ends
        curves = np.stack(controls, axis=1)[self.curved]
        return np.concatenate([self.points, cubic.turning_points(curves)])

    def with_node(self, at: float) -> Self:
        """Insert a node at a place without changing the curve."""
        i, u = int(at) % len(self), at - int(at)
        j = (i + 1) % len(self)
        points, before, after = (np.array(a) for a in self._arrays())
        here, arriving, leaving = self.position(at), np.zeros(2), np.zeros(2)
        if self.curved[i]:
            (a, ab, abc, _), (_, bcd, cd, d) = cubic.split(self.controls(i), u)
            after[i], before[j] = ab - a, cd - d
            arriving, leaving = abc - here, bcd - here
        return type(self)(
            np.insert(points, i + 1, here, axis=0),
            np.insert(before, i + 1, arriving, axis=0),
            np.insert(after, i + 1, leaving, axis=0),
        )

    def without_nodes(self, nodes: Sequence[int]) -> Self:
        """Remove nodes by index."""
        return type(self)(*(np.delete(a, nodes, axis=0) for a in self._arrays()))

    def reversed(self) -> Self:
        """Return the same curve run through the other way, node 0 staying first."""
        order = -np.arange(len(self)) % max(len(self), 1)
        return type(self)(self.points[order], self.handles_out[order], self.handles_in[order])

    def transformed(self, matrix: ArrayLike, offset: ArrayLike = (0.0, 0.0)) -> Self:
        """Apply x → M x + offset, with M (2, 2)."""
        m = np.asarray(matrix, dtype=float)
        return type(self)(
            self.points @ m.T + np.asarray(offset, dtype=float),
            self.handles_in @ m.T,
            self.handles_out @ m.T,
        )


@dataclass(frozen=True)
class RingPoint:
    """A place on an outline: which ring, and where on it (see ``Ring``)."""

    ring: int
    at: float


@dataclass(frozen=True)
class Outline:
    """A filled shape: the exterior ring first, then its holes. Either orientation is accepted."""

    rings: tuple[Ring, ...]

    @classmethod
    def polygon(cls, *rings: ArrayLike) -> Self:
        """Make an outline of straight-sided rings, exterior first, each (n, 2)."""
        return cls(tuple(Ring.polygon(ring) for ring in rings))

    def position(self, place: RingPoint) -> Array:
        """(2,) the point at a place."""
        return self.rings[place.ring].position(place.at)

    def bounds(self) -> tuple[float, float, float, float]:
        """(left, top, right, bottom), with all of the curves; zeros where there is nothing."""
        if not any(map(len, self.rings)):
            return 0.0, 0.0, 0.0, 0.0
        points = np.concatenate([ring.extremes() for ring in self.rings])
        (left, top), (right, bottom) = points.min(axis=0), points.max(axis=0)
        return float(left), float(top), float(right), float(bottom)

    def with_ring(self, index: int, ring: Ring) -> Self:
        """Replace one ring."""
        return type(self)((*self.rings[:index], ring, *self.rings[index + 1 :]))

    def transformed(self, matrix: ArrayLike, offset: ArrayLike = (0.0, 0.0)) -> Self:
        """Apply x → M x + offset to every ring."""
        return type(self)(tuple(ring.transformed(matrix, offset) for ring in self.rings))

    def mirrored(self) -> Self:
        """Mirror left to right, in place."""
        left, _, right, _ = self.bounds()
        return self.transformed(((-1.0, 0.0), (0.0, 1.0)), (left + right, 0.0))
