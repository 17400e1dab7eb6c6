"""Outlines for tests: made by formula, none of them drawn by anybody."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

Array = np.ndarray


def rotation(angle: float) -> Array:
    """Return the 2 x 2 rotation by an angle."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


def ellipse(n: int = 40, a: float = 2.0, b: float = 1.0) -> Array:
    """Return points of an ellipse."""
    t = 2 * np.pi * np.arange(n) / n
    return np.column_stack([a * np.cos(t), b * np.sin(t)])


def letter_l() -> Array:
    """Return an L: no symmetry, one reflex corner."""
    return np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 5], [0, 5]], dtype=float)


def limb(
    bend: float, n: int = 16, length: float = 6.0, width: float = 1.0, curl: float = 1.0
) -> Array:
    """Return a bar bent by an angle: into an arc, or with ``curl`` > 1 more and more to its end."""
    s = np.linspace(0, 1, n)
    angle = bend * s**curl
    step = length / (n - 1)
    middle = np.cumsum(np.column_stack([np.cos(angle), np.sin(angle)]) * step, axis=0)
    normal = np.column_stack([-np.sin(angle), np.cos(angle)]) * width / 2
    return np.vstack([middle - normal, (middle + normal)[::-1]])


def comb(teeth: int = 4) -> Array:
    """Return a comb: a bar with narrow teeth."""
    points = [(0.0, -1.0), (2.0 * teeth, -1.0)]
    for i in reversed(range(teeth)):
        points += [(2.0 * i + 2, 0), (2.0 * i + 1.5, 4), (2.0 * i + 1, 0)]
    return np.array([*points, (0.0, 0.0)])


def square_ring(hole: float = 0.5) -> list[Array]:
    """Return a square with a square hole."""
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
    return [2 * square, 2 * hole * square]


@st.composite
def star_shaped(draw: st.DrawFn, least: int = 5, most: int = 24) -> Array:
    """Draw a simple polygon that its own origin sees whole."""
    n = draw(st.integers(least, most))
    radius = draw(st.lists(st.floats(0.4, 2.0), min_size=n, max_size=n))
    gap = draw(st.lists(st.floats(0.5, 1.5), min_size=n, max_size=n))
    angle = 2 * np.pi * np.cumsum(gap) / np.sum(gap)
    return np.array(radius)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
