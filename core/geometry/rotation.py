"""2 x 2 matrices as rotations and stretches, all in closed form."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

from core.geometry.triangulation import Indices
from core.model.outline import Array

Complex = NDArray[np.complex128]


def to_complex(points: Array) -> Complex:
    """Return points (n, 2) as complex numbers (n,)."""
    return points[:, 0] + 1j * points[:, 1]


def to_points(z: Complex) -> Array:
    """Return complex numbers (n,) as points (n, 2), without a copy."""
    return z.view(float).reshape(-1, 2)


def phasor(angle: Array) -> Complex:
    """Return exp(i angle) (m,).

    One tangent of half the angle takes a fraction of the time of a sine and a cosine.
    """
    half = np.tan(0.5 * angle)
    scale = 2 / (1 + half * half)
    out = np.empty(len(angle), dtype=complex)
    np.subtract(scale, 1, out=out.real)
    np.multiply(half, scale, out=out.imag)
    return out


def unit(z: Complex) -> Complex:
    """Return numbers of size 1 that point as z (m,) does; 1 where z is 0."""
    size = np.abs(z)
    return np.where(size > 0, z / np.where(size > 0, size, 1), 1)


def turn_and_mirror(F: Array) -> tuple[Complex, Complex]:
    """Split F = turn + mirror into the part that commutes with rotations and the part that flips.

    As complex numbers (m,): F acts on z as ``turn * z + mirror * conj(z)``. The signed singular
    values are |turn| ± |mirror|, the second with the sign of det F.
    """
    z = F.astype(complex)
    turn = (z[:, 0, 0] + z[:, 1, 1] + 1j * (z[:, 1, 0] - z[:, 0, 1])) / 2
    mirror = (z[:, 0, 0] - z[:, 1, 1] + 1j * (z[:, 1, 0] + z[:, 0, 1])) / 2
    return turn, mirror


def stretches(turn: Array, mirror: Array) -> tuple[Array, Array]:
    """Return σ₁ ≥ σ₂ > 0 (m,) for |turn| > |mirror| (m,), also where rounding leaves σ₂ nothing."""
    high = turn + mirror
    return high, np.maximum(turn - mirror, np.finfo(float).eps * high)


def signed_singular_values(F: Array) -> tuple[Array, Array]:
    """Return σ₁ ≥ |σ₂| (m,) of F (m, 2, 2), σ₂ with the sign of det F."""
    turn, mirror = turn_and_mirror(F)
    return np.abs(turn) + np.abs(mirror), np.abs(turn) - np.abs(mirror)


def wrap(angle: Array) -> Array:
    """Bring angles into [-π, π)."""
    return np.mod(angle + np.pi, 2 * np.pi) - np.pi


def unwrap(theta: Array, neighbours: Indices, weights: Array) -> Array:
    """Add whole turns so that neighbouring triangles differ by at most π where that is possible.

    ``theta`` (m,), ``neighbours`` (k, 2) pairs, ``weights`` (m,). The pairs are followed from the
    smallest difference up (a minimum spanning tree), so that a doubtful pair decides last. What
    they do not connect with the first triangle stays as it is. The weighted mean is then brought
    into [-π, π).
    """
    m = len(theta)
    i, j = neighbours.T
    cost = np.abs(wrap(theta[j] - theta[i])) + 1e-9  # a zero would count as no edge
    tree = minimum_spanning_tree(coo_array((cost, (i, j)), shape=(m, m)).tocsr())
    _, parent = breadth_first_order(tree, 0, directed=False)
    parent = np.where(parent < 0, np.arange(m), parent)
    turns = np.round((theta[parent] - theta) / (2 * np.pi))
    while (parent != parent[parent]).any():  # sum the turns up to the root, doubling the stride
        turns, parent = turns + turns[parent], parent[parent]
    out = theta + 2 * np.pi * turns
    mean = np.average(out, weights=weights)
    return out - 2 * np.pi * np.floor((mean + np.pi) / (2 * np.pi))
