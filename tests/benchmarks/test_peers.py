"""Peers are compared on one mesh, those that are here; and ours keeps its word on it."""

from dataclasses import replace

import pytest

from core.model import Outline
from tests.benchmarks import peers
from tests.benchmarks.pairs import Pair
from tests.core.shapes import limb

CURLED = Pair("limb → curled", *map(Outline.polygon, (limb(0.0, 24), limb(5.0, 24, curl=2))))


@pytest.fixture(scope="module")
def line():
    absent = [name for name in peers.MODULES if name == "mouette" or name in peers.absent_peers()]
    return peers.compare(CURLED, 64, absent)


def test_ours_untangles_and_polishes_and_leaves_the_boundary_alone(line):
    assert line.folds_start > 0
    best, polished = line.untangled["  and polished"], line.polished["ours"]
    assert best.folds == polished.folds == 0
    assert best.distortion_mean == pytest.approx(polished.distortion_mean, rel=1e-3)
    assert polished.distortion_mean < line.untangled["ours, patient"].distortion_mean
    assert all(each.moved == 0 for each in (*line.untangled.values(), polished))


def test_slim_lowers_the_same_energy(line):
    pytest.importorskip("igl", reason="the extra 'peers' is not installed")
    slim = line.polished["SLIM"]
    assert slim.folds == 0
    assert slim.distortion_mean == pytest.approx(line.polished["ours"].distortion_mean, rel=0.02)


def test_mouette_untangles_the_same_mesh():
    pytest.importorskip("mouette", reason="the extra 'peers' is not installed")
    task = peers.Task.of(CURLED, 64)
    x, seconds = peers.mouette_untangling(task, task.start())
    assert peers.placed(task, x, seconds).folds == 0


def test_the_table_and_the_summary_hold_every_solver_that_is_here(line, tmp_path):
    lines = [line, replace(line, pair="easy", folds_start=0, untangled={})]
    peers.write_table(lines, tmp_path / "table.csv")
    head, *rest = (tmp_path / "table.csv").read_text(encoding="utf-8").splitlines()
    assert len(rest) == 2
    assert all(f"untangling, {name}: ms" in head for name in line.untangled)
    text = peers.summary(lines)
    assert "untangling, from 1 harmonic maps" in text
    assert "polish, from 2 maps" in text
    assert all(name in text for name in (*line.untangled, *line.polished))
