from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from shapely import LineString, Polygon

from core.geometry.polyline import signed_area
from core.morph.compatible.bridges import cut_open
from tests.core.morph.compatible.test_overlay import HOLES
from tests.core.morph.polygons import disc


def test_an_outline_without_holes_is_left_as_it_is() -> None:
    cut = cut_open([disc(20)], [disc(20)])
    assert np.array_equal(cut.walk, np.arange(20))
    assert np.array_equal(cut.source, disc(20))


@pytest.mark.parametrize("name", HOLES)
def test_the_cut_goes_along_every_ring_once_and_every_bridge_there_and_back(name: str) -> None:
    cut = cut_open(*HOLES[name])
    steps = Counter(zip(cut.walk.tolist(), np.roll(cut.walk, -1).tolist(), strict=True))
    assert set(steps.values()) == {1}
    for ring in cut.rings:
        for step in zip(ring.tolist(), np.roll(ring, -1).tolist(), strict=True):
            assert steps.pop(step) == 1
    assert all((j, i) in steps for i, j in steps)


@pytest.mark.parametrize("name", HOLES)
@pytest.mark.parametrize("end", [0, 1])
def test_the_cut_polygon_has_the_outline_s_area_and_stays_inside_it(name: str, end: int) -> None:
    rings = HOLES[name][end]
    cut = cut_open(*HOLES[name])
    polygon = (cut.source, cut.target)[end][cut.walk]
    assert signed_area(polygon) == pytest.approx(sum(map(signed_area, rings)))
    outline = Polygon(rings[0], rings[1:]).buffer(1e-9)
    assert outline.covers(LineString(np.vstack([polygon, polygon[:1]])))
