from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import FileError
from core.io import importers

TRIANGLE = [[0.0, 0.0], [4.0, 0.5], [1.0, 3.0]]
HOLE = [[1.0, 0.6], [2.0, 0.8], [1.2, 1.5]]
APART = [[10.0, 10.0], [14.0, 10.0], [12.0, 13.0]]
NUMBERS = st.floats(-1e6, 1e6)


def read(folder: Path, name: str, content: str | bytes) -> list[importers.Part]:
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return importers.read(path)


def refusal(folder: Path, name: str, content: str | bytes) -> str:
    with pytest.raises(FileError) as caught:
        read(folder, name, content)
    assert caught.value.where.path == str(folder / name)
    return caught.value.what


def only_ring(parts: list[importers.Part]) -> list[list[float]]:
    [part] = parts
    [ring] = part.outline.rings
    return ring.points.tolist()


def test_rings_that_cross_each_other_all_stay(tmp_path: Path) -> None:
    """The second is mostly inside the first; the third lies inside the second, not the first."""
    first = [[0, 0], [10, 0], [10, 10], [0, 10]]
    second = [[9, 1], [8, 1], [7, 1], [6, 1], [6, 5], [6, 9], [7, 9], [8, 9], [14, 9], [14, 1]]
    third = [[11, 4], [13, 4], [13, 6], [11, 6]]
    parts = read(tmp_path, "crossing.json", json.dumps([first, second, third]))
    assert sum(len(part.outline.rings) for part in parts) == 3


def lines(points: list[list[float]], separator: str) -> str:
    return "\n".join(f"{x}{separator}{y}" for x, y in points)


# -- text --------------------------------------------------------------------------------------


@pytest.mark.parametrize("separator", [",", ";", "\t", " ", " , ", "; "])
@pytest.mark.parametrize("header", ["", "x,y\n", "# a comment\n", "\ufeff"])
def test_any_separator_with_or_without_header_reads_the_same(
    tmp_path: Path, separator: str, header: str
) -> None:
    parts = read(tmp_path, "shape.csv", header + lines(TRIANGLE, separator))
    assert only_ring(parts) == TRIANGLE
    assert parts[0].name == "shape"


def test_the_last_point_may_repeat_the_first(tmp_path: Path) -> None:
    assert only_ring(read(tmp_path, "a.csv", lines([*TRIANGLE, TRIANGLE[0]], ","))) == TRIANGLE


@pytest.mark.parametrize("separator", [";", "\t", " "])
def test_decimal_commas_are_understood_where_they_are_clear(tmp_path: Path, separator: str) -> None:
    text = lines(TRIANGLE, separator).replace(".", ",")
    assert only_ring(read(tmp_path, "a.txt", text)) == TRIANGLE


def test_a_header_says_which_columns_to_take(tmp_path: Path) -> None:
    text = "id,Y,X,note\n" + "\n".join(f"{i},{y},{x},n" for i, (x, y) in enumerate(TRIANGLE))
    assert only_ring(read(tmp_path, "a.csv", text)) == TRIANGLE


def test_columns_are_never_guessed_among_more_than_two(tmp_path: Path) -> None:
    text = "id,lon,lat\n" + "\n".join(f"{i},{x},{y}" for i, (x, y) in enumerate(TRIANGLE))
    assert "Line 2: expected two numbers, found 3 columns" in refusal(tmp_path, "a.csv", text)


@pytest.mark.parametrize(
    "first", ["A title of some words", "  # a comment\n  # and another", "A title\nx y"]
)
def test_a_line_of_words_before_the_points_is_passed_over(tmp_path: Path, first: str) -> None:
    text = f"{first}\n{lines(TRIANGLE, ' ')}"
    assert only_ring(read(tmp_path, "a.txt", text)) == TRIANGLE


def test_what_follows_a_hash_is_a_comment(tmp_path: Path) -> None:
    text = "# first\n" + lines(TRIANGLE, ",").replace("\n", " # a corner\n# between\n")
    assert only_ring(read(tmp_path, "a.txt", text)) == TRIANGLE


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_text_of_any_unicode_is_read(tmp_path: Path, encoding: str) -> None:
    text = f"Füße\n{lines(TRIANGLE, ',')}"
    assert only_ring(read(tmp_path, "a.csv", text.encode(encoding))) == TRIANGLE


def test_a_blank_line_begins_a_ring_and_a_ring_inside_is_a_hole(tmp_path: Path) -> None:
    text = "\n\n\n".join(lines(ring, ",") for ring in (TRIANGLE, HOLE, APART))
    first, second = read(tmp_path, "a.csv", text)
    assert [ring.points.tolist() for ring in first.outline.rings] == [TRIANGLE, HOLE]
    assert [ring.points.tolist() for ring in second.outline.rings] == [APART]
    assert (first.name, second.name) == ("a (1)", "a (2)")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0,0\n1,zwei\n1,1", "Line 2: 'zwei' is not a number."),
        ("x,y\n0,0\n\n1", "Line 4: expected two numbers, found 1."),
        ("0,0\n1,nan\n1,1", "Line 2: the point is not finite, or too far away."),
        ("0,0\n1,1e300\n1,1", "Line 2: the point is not finite, or too far away."),
        ("0,0\n1,1e999\n1,1", "Line 2: the point is not finite, or too far away."),
        ("0,0,0\n1,1,1", "Line 1: expected two numbers, found 3 columns."),
        ("", "The file holds no points."),
        ("x,y\n", "The file holds no points."),
        ("0,0\n1,1", "Ring 1 has 2 points; an outline needs at least 3."),
        ("1,1\n1,1\n1,1\n1,1", "All points of ring 1 are the same."),
        (b"\xff\xfe\x00", "This is not a text file."),
    ],
)
def test_an_error_names_the_line(tmp_path: Path, text: str | bytes, said: str) -> None:
    assert refusal(tmp_path, "a.csv", text) == said


@given(st.lists(st.tuples(NUMBERS, NUMBERS), min_size=3, max_size=9, unique=True))
def test_written_points_come_back_to_the_last_bit(
    tmp_path_factory: pytest.TempPathFactory, points: list[tuple[float, float]]
) -> None:
    folder = tmp_path_factory.mktemp("points")
    expected = [list(point) for point in points]
    assert only_ring(read(folder, "a.csv", lines(expected, ","))) == expected
    assert only_ring(read(folder, "a.json", json.dumps(expected))) == expected


# -- JSON --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "content", [TRIANGLE, [TRIANGLE], {"points": TRIANGLE}, {"rings": [TRIANGLE], "by": "hand"}]
)
def test_every_form_of_json_reads_the_same(tmp_path: Path, content: object) -> None:
    assert only_ring(read(tmp_path, "a.json", json.dumps(content))) == TRIANGLE


def test_rings_of_json_are_nested_or_parts(tmp_path: Path) -> None:
    first, second = read(tmp_path, "a.json", json.dumps({"rings": [HOLE, APART, TRIANGLE]}))
    assert [len(part.outline.rings) for part in (first, second)] == [1, 2]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[[0, 0],\n [1, 0}]", "Line 2, column 7: Expecting ',' delimiter."),
        ("[[0, 0], [1, 0], [1]]", "[2]: expected a point [x, y], found [1]."),
        ("[[0, NaN], [1, 0]]", "[0]: expected a point [x, y], found [0, NaN]."),
        ("[[0, 0, 0], [1, 0, 0]]", "[0]: expected a point [x, y], found [0, 0, 0]."),
        ("[[0, 0], [1, NaN]]", "[1]: expected a point [x, y], found [1, NaN]."),
        ('{"rings": [[[0, 0], ["a"]]]}', 'rings[0][1]: expected a point [x, y], found ["a"].'),
        ("[[0, 0], [true, 1]]", "[1]: expected a point [x, y], found [true, 1]."),
        ("[[0, 0], [1" + "0" * 400 + ", 1]]", None),
        ("[[0, 0], [1" + "0" * 5000 + ", 1]]", None),
        ("[" * 100_000, None),
        ("{}", None),
        ("[]", None),
        ("7", None),
        ("", None),
        (b"\xff", None),
    ],
)  # fmt: skip
def test_an_error_in_json_names_the_place(
    tmp_path: Path, text: str | bytes, said: str | None
) -> None:
    assert refusal(tmp_path, "a.json", text) == said if said else refusal(tmp_path, "a.json", text)


# -- the registry ------------------------------------------------------------------------------


def test_an_unknown_format_is_refused_with_the_known_ones(tmp_path: Path) -> None:
    said = refusal(tmp_path, "a.docx", "")
    assert ".svg" in said
    assert ".csv" in said


def test_every_format_offers_a_file_dialog_entry() -> None:
    assert [entry.filter for entry in importers.FORMATS] == [
        "SVG drawing (*.svg)",
        "Point list (*.csv *.tsv *.txt)",
        "JSON point list (*.json)",
    ]


def test_a_file_that_is_not_there_says_so(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="No such file"):
        importers.read(tmp_path / "missing.csv")


def test_files_beyond_the_limits_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("core.io.importers.points.MAX_NODES", 2)
    assert "more than 2 points" in refusal(tmp_path, "a.csv", lines(TRIANGLE, ","))
    monkeypatch.setattr(importers, "MAX_BYTES", 3)
    assert "larger than" in refusal(tmp_path, "a.csv", lines(TRIANGLE, ","))


# -- onto the artboard -------------------------------------------------------------------------


def test_fitted_parts_keep_their_proportions_and_lie_in_the_middle(tmp_path: Path) -> None:
    text = "\n\n".join(lines(ring, ",") for ring in (TRIANGLE, APART))
    parts = read(tmp_path, "a.csv", text)
    placed = importers.fitted(parts, (400, 300))
    before, after = (
        np.concatenate([part.outline.rings[0].points for part in group])
        for group in (parts, placed)
    )
    scale = np.ptp(after, axis=0) / np.ptp(before, axis=0)
    assert scale[0] == pytest.approx(scale[1])
    assert (after.min(axis=0) + after.max(axis=0)) / 2 == pytest.approx([200, 150])
    assert (np.ptp(after, axis=0) < [400, 300]).all()
