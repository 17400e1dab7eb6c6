"""An in-between as an outline that can be edited: with the nodes of its keys, and few others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core.geometry.crossing import crosses_itself
from core.geometry.flatten import flatten
from core.geometry.polyline import diagonal
from core.geometry.redraw import corners, redraw
from core.model import Outline
from core.model.outline import MIN_NODES, Array
from core.morph.morph import Morph

TOLERANCE = 3e-4
"""How far the outline may stray, as a fraction of its diagonal: 0.3 pixels in 1000."""
SAME_PLACE = 1e-7
"""A vertex this close to a node, as a fraction of the diagonal, is that node."""


def redrawn(morph: Morph, positions: Array, source: Outline, target: Outline) -> Outline:
    """Return an in-between, whose vertices are at (n, 2) positions, drawn anew.

    All nodes of the source stay nodes, and those of the target where there is a corner. What would
    cross itself is left as it is: with a node at every vertex.
    """
    plain = Outline.polygon(*(positions[ring] for ring in morph.rings))
    size = diagonal(np.concatenate([ring.points for ring in plain.rings]))
    rings = []
    for ring, whole in zip(morph.rings, plain.rings, strict=True):
        kept = _at_nodes(morph.rest[ring], source)
        kept |= _at_nodes(morph.target[ring], target) & corners(whole.points)
        nodes = np.flatnonzero(kept).tolist()
        enough = len(nodes) >= MIN_NODES
        rings.append(redraw(whole.points, nodes, TOLERANCE * size) if enough else whole)
    drawn = Outline(tuple(rings))
    return plain if crosses_itself([line.points for line in flatten(drawn)]) else drawn


def _at_nodes(vertices: Array, outline: Outline) -> NDArray[np.bool_]:
    """Return (n,) whether a node of an outline lies at each of (n, 2) vertices."""
    from scipy.spatial import KDTree  # loads with the first key that is inserted

    nodes = np.concatenate([ring.points for ring in outline.rings])
    distances, _ = KDTree(nodes).query(vertices)
    return distances <= SAME_PLACE * diagonal(vertices)
