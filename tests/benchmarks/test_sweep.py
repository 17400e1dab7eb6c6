"""The sweep writes what it found of every pair, and finds no fold in real shapes."""

import csv
import sys

import numpy as np
import pytest

from core.model import Outline
from core.morph.quality import folds
from tests.benchmarks.pairs import Pair, load_outlines, within_classes
from tests.core.shapes import letter_l, limb, rotation

pytest.importorskip("PySide6.QtGui", reason="sheets are painted with Qt", exc_type=ImportError)

from PySide6.QtGui import QImage

from tests.benchmarks import sweep
from tests.benchmarks.measures import OWN, measure
from tests.benchmarks.sheet import TITLE
from tests.benchmarks.summary import summary
from tests.benchmarks.survey import Plan, survey

FLAG = np.array([[0, 0], [1, 0], [5, 1], [5, 3], [1, 2.5], [1, 8], [0, 8]])
NOWHERE = Outline.polygon(np.full((3, 2), np.nan))


def pairs():
    letter = Outline.polygon(letter_l())
    return [
        Pair("letter → turned", letter, Outline.polygon(letter_l() @ rotation(2.6).T)),
        Pair("limb → bent", Outline.polygon(limb(-0.4, 32)), Outline.polygon(limb(2.2, 32))),
        Pair("letter → nowhere", letter, NOWHERE),
    ]


@pytest.fixture(scope="module")
def swept(qapp, tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    return folder, sweep.sweep(pairs(), Plan(frames=9, given_marks=True), folder)


def test_the_table_has_a_line_a_pair_and_the_reason_where_one_is_refused(swept):
    folder, text = swept
    with (folder / "table.csv").open(encoding="utf-8") as file:
        lines = {line["pair"]: line for line in csv.DictReader(file)}
    assert list(lines) == ["letter → turned", "limb → bent", "letter → nowhere"]
    assert [bool(line["refused"]) for line in lines.values()] == [False, False, True]
    turned, bent, _ = lines.values()
    assert float(turned["distortion_mean"]) == pytest.approx(1)
    assert float(bent["distortion_mean"]) > 1.001
    assert all(float(line["ms placement"]) > 0 for line in (turned, bent))
    assert all(float(line["marks given: ms"]) > 0 for line in (turned, bent))
    assert "3 pairs, 1 refused" in text
    assert text == (folder / "summary.txt").read_text(encoding="utf-8")


def test_the_summary_compares_our_motion_with_the_others(swept):
    _, text = swept
    lines = {line[:22].strip(): line[22:] for line in text.splitlines()}
    assert {OWN, "straight paths", "lengths and angles"} <= lines.keys()


def test_the_sheets_show_every_pair_and_the_worst_first(swept):
    folder, _ = swept
    sheet, worst = (QImage(str(folder / name)) for name in ("sheet-01.png", "worst.png"))
    assert (sheet.width(), sheet.height()) == (9 * sweep.SIDE, 2 * (sweep.SIDE + TITLE))
    first, second = ((0, y, sheet.width(), sweep.SIDE + TITLE) for y in (0, sweep.SIDE + TITLE))
    assert worst.copy(*first) == sheet.copy(*second)
    assert worst.copy(*second) == sheet.copy(*first)


def test_where_a_mirror_is_offered_the_distortion_with_it_is_measured_too():
    flag = Outline.polygon(FLAG)
    found = survey(Plan(frames=3), Pair("flag → mirrored", flag, flag.mirrored()))
    assert found.row.mirror
    assert found.row.distortion_mean > 1.3
    assert found.row.distortion_accepted == pytest.approx(1)
    assert "  with mirrors offered" in summary([found.row], [])


def test_without_the_outlines_the_command_says_so_and_fails(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(sweep, "OUTLINES", tmp_path / "absent.npz")
    monkeypatch.setattr(sys, "argv", ["sweep"])
    with pytest.raises(SystemExit) as stopped:
        sweep.main()
    assert stopped.value.code == sweep.ABSENT
    assert str(tmp_path / "absent.npz") in capsys.readouterr().err


@pytest.mark.sweep
@pytest.mark.timeout(900)
def test_real_pairs_have_exact_ends_and_no_fold_in_any_frame(shared_data):
    found = within_classes(load_outlines(shared_data / "mpeg7_outlines.npz"))
    assert len(found) == 324
    broken = []
    for pair in found[::6]:
        row, morph = measure(pair, frames=33)
        ends = [len(folds(morph.at(s), morph.triangles)) for s in (0.0, 1.0)]
        assert ends == [row.folds_source, row.folds_target]
        if sum(ends) or row.folded_frames or row.end_error > 1e-9:
            broken.append(row)
    assert broken == []
