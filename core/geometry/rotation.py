"""2 x 2 matrices as rotations and stretches, all in closed form."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

from core.geometry.triangulation import Indices
from core.model.outline import Array


def polar(F: Array) -> tuple[Array, Array]:
    """Split F = R(θ) S with S symmetric: (m, 2, 2) → θ (m,) in (-π, π] and S (m, 2, 2).

    R is the rotation closest to F; S has a negative eigenvalue where det F < 0.
    """
    theta = np.arctan2(F[:, 1, 0] - F[:, 0, 1], F[:, 0, 0] + F[:, 1, 1])
    return theta, rotate(-theta, F)


def rotate(theta: Array, M: Array) -> Array:
    """Return R(θ) M for angles (m,) and matrices (m, 2, 2)."""
    c, s = np.cos(theta)[:, None], np.sin(theta)[:, None]
    out = np.empty_like(M)
    out[:, 0] = c * M[:, 0] - s * M[:, 1]
    out[:, 1] = s * M[:, 0] + c * M[:, 1]
    return out


def signed_svd(F: Array) -> tuple[Array, Array, Array, Array]:
    """Split F = R(α) diag(σ₁, σ₂) R(β)ᵀ with σ₁ ≥ |σ₂| and σ₂ of the sign of det F.

    Returns α, σ₁, σ₂, β, each (m,). The halves of F that turn and that mirror give them directly.
    """
    a, b = F[:, 0, 0] + F[:, 1, 1], F[:, 1, 0] - F[:, 0, 1]
    c, d = F[:, 0, 0] - F[:, 1, 1], F[:, 1, 0] + F[:, 0, 1]
    turn, mirror = np.hypot(a, b) / 2, np.hypot(c, d) / 2
    difference, total = np.arctan2(b, a), np.arctan2(d, c)
    return (total + difference) / 2, turn + mirror, turn - mirror, (total - difference) / 2


def wrap(angle: Array) -> Array:
    """Bring angles into [-π, π)."""
    return np.mod(angle + np.pi, 2 * np.pi) - np.pi


def unwrap(theta: Array, neighbours: Indices, weights: Array) -> Array:
    """Add whole turns so that neighbouring triangles differ by at most π where that is possible.

    ``theta`` (m,), ``neighbours`` (k, 2) pairs that connect all triangles, ``weights`` (m,). The
    pairs are followed from the smallest difference up (a minimum spanning tree), so that a doubtful
    pair decides last. The weighted mean is then brought into [-π, π).
    """
    m = len(theta)
    i, j = neighbours.T
    cost = np.abs(wrap(theta[j] - theta[i])) + 1e-9  # a zero would count as no edge
    tree = minimum_spanning_tree(coo_array((cost, (i, j)), shape=(m, m)).tocsr())
    _, parent = breadth_first_order(tree, 0, directed=False)
    parent = np.where(parent < 0, np.arange(m), parent)
    turns = np.round((theta[parent] - theta) / (2 * np.pi))
    while parent.any():  # sum the turns up to the root, doubling the stride
        turns, parent = turns + turns[parent], parent[parent]
    out = theta + 2 * np.pi * turns
    mean = np.average(out, weights=weights)
    return out - 2 * np.pi * np.floor((mean + np.pi) / (2 * np.pi))
