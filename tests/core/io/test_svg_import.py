from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from shapely import Polygon

from core.errors import FileError
from core.geometry.flatten import flatten
from core.io import importers
from core.io.importers import Part
from core.io.importers.svg import read
from core.model import Document, Keyframe, Layer, Outline, Style
from core.model.structure import problems

NAMESPACES = (
    'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
)
RING = "M10 10h80v80h-80z"
INNER = "M30 30h40v40h-40z"
INNER_BACKWARDS = "M30 30v40h40v-40z"


def parts(body: str, warnings: list[str] | None = None, head: str = "") -> list[Part]:
    head = head or 'viewBox="0 0 100 100"'
    text = f"<svg {NAMESPACES} {head}>{body}</svg>"
    return read(text.encode(), "file", (warnings if warnings is not None else []).append)


def part(body: str, head: str = "") -> Part:
    [only] = parts(body, head=head)
    return only


def polygon(outline: Outline) -> Polygon:
    exterior, *holes = [line.points for line in flatten(outline, 1e-6)]
    return Polygon(exterior, holes)


def refusal(text: str) -> str:
    with pytest.raises(FileError) as caught:
        read(text.encode(), "file", lambda _: None)
    return str(caught.value)


# -- shapes ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("body", "area", "nodes"),
    [
        ('<rect x="10" y="5" width="40" height="20"/>', 800, 4),
        ('<circle cx="50" cy="50" r="20"/>', np.pi * 400, 4),
        ('<ellipse cx="50" cy="50" rx="20" ry="10"/>', np.pi * 200, 4),
        ('<rect width="40" height="20" rx="5"/>', 800 - (4 - np.pi) * 25, 8),
        ('<polygon points="0,0 10,0 0,10"/>', 50, 3),
        ('<polyline points="0 0 10 0 0 10"/>', 50, 3),
        ('<path d="M0 0 10 0V10H0Z"/>', 100, 4),
        ('<path d="m5 5 10 0 0 10-10 0z"/>', 100, 4),
        ('<path d="M0 0h10v10h-10L0 0"/>', 100, 4),
        ('<path d="M0 0Q10 20 20 0Z"/>', 400 / 3, 3),
        ('<path d="M0 0C0 10 10 10 10 0S20-10 20 0V20H0Z"/>', 400, 5),
        ('<path d="M0 0A10 10 0 0 1 20 0Z"/>', np.pi * 50, 3),
        ('<path d="M20 50A30 30 0 1 1 80 50A30 30 0 1 1 20 50"/>', np.pi * 900, 4),
    ],
)
def test_a_shape_keeps_its_area_and_few_nodes(body: str, area: float, nodes: int) -> None:
    outline = part(body).outline
    assert polygon(outline).area == pytest.approx(area, rel=5e-4)
    assert len(outline.rings[0]) == nodes


def test_curves_stay_curves() -> None:
    ring = part('<path d="M0 0C1 2 8 2 9 0L9 9L0 9Z"/>').outline.rings[0]
    assert ring.points.tolist() == [[0, 0], [9, 0], [9, 9], [0, 9]]
    assert ring.handles_out[0].tolist() == [1, 2]
    assert ring.handles_in[1].tolist() == [-1, 2]
    assert ring.curved.tolist() == [True, False, False, False]


def test_a_closing_curve_ends_in_the_first_node() -> None:
    ring = part('<path d="M0 0L9 0C9 5 5 9 0 0Z"/>').outline.rings[0]
    assert len(ring) == 3  # the two that are drawn, and one that a ring needs
    assert ring.handles_in[0].any()


# -- transforms --------------------------------------------------------------------------------


@given(
    st.floats(-180, 180),
    st.floats(0.1, 5),
    st.floats(0.1, 5),
    st.floats(-60, 60),
    st.floats(-50, 50),
)
def test_transforms_nest(turn: float, sx: float, sy: float, skew: float, shift: float) -> None:
    """The same matrices, applied by us."""
    body = (
        f'<g transform="translate({shift} 3) rotate({turn})">'
        f'<path transform="scale({sx},{sy}) skewX({skew})" d="M0 0L10 0C10 5 5 10 0 10Z"/></g>'
    )
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    matrix = (
        np.array([[c, -s], [s, c]]) @ np.diag([sx, sy]) @ [[1, np.tan(np.radians(skew))], [0, 1]]
    )
    expected = part('<path d="M0 0L10 0C10 5 5 10 0 10Z"/>').outline.transformed(matrix, [shift, 3])
    for mine, theirs in zip(part(body).outline.rings, expected.rings, strict=True):
        np.testing.assert_allclose(mine.points, theirs.points, atol=1e-9)
        np.testing.assert_allclose(mine.handles_out, theirs.handles_out, atol=1e-9)


def test_an_arc_under_an_uneven_scale_stays_exact() -> None:
    outline = part('<circle cx="30" cy="30" r="20" transform="scale(1.5,0.5) rotate(30)"/>').outline
    assert polygon(outline).area == pytest.approx(0.75 * np.pi * 400, rel=5e-4)


def test_physical_sizes_count_96_pixels_an_inch() -> None:
    head = 'width="25.4mm" height="1in" viewBox="0 0 10 10"'
    bounds = part('<rect width="5" height="5"/>', head).outline.bounds()
    assert bounds == pytest.approx((0, 0, 48, 48), abs=1e-3)


# -- holes -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("rule", "d", "rings"),
    [
        ("", f"{RING}{INNER_BACKWARDS}", [2]),
        ("", f"{RING}{INNER}", [1]),
        ("evenodd", f"{RING}{INNER}", [2]),
        ("evenodd", f"{INNER}{RING}", [2]),
        ("evenodd", f"{RING}{INNER}M40 40h10v10h-10z", [2, 1]),
        ("evenodd", "M0 0h9v9h-9zM20 0h9v9h-9z", [1, 1]),
        ("evenodd", f"{RING}M20 20h9v9h-9zM60 60h9v9h-9z", [3]),
    ],
)
def test_holes_follow_the_fill_rule(rule: str, d: str, rings: list[int]) -> None:
    attribute = f'fill-rule="{rule}"' if rule else ""
    for body in (
        f'<path {attribute} d="{d}"/>',
        f'<g {attribute}><path d="{d}"/></g>',
        f'<path style="fill-rule:{rule or "nonzero"}" d="{d}"/>',
    ):
        assert [len(found.outline.rings) for found in parts(body)] == rings


def test_the_exterior_comes_first() -> None:
    rings = part(f'<path fill-rule="evenodd" d="{INNER}{RING}"/>').outline.rings
    assert [np.ptp(ring.points) for ring in rings] == [80, 40]


# -- what is shown, and how --------------------------------------------------------------------


def test_what_is_not_displayed_is_not_read() -> None:
    body = (
        '<g display="none"><rect width="9" height="9"/></g>'
        '<rect style="display:none" width="8" height="8"/>'
        '<rect visibility="hidden" width="8" height="8"/>'
        '<defs><rect width="7" height="7"/></defs><clipPath><rect width="9" height="9"/></clipPath>'
        '<symbol><rect width="9" height="9"/></symbol><mask><rect width="9" height="9"/></mask>'
        '<marker><rect width="9" height="9"/></marker><circle id="seen" r="5"/>'
    )
    assert [found.name for found in parts(body)] == ["seen"]


@pytest.mark.parametrize(
    ("attributes", "style"),
    [
        ("", ("#000000", "", 2.0)),
        ('fill="#fa0"', ("#ffaa00", "", 2.0)),
        ('fill="none" stroke="red" stroke-width="3"', ("", "#ff0000", 3.0)),
        ('style="fill:blue;stroke:#010203"', ("#0000ff", "#010203", 1.0)),
        ('fill="red" fill-opacity="0.5"', ("#ff000080", "", 2.0)),
        ('fill="red" opacity="0.2"', ("#ff000033", "", 2.0)),
        ('fill="red" opacity="20%"', ("#ff000033", "", 2.0)),
        ('fill="red" opacity="nan"', ("#ff0000", "", 2.0)),
        ('class="leaf"', ("#00ff00", "", 2.0)),
        ('stroke="red" stroke-width="2" transform="scale(3)"', ("#000000", "#ff0000", 6.0)),
    ],
)
def test_the_style_is_kept(attributes: str, style: tuple[str, str, float]) -> None:
    found = part(f"<style>.leaf{{fill:#00ff00}}</style><circle r='5' {attributes}/>").style
    assert found is not None
    assert (found.fill, found.stroke, found.stroke_width) == style


@pytest.mark.parametrize("width", ["-3", "nan", "1e999", "1e99", "wide", ""])
@pytest.mark.parametrize("side", [1e-9, 1.0, 1e9])
def test_every_style_that_is_read_can_be_put_into_a_document(width: str, side: float) -> None:
    head = f'viewBox="0 0 {side} {side}" width="100" height="100"'
    body = f'<rect stroke="red" stroke-width="{width}" width="{side}" height="{side}"/>'
    for found in importers.fitted(parts(body, head=head), (960.0, 540.0)):
        layer = Layer(1, "", (Keyframe(1, found.outline),), style=found.style or Style())
        assert not list(problems(Document((layer,))))


def test_a_shape_that_is_not_painted_has_no_style() -> None:
    assert part('<circle r="5" fill="none"/>').style is None


def test_white_on_white_gets_a_colour_that_shows() -> None:
    white = part('<circle r="5" fill="#fff"/>')
    assert white.style_on("#ffffff").fill != "#ffffff"
    assert white.style_on("#000000").fill == "#ffffff"
    assert white.style_on("").fill == "#ffffff"


def test_parts_are_named_by_label_title_or_id_or_else_by_the_drawing() -> None:
    body = (
        '<circle r="5" id="i"/><circle r="5" id="j"><title>T</title></circle>'
        '<circle r="5" inkscape:label="L" id="k"/><circle r="5"/><rect width="5" height="5"/>'
        '<path d="M0 0h9v9zM20 0h9v9z"/><rect id="i" width="5" height="5"/>'
    )
    names = [found.name for found in parts(body)]
    assert names == ["i", "T", "L", "file 4", "file 5", "file 6 (1)", "file 6 (2)", "i (2)"]


def test_the_only_shape_of_a_drawing_is_named_after_the_file() -> None:
    assert part('<circle r="5"/>').name == "file"


@pytest.mark.parametrize("href", ["href", "xlink:href"])
def test_uses_are_placed(href: str) -> None:
    body = (
        '<defs><path id="a" d="M0 0h20v10z"/></defs><symbol id="s"><rect width="4" height="4"/>'
        f'</symbol><use {href}="#a" x="10" y="20"/><use {href}="#s" transform="translate(50 60)"/>'
    )
    assert [found.outline.bounds() for found in parts(body)] == [(10, 20, 30, 30), (50, 60, 54, 64)]


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("<text>hi</text>", "Text is left out"),
        ('<image href="a.png" width="5" height="5"/>', "Images are left out"),
        ('<svg x="5"><circle r="2"/></svg>', "nested <svg>"),
        ('<symbol id="s" viewBox="0 0 1 1"><circle r="1"/></symbol><use href="#s"/>', "<symbol>"),
        ('<circle r="3" style="transform:rotate(3deg)"/>', "CSS"),
        ('<circle r="3" clip-path="url(#c)"/>', "Clipping is ignored"),
        ('<circle r="3" fill="url(#g)"/>', "Gradients"),
        ('<path id="lash" fill="none" stroke="red" d="M0 0 9 0 9 9"/>', "“lash” is an open line"),
        ('<path id="p" d="h5"/>', "“p” is no path"),
        ('<path id="far" d="M0 0L1e999 0L0 9Z"/>', "“far” cannot be understood"),
        ('<line id="l" x2="5" y2="5" stroke="red"/>', "“l” has no area"),
    ],
)
def test_what_is_left_out_is_said(body: str, said: str) -> None:
    warnings: list[str] = []
    found = parts(body + '<rect width="5" height="5"/>', warnings)
    assert found
    assert any(said in warning for warning in warnings)


def test_a_plain_drawing_gives_no_warning() -> None:
    warnings: list[str] = []
    parts(f'<g id="a"><title>A</title><path d="{RING}"/></g><circle r="4"/>', warnings)
    assert warnings == []


@pytest.mark.parametrize(
    "head",
    [
        *('width="auto" height="auto"', 'width="0" height="0"', 'width="-5" height="5"'),
        *('viewBox="0 0 0 0"', 'viewBox="0 0 -9 9"', 'viewBox="0 0 9"', 'viewBox="none"'),
    ],
)
def test_a_size_without_extent_counts_as_none(head: str) -> None:
    assert part('<rect width="5" height="4"/>', head).outline.bounds() == (0, 0, 5, 4)


@pytest.mark.parametrize("path", ["<path/>", '<path d=""/>', '<path d="L1 1"/>', '<path d="M 1"/>'])
def test_a_broken_path_spoils_no_other(path: str) -> None:
    assert part(f'{path}<rect id="sound" width="5" height="4"/>').name == "sound"


# -- harm --------------------------------------------------------------------------------------


def test_uses_that_multiply_without_end_are_refused() -> None:
    def level(i: int) -> str:
        tens = f'<use href="#a{i}"/>' * 10
        return f'<g id="a{i + 1}">{tens}</g>'

    levels = "".join(map(level, range(12)))
    body = f'<defs><rect id="a0" width="1" height="1"/>{levels}</defs><use href="#a12"/>'
    assert "more than" in refusal(f"<svg {NAMESPACES}>{body}</svg>")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f'<svg {NAMESPACES}><g id="a"><use href="#a"/></g></svg>', "contains itself"),
        (f"<svg {NAMESPACES}>{'<g>' * 5000}{'</g>' * 5000}</svg>", "too deeply"),
        ("<svg", "not well-formed SVG"),
        ("<html></html>", "<html>"),
        ("", "not well-formed SVG"),
    ],
)
def test_files_that_cannot_be_read_are_refused(text: str, said: str) -> None:
    assert said in refusal(text)


def test_curves_that_lie_in_each_other_without_end_are_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("core.io.importers.nesting.MAX_OVERLAPS", 100)
    rings = "".join(f"M{i} {i}H{99 - i}V{99 - i}H{i}z" for i in range(15))
    assert "lie in or over each other" in refusal(f'<svg {NAMESPACES}><path d="{rings}"/></svg>')


def test_entities_that_multiply_without_end_are_refused() -> None:
    entities = "".join(f'<!ENTITY {chr(98 + i)} "{f"&{chr(97 + i)};" * 10}">' for i in range(9))
    text = f'<!DOCTYPE svg [<!ENTITY a "{"a" * 99}">{entities}]><svg {NAMESPACES}>&j;</svg>'
    assert "not well-formed SVG" in refusal(text)


def test_a_drawing_without_shapes_is_refused_with_what_was_left_out(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text(f"<svg {NAMESPACES}><text>no</text></svg>")
    with pytest.raises(FileError, match="no shape with an area") as refused:
        importers.read(tmp_path / "a.svg")
    assert "turn it into paths" in refused.value.hint


@given(st.text("MmLlCcQqAaZzHhVvSsTt0123456789.-, e", max_size=40))
@example("h5")
@example("M0 0Zh5v5z")
@example("M1e308 0C-1e308 0 1e999 0 5 5z")
@example("M0 0A0 5 0 0 1 9 9A5 5 0 0 1 9 9L0 9z")
def test_no_path_data_crashes_the_reader(d: str) -> None:
    for found in parts(f'<path d="{d}"/><rect width="5" height="5"/>'):
        for ring in found.outline.rings:
            assert len(ring) >= 3
            assert np.isfinite(ring.points).all()


def test_real_drawings_are_read_in_one_piece(shared_data: Path) -> None:
    files = sorted((shared_data / "svg").glob("*.svg"))
    assert files
    for file in files:
        warnings: list[str] = []
        found = importers.read(file, warnings.append)
        assert not warnings, file.name
        for shape in found:
            assert polygon(shape.outline).area > 0, file.name
