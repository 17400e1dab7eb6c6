"""Pairs of places keep one cyclic order."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.morph.marks.chain import Chain, in_order

places = st.floats(0, 1, exclude_max=True)
pairs = st.lists(st.tuples(places, places), min_size=1, max_size=12)


def turns(values):
    """How often a cyclic sequence falls."""
    return int(np.sum(np.roll(values, -1) <= values))


@given(pairs)
def test_what_is_kept_runs_once_around_both_rings(given_pairs):
    kept = in_order(given_pairs)
    assert kept[0] == given_pairs[0]
    for side in zip(*kept, strict=True):
        assert len(kept) == 1 or turns(np.array(side)) == 1


@given(pairs)
def test_pairs_in_order_are_all_kept(given_pairs):
    kept = in_order(given_pairs)
    assert in_order(kept) == kept


def test_the_earlier_pairs_count():
    assert in_order([(0.0, 0.0), (0.5, 0.5), (0.7, 0.2), (0.8, 0.9)]) == [
        (0.0, 0.0),
        (0.5, 0.5),
        (0.8, 0.9),
    ]


def test_pairs_keep_their_distance_on_both_rings():
    chain = Chain((0.0, 0.0))
    chain.add([(0.5, 0.5), (0.52, 0.7), (0.7, 0.52), (0.97, 0.9), (0.8, 0.8)], apart=0.05)
    assert chain.pairs == [(0.0, 0.0), (0.5, 0.5), (0.8, 0.8)]
