"""The sweep measures what it says, writes all of it, and finds no fold in real shapes."""

import csv
import sys

import numpy as np
import pytest

from core.morph.quality import folds
from tests.benchmarks.measures import area_drift, end_error, jolt, measure
from tests.benchmarks.pairs import Pair, across_classes, kind, load_outlines, within_classes
from tests.core.shapes import ellipse, letter_l, limb, rotation

TURN = 2.6
NOWHERE = np.full((3, 2), np.nan)


def synthetic():
    return [
        Pair("letter → turned", letter_l(), letter_l() @ rotation(TURN).T + [50, -20]),
        Pair("limb → bent", limb(-0.4, 32), limb(2.2, 32)),
    ]


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    pytest.importorskip("PySide6.QtGui", reason="sheets are painted with Qt", exc_type=ImportError)
    from tests.benchmarks.sheet import application
    from tests.benchmarks.sweep import sweep

    app = application()
    folder = tmp_path_factory.mktemp("sweep")
    pairs = [*synthetic(), Pair("letter → nowhere", letter_l(), NOWHERE)]
    yield folder, sweep(pairs, 9, folder)
    del app


def test_the_table_has_a_line_a_pair_and_the_reason_where_one_is_refused(swept):
    folder, text = swept
    with (folder / "table.csv").open(encoding="utf-8") as file:
        lines = {line["pair"]: line for line in csv.DictReader(file)}
    assert list(lines) == ["letter → turned", "limb → bent", "letter → nowhere"]
    assert [bool(line["refused"]) for line in lines.values()] == [False, False, True]
    turned, bent, _ = lines.values()
    assert float(turned["distortion_mean"]) == pytest.approx(1)
    assert float(bent["distortion_mean"]) > 1.001
    assert all(float(line["ms_placement"]) > 0 for line in (turned, bent))
    assert "3 pairs, 1 refused" in text
    assert text == (folder / "summary.txt").read_text(encoding="utf-8")


def test_the_sheets_show_every_pair_and_the_worst_first(swept):
    from PySide6.QtGui import QImage

    from tests.benchmarks.sheet import TITLE
    from tests.benchmarks.sweep import SIDE

    folder, _ = swept
    sheet, worst = (QImage(str(folder / name)) for name in ("sheet-01.png", "worst.png"))
    assert (sheet.width(), sheet.height()) == (9 * SIDE, 2 * (SIDE + TITLE))
    first, second = ((0, y, sheet.width(), SIDE + TITLE) for y in (0, SIDE + TITLE))
    assert worst.copy(*first) == sheet.copy(*second)
    assert worst.copy(*second) == sheet.copy(*first)


def test_a_turned_letter_is_measured_as_rigid_while_straight_paths_shrink_it():
    row, morph = measure(synthetic()[0], frames=9)
    assert row.triangles == len(morph.triangles)
    assert row.end_error < 1e-12
    assert row.folds_source == row.folds_target == row.folded_frames == 0
    assert row.crossing == ()
    assert row.area_drift < 1e-6
    assert row.linear_area_drift == pytest.approx(np.sin(TURN / 2) ** 2)  # at its least halfway


def test_the_end_error_sees_a_missed_vertex_and_one_that_left_the_outline():
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    split = np.array([[0.0, 0], [2, 0], [4, 0], [4, 4], [0, 4]])
    ring = [np.arange(5)]
    assert end_error(square, split, ring) == 0
    assert end_error(square, split + np.eye(5)[1][:, None] * [0, 1], ring) == pytest.approx(0.25)
    assert end_error(square, split + np.eye(5)[3][:, None] * [0, -1], ring) == pytest.approx(0.25)


def test_the_jolt_is_the_change_of_velocity_where_a_vertex_turns_its_corner():
    times = np.linspace(0, 1, 5)
    steady = times[:, None, None] * np.array([[1.0, 0], [0, 3]])
    assert jolt(steady, times) == pytest.approx(0, abs=1e-12)
    corner = np.stack([times, np.maximum(0, times - 0.5)], axis=1)[:, None]
    assert jolt(corner, times) == pytest.approx(1)


def test_the_area_drift_is_none_while_the_area_grows_steadily():
    times, ring = np.linspace(0, 1, 5), [np.arange(40)]
    grown = np.sqrt(1 + 3 * times)[:, None, None] * ellipse()
    assert area_drift(grown, times, ring) == pytest.approx(0, abs=1e-12)
    dented = grown * np.array([1, 1, np.sqrt(0.9), 1, 1])[:, None, None]
    assert area_drift(dented, times, ring) == pytest.approx(0.1)


def test_pairs_within_classes_join_each_even_instance_to_the_next():
    outlines = {f"cup-{k:02}": letter_l() for k in (0, 1, 3, 4, 5)} | {"fly-01": letter_l()}
    assert [pair.name for pair in within_classes(outlines)] == [
        "cup-00 → cup-01",
        "cup-04 → cup-05",
    ]


def test_pairs_across_classes_join_different_classes_and_are_the_same_each_time():
    outlines = {f"{name}-{k:02}": letter_l() for name in ("cup", "fly", "key") for k in range(3)}
    names = [pair.name for pair in across_classes(outlines, 20)]
    assert names == [pair.name for pair in across_classes(outlines, 20)]
    assert len(set(names)) > 5
    assert all(len({kind(end) for end in name.split(" → ")}) == 2 for name in names)


def test_without_the_outlines_the_command_says_so_and_fails(monkeypatch, tmp_path, capsys):
    sweep = pytest.importorskip("tests.benchmarks.sweep", exc_type=ImportError)
    monkeypatch.setattr(sweep, "OUTLINES", tmp_path / "absent.npz")
    monkeypatch.setattr(sys, "argv", ["sweep"])
    with pytest.raises(SystemExit) as stopped:
        sweep.main()
    assert stopped.value.code == sweep.ABSENT
    assert str(tmp_path / "absent.npz") in capsys.readouterr().err


@pytest.mark.sweep
@pytest.mark.timeout(900)
def test_real_pairs_have_exact_ends_and_no_fold_in_any_frame(shared_data):
    pairs = within_classes(load_outlines(shared_data / "mpeg7_outlines.npz"))
    assert len(pairs) == 324
    broken = []
    for pair in pairs[::6]:
        row, morph = measure(pair, frames=33)
        ends = [len(folds(morph.at(s), morph.triangles)) for s in (0.0, 1.0)]
        assert ends == [row.folds_source, row.folds_target]
        if sum(ends) or row.folded_frames or row.end_error > 1e-9:
            broken.append(row)
    assert broken == []
