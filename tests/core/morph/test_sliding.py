"""Boundaries that slide: less distortion, the same outlines."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from core.errors import Cancelled
from core.geometry.triangulation import Mesh
from core.model import Outline, Recipe, RingPoint
from core.model.outline import Array
from core.morph.mapping import direct_map
from core.morph.pipeline import solve_outlines
from core.morph.sliding import slide
from core.progress import unwatched
from tests.core.morph.polygons import comb
from tests.core.shapes import limb

LONG, WIDE, STEPS = 8.0, 0.5, 24
RECIPE = Recipe(density=40)
COUNT = 72


def bar(middle_below: float, middle_above: float) -> Array:
    """Return (k, 2) a bar; the vertices in the middle of its long sides are where it is said."""
    once = np.linspace(0, LONG, STEPS + 1)
    below, above = (
        np.interp(once, [0, LONG / 2, LONG], [0, LONG / 2 + middle, LONG])
        for middle in (middle_below, middle_above)
    )
    sides = np.column_stack([below, 0 * once]), np.column_stack([above, 0 * once + WIDE])
    return np.concatenate([sides[0], sides[1][::-1]])


def mapped(source: Array, target: Array) -> tuple[Mesh, Array]:
    found = direct_map([source], [target], RECIPE, unwatched)
    assert found.sound
    return found.mesh, found.target


def straightened(mesh: Mesh, target: Array) -> tuple[Array, Array]:
    """Return both boundaries (k, 2) after sliding."""
    [places] = slide(mesh, target, unwatched)
    ring = mesh.rings[0]
    found = []
    for points, at in zip((mesh.points[ring], target[ring]), places.T, strict=True):
        closed = np.vstack([points, points[:1]])
        lengths = np.append(0, np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1)))
        at = np.mod(at, 1) * lengths[-1]
        found.append(np.column_stack([np.interp(at, lengths, c) for c in closed.T]))
    return found[0], found[1]


def test_a_sheared_limb_comes_to_rest_without_shear() -> None:
    here, there = bar(0, 0), bar(-1, 1)
    assert np.abs(there - here).max() > 0.9
    for _ in range(6):
        here, there = straightened(*mapped(here, there))
    # both ends are the same bar, so that without shear every place belongs to itself
    assert np.abs(there - here).max() < 0.1


def test_a_map_with_folds_slides_to_one_with_fewer() -> None:
    source, target = comb(4, COUNT), np.roll(comb(4, COUNT), 3, axis=0)
    before = direct_map([source], [target], RECIPE, unwatched)
    after = direct_map(
        *([end] for end in straightened(before.mesh, before.target)), RECIPE, unwatched
    )
    assert after.folds < before.folds / 2


def test_what_is_at_rest_stays() -> None:
    mesh, target = mapped(bar(0, 0), bar(0, 0))
    [places] = slide(mesh, target, unwatched)
    assert places[:, 0] == pytest.approx(places[:, 1], abs=1e-6)


def test_the_source_stays_and_the_target_keeps_to_its_outline() -> None:
    mesh, target = mapped(bar(0, 0), bar(-0.5, 0.5))
    here, there = straightened(mesh, target)
    assert here == pytest.approx(mesh.points[mesh.rings[0]], abs=1e-9)
    outline = shapely.LinearRing(target[mesh.rings[0]])
    assert shapely.distance(outline, shapely.points(there)).max() < 1e-9


def test_places_keep_their_order() -> None:
    mesh, target = mapped(bar(0, 0), bar(-1.5, 1.2))
    [places] = slide(mesh, target, unwatched)
    assert (np.diff(np.vstack([places, places[:1] + 1]), axis=0) > 0).all()


def test_sliding_can_be_stopped_before_every_step() -> None:
    mesh, target = mapped(bar(0, 0), bar(-1, 1))
    calls: list[str] = []
    slide(mesh, target, calls.append)
    assert len(calls) > 2

    def stop(stage: str) -> None:
        calls.pop()
        if not calls:
            raise Cancelled

    with pytest.raises(Cancelled):
        slide(mesh, target, stop)


def test_a_limb_that_bends_the_other_way_is_not_sheared_between_its_ends() -> None:
    bent = [Outline.polygon(limb(bend, n=40, width=0.6)) for bend in (3.0, -3.0)]
    ends = [(RingPoint(0, float(k)),) * 2 for k in (0, 39, 40, 79)]
    by_length = solve_outlines(*bent, ends)
    slid = solve_outlines(*bent)
    assert slid.report.distortion_mean - 1 < 0.5 * (by_length.report.distortion_mean - 1)


def test_marks_of_the_artist_do_not_slide() -> None:
    bent = [Outline.polygon(limb(bend, n=40, width=0.6)) for bend in (3.0, -3.0)]
    report = solve_outlines(*bent, [(RingPoint(0, 0.0), RingPoint(0, 0.0))]).report
    assert report.distortion_mean > 1.2
    assert "sliding" not in [stage.name for stage in report.stages]
