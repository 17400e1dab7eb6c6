"""Unfold a map with a fixed boundary (Garanzha et al. 2021), one Newton step per ε."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from core.fem.energies import FoldoverFree
from core.fem.energies.foldover_free import regularised
from core.fem.newton import FreeVertices, line_search, newton_step
from core.model.outline import Array

VALID = 1e-10
"""Smallest J that counts as unfolded, at unit area."""
MAX_STEPS = 30
"""Most maps unfold in under ten steps; those that need more are better off with another mesh."""
LEAST_FALL, MOST_FALL = 0.1, 0.5
"""ε is lowered as if the energy had fallen by this part at least: cautiously, as in the paper,
while half of the mesh is folded, boldly when little is. That unfolds twice as many maps."""

LEAST = 1e-10
"""Least ε."""

Observe = Callable[[float, Array], None]
"""Called after each step with the energy and the positions (n, 2)."""


def untangle(vertices: FreeVertices, x: Array, observe: Observe) -> Array:
    """Move the free vertices of x (n, 2) until J > 0 everywhere, or steps run out.

    Shapes are expected at unit area.
    """
    elements = vertices.elements
    J = elements.determinants(x)
    epsilon = first_epsilon(J)
    for _ in range(MAX_STEPS):
        if J.min() > VALID:
            break
        density = FoldoverFree(epsilon)
        step = newton_step(vertices, density, x)
        x, after = line_search(elements, density, x, step)
        observe(after, x)
        J = elements.determinants(x)
        epsilon = next_epsilon(epsilon, J, step.energy, after)
    return x


def first_epsilon(J: Array) -> float:
    """Return the ε to begin with."""
    return max(0.2 * abs(float(J.min())), LEAST)


def next_epsilon(epsilon: float, J: Array, before: float, after: float) -> float:
    """Lower ε so far that the energy is sure to fall further (their eq. 8)."""
    lowest, folded = float(J.min()), float(np.mean(J <= 0))
    sigma = max(1 - after / before, MOST_FALL - folded, LEAST_FALL)
    mu = (1 - sigma) * float(regularised(np.array(lowest), epsilon))
    return max(2 * np.sqrt(mu * (mu - lowest)), LEAST) if lowest < mu else LEAST
