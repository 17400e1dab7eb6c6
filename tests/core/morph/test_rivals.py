"""Which of several rivals is taken; they are compared by sketches where outlines are very fine."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import core
from core.errors import SolveError
from core.model import Recipe
from core.model.outline import Array
from core.morph import rivals
from core.morph.boundary import BoundaryPair
from core.morph.correspondence import Correspondence, Matching, Way
from core.morph.mapping import Map
from core.morph.rivals import SKETCH, Basis, Choice, choose
from core.progress import unwatched
from tests.core.morph.polygons import comb, disc

BASES = (Basis(np.zeros(2), 1.0), Basis(np.zeros(2), 1.0))
COUNT = 5 * SKETCH


def chosen(*targets: Array) -> Choice:
    """Choose among ways to map a comb."""
    source = comb(3, COUNT)
    ways = [
        Correspondence(Matching(()), [BoundaryPair(source, target)], (0.1, 0.1), ())
        for target in targets
    ]
    return choose([Way(0.0, lambda way=way: way) for way in ways], BASES, Recipe(), unwatched)


def test_the_better_of_two_finely_drawn_rivals_is_taken_and_mapped_with_all_its_vertices() -> None:
    good = comb(3, COUNT)
    choice = chosen(np.roll(good, COUNT // 7, axis=0), good)
    assert choice.tried == 2
    assert choice.taken.boundaries[0].target is good
    assert np.array_equal(choice.map.target[:COUNT], good)
    assert choice.map.mean == pytest.approx(1, abs=1e-6)


def test_only_the_rival_that_is_taken_is_mapped_with_all_its_vertices(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    sizes: list[int] = []

    def direct_map(source: list[Array], *rest: object) -> Map:
        sizes.append(len(source[0]))
        return original(source, *rest)  # type: ignore[arg-type]

    original = rivals.direct_map
    monkeypatch.setattr(rivals, "direct_map", direct_map)
    good = comb(3, COUNT)
    chosen(np.roll(good, COUNT // 7, axis=0), good)
    assert sizes == [SKETCH, SKETCH, COUNT]


def test_a_way_that_cannot_be_the_best_is_not_followed() -> None:
    source = comb(3, 40)
    followed = []

    def way(misfit: float) -> Way:
        def follow() -> Correspondence:
            followed.append(misfit)
            return Correspondence(Matching(()), [BoundaryPair(source, source)], (0.1, 0.1), ())

        return Way(misfit, follow)

    assert choose([way(0.0), way(0.1)], BASES, Recipe(), unwatched).tried == 1
    assert followed == [0.0]


def test_ways_that_contradict_themselves_are_passed_over() -> None:
    source = comb(3, 40)
    sound = Correspondence(Matching(()), [BoundaryPair(source, source)], (0.1, 0.1), ())
    ways = [Way(0.0, lambda: None), Way(0.1, lambda: sound)]
    assert choose(ways, BASES, Recipe(), unwatched).taken is sound
    with pytest.raises(SolveError):
        choose(ways[:1], BASES, Recipe(), unwatched)


def test_a_way_whose_first_map_folds_wins_by_what_sliding_makes_of_it(shared_data: Path) -> None:
    shapes = np.load(shared_data / "mpeg7_outlines.npz")
    source, target = (shapes[name].astype(float) for name in ("lizard-08", "lizard-09"))
    assert core.solve(source, target).report.distortion_mean < 3  # tail to tail; else above 5


def test_a_sketch_that_would_cross_itself_is_not_used() -> None:
    """Every fifth vertex of this disc lies far outside on the wrong side."""
    turned = disc(COUNT).copy()
    turned[5::10] *= -0.9
    assert rivals._sketched(([disc(COUNT)], [turned])) is None
    assert rivals._sketched(([disc(COUNT)], [disc(COUNT)])) is not None
    assert rivals._sketched(([disc(40)], [disc(40)])) is None


def test_what_matches_nearly_as_well_upright_is_not_turned_upside_down() -> None:
    """A one has its foot where a seven has its bar, and both are bent the same way round."""
    one = [(4, 0), (6, 0), (6, 9), (8.5, 9), (8.5, 10.5), (1.5, 10.5), (1.5, 9), (4, 9)]
    one += [(4, 2.2), (1.8, 2.8), (1.8, 1.2)]
    seven = [(1, 0), (9, 0), (9, 1.2), (4.6, 10.5), (2.6, 10.5), (6.8, 1.7), (1, 1.7)]
    assert abs(core.solve(np.array(one), np.array(seven)).angle) < np.pi / 6
