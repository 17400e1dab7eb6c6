"""Long runs of a boundary, which spare looking at their edges one by one."""

import numpy as np
import pytest

from core.geometry.rotation import Complex, to_complex
from core.morph.motion import runs
from core.morph.motion.contact import Contact
from tests.core.morph.motion.test_contact import UNCURLING, prongs
from tests.core.shapes import Array, rotation

FINE = 24
"""Parts of each edge: the boundary has some 2,400."""


def fine(ring: Array) -> Complex:
    parts = np.linspace(0, 1, FINE, endpoint=False)[:, None, None]
    edges = np.roll(ring, -1, axis=0) - ring
    points = (ring + parts * edges).transpose(1, 0, 2).reshape(-1, 2)
    return to_complex(np.ascontiguousarray(points)) / 3  # at about unit area


ENDS = fine(UNCURLING[0]), fine(UNCURLING[1])
NEARING = [fine(prongs(0, bend, 1) @ rotation(bend).T) for bend in (0.1, 0.15, 0.2)]
"""One prong bends towards the other, while the whole turns."""


def found(monkeypatch: pytest.MonkeyPatch, few: int) -> list[Array]:
    monkeypatch.setattr(runs, "FEW", few)
    contact = Contact([np.arange(len(ENDS[0]))], *ENDS)
    on_the_way = [contact.meeting(*NEARING[k : k + 2]) for k in range(2)]
    return [*on_the_way, *(contact.near(z, 1.2) for z in NEARING)]


@pytest.mark.parametrize("few", [40, 300])
def test_long_runs_leave_out_nothing_that_edges_may_meet(monkeypatch, few):
    by_edges, by_runs = (found(monkeypatch, size) for size in (10**6, few))
    assert all(len(pairs) for pairs in by_edges)
    for one, other in zip(by_edges, by_runs, strict=True):
        assert np.array_equal(one, other)


def test_discs_and_ways_bound_what_every_edge_does():
    here, there = NEARING[0], NEARING[1]
    size = len(here)
    each = runs.Runs(np.arange(size), np.roll(np.arange(size), -1))
    way, discs = each.ways(here, there)[0], each.discs(here)[0]
    width = runs.FINER
    rng = np.random.default_rng(0)
    vertex, edge = rng.integers(0, size, (2, 2000))
    pairs = vertex // width, edge // width
    assert len(discs.centre) == -(-size // width)
    start, stop = (np.array([z[edge], z[(edge + 1) % size]]) for z in (here, there))
    apart = np.abs(here[vertex] - start)
    assert (discs.least(pairs) <= apart + 1e-12).all()
    assert (discs.most(pairs) >= apart - 1e-12).all()
    seen = [
        (z[vertex] - ends) * np.conj((ends[1] - ends[0]) / np.abs(ends[1] - ends[0]))
        for z, ends in ((here, start), (there, stop))
    ]
    assert (way.closing(pairs) >= np.abs(seen[1] - seen[0]) - 1e-12).all()
