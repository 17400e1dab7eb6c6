"""How good a map or a frame is: folds, distortion, angles."""

from __future__ import annotations

import numpy as np

from core.fem.elements import Elements
from core.fem.energies import SymmetricDirichlet
from core.geometry.orientation import orientations
from core.geometry.polyline import cross
from core.geometry.rotation import signed_singular_values
from core.geometry.triangulation import Indices
from core.model.outline import Array


def folds(points: Array, triangles: Indices) -> Indices:
    """Return the indices of triangles without positive area, exactly."""
    return np.flatnonzero(orientations(points, triangles) <= 0)


def distortion(elements: Elements, x: Array) -> Array:
    """Return (m,) symmetric Dirichlet density of each triangle: 1 for an isometry, ∞ if folded."""
    s1, s2 = signed_singular_values(elements.deformation_gradients(x))
    spread = SymmetricDirichlet().value(s1, s2)
    spread[folds(x, elements.triangles)] = np.inf
    return spread


def smallest_angle(points: Array, triangles: Indices) -> float:
    """Return the smallest angle of any triangle, in radians."""
    corners = points[triangles]
    after = np.roll(corners, -1, axis=1) - corners
    before = np.roll(corners, 1, axis=1) - corners
    across, along = cross(after, before), np.einsum("maj,maj->ma", after, before)
    return float(np.arctan2(np.abs(across), along).min())
