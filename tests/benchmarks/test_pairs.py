"""The pairs are what their names say, and the same each time."""

import pytest

from core.geometry.crossing import crosses_itself
from core.model import Outline
from tests.benchmarks.holes import hole_pairs
from tests.benchmarks.icons import icon_pairs
from tests.benchmarks.pairs import across_classes, kind, within_classes
from tests.core.shapes import letter_l

LETTER = Outline.polygon(letter_l())


def test_pairs_within_classes_join_each_even_instance_to_the_next():
    outlines = {f"cup-{k:02}": LETTER for k in (0, 1, 3, 4, 5)} | {"fly-01": LETTER}
    assert [pair.name for pair in within_classes(outlines)] == [
        "cup-00 → cup-01",
        "cup-04 → cup-05",
    ]


def test_pairs_across_classes_join_different_classes_and_are_the_same_each_time():
    outlines = {f"{name}-{k:02}": LETTER for name in ("cup", "fly", "key") for k in range(3)}
    names = [pair.name for pair in across_classes(outlines, 20)]
    assert names == [pair.name for pair in across_classes(outlines, 20)]
    assert len(set(names)) > 5
    assert all(len({kind(end) for end in name.split(" → ")}) == 2 for name in names)


def check(pairs, least):
    assert len(pairs) >= least
    assert len({pair.name for pair in pairs}) == len(pairs)
    for pair in pairs:
        source, target = pair.drawn
        assert len(source) == len(target)
        assert not crosses_itself(source)
        assert not crosses_itself(target)


def test_shapes_with_holes_have_equally_many_that_do_not_cross():
    check(hole_pairs(), 8)
    assert all(len(pair.source.rings) > 1 for pair in hole_pairs())


def test_letters_are_read_from_the_fonts_that_are_here_with_their_holes(request):
    pytest.importorskip("PySide6.QtGui", reason="fonts are Qt's", exc_type=ImportError)
    from tests.benchmarks.glyphs import glyph_pairs

    request.getfixturevalue("qapp")
    pairs = glyph_pairs()
    if not pairs:
        pytest.skip("Qt finds no font")
    check(pairs, 10)
    holes = {pair.name[0]: len(pair.source.rings) - 1 for pair in pairs}
    assert {letter: holes[letter] for letter in "SAO8"} == {"S": 0, "A": 1, "O": 1, "8": 2}


def test_icons_are_paired_at_one_size(shared_data):
    pairs = icon_pairs(shared_data / "svg")
    assert len(pairs) >= 10
    assert all(len(pair.source.rings) == len(pair.target.rings) for pair in pairs)


def test_without_icons_there_are_no_pairs(tmp_path):
    assert icon_pairs(tmp_path) == []
