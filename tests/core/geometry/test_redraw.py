"""A polygon drawn again with few nodes."""

from __future__ import annotations

import numpy as np
import pytest

from core.geometry.redraw import redraw

ANGLES = np.linspace(0, 2 * np.pi, 60, endpoint=False)
CIRCLE = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("node", [14, 15, 16])
def test_a_vertex_that_is_there_twice_is_passed_as_if_it_were_once(node: int) -> None:
    twice = np.insert(CIRCLE, 15, CIRCLE[15], axis=0)
    ring = redraw(twice, [0, node, 30, 45], 0.01)
    points = ring.points
    np.testing.assert_allclose(np.hypot(*points.T), 1.0, atol=0.01)
