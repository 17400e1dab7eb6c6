from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QByteArray
from PySide6.QtGui import QImage, QPainter
from PySide6.QtSvg import QSvgRenderer

from app.jobs.export import Export
from app.jobs.solve_all import solve_all
from app.render import animation
from app.render.film import DocumentFilm
from app.render.formats import BY_KEY, FORMATS
from app.render.painter import colour, outline_path, render_image
from app.render.png import write_picture
from core.errors import Cancelled, FileError, SolveError
from core.io import importers
from core.io.exporters.svg import drawing
from core.model import Document, Easing, Keyframe, Layer, Outline, Style
from core.model.picture import Picture, Shape
from core.morph.morph import Morph
from core.morph.scene import picture_at
from core.progress import silent
from tests.core.io.test_apng import read

SQUARE = np.array([[20, 20], [80, 20], [80, 80], [20, 80]], dtype=float)
HOLE = SQUARE / 2 + 25
BAR = Outline.polygon([[20, 40], [90, 40], [90, 60], [20, 60]])
POLE = Outline.polygon([[60, 10], [60, 80], [40, 80], [40, 10]])


def picture(style: Style, background: str = "", size: tuple[float, float] = (100, 100)) -> Picture:
    return Picture(1, size, background, (Shape(1, "x", style, (SQUARE, HOLE)),))


def document(*easings: Easing) -> Document:
    keys = [
        Keyframe(1 + 4 * i, POLE if i % 2 else BAR, (), easing) for i, easing in enumerate(easings)
    ]
    return Document((Layer(1, "bar", tuple(keys)),), size=(100.0, 100.0))


def pixels(image: QImage) -> np.ndarray:
    image = image.convertToFormat(QImage.Format.Format_RGBA8888)
    memory = np.frombuffer(image.constBits(), np.uint8)
    return memory.reshape(image.height(), image.width(), 4).copy()


# -- painting ----------------------------------------------------------------------------------


def test_the_inside_is_filled_and_the_hole_is_not() -> None:
    found = pixels(render_image(picture(Style("#102030", ""), "#ffffff")))
    assert found[25, 50].tolist() == [0x10, 0x20, 0x30, 255]
    assert found[50, 50].tolist() == [255, 255, 255, 255]
    assert found[5, 5].tolist() == [255, 255, 255, 255]


def test_edges_are_antialiased() -> None:
    tilted = Shape(1, "x", Style("#000000", ""), (SQUARE @ [[1, 0.1], [0, 1]],))
    assert len(np.unique(pixels(render_image(Picture(1, (100, 100), "", (tilted,))))[..., 3])) > 10


def test_without_a_background_the_picture_is_transparent() -> None:
    style = Style("#ff000080", "")
    for found in (
        pixels(render_image(picture(style))),
        pixels(render_image(picture(style, "#00ff00"), background="")),
    ):
        assert found[5, 5].tolist() == [0, 0, 0, 0]
        assert found[25, 50].tolist() == [255, 0, 0, 128]


@pytest.mark.parametrize("text", ["#102030", "#10203040"])
def test_colours_are_red_green_blue_alpha(text: str) -> None:
    assert colour(text).getRgb() == (0x10, 0x20, 0x30, int(text[7:] or "ff", 16))


def test_a_stroke_of_no_width_is_not_painted() -> None:
    filled, stroked = (
        pixels(render_image(picture(Style("#102030", stroke, 0.0)))) for stroke in ("", "#ff0000")
    )
    np.testing.assert_array_equal(filled, stroked)


@pytest.mark.parametrize("size", [(50, 50), (200, 100), (100, 200)])
def test_the_picture_is_fitted_in_with_its_proportions_kept(size: tuple[int, int]) -> None:
    found = pixels(render_image(picture(Style("#000000", "")), size))
    assert found.shape == (size[1], size[0], 4)
    rows, columns = np.nonzero(found[..., 3] > 128)
    scale = min(size) / 100
    assert np.ptp(rows) + 1 == np.ptp(columns) + 1 == 60 * scale
    assert (rows.min() + rows.max() + 1) / 2 == size[1] / 2
    assert (columns.min() + columns.max() + 1) / 2 == size[0] / 2


def test_a_path_holds_every_point() -> None:
    path = outline_path([SQUARE, HOLE[:, :]])
    found = [(path.elementAt(i).x, path.elementAt(i).y) for i in range(path.elementCount())]
    assert found[:4] == [tuple(point) for point in SQUARE.tolist()]
    assert found[5:9] == [tuple(point) for point in HOLE.tolist()]


def test_an_image_beyond_all_memory_is_refused() -> None:
    with pytest.raises(FileError, match="too large"):
        render_image(picture(Style()), (2**17, 2**17))


# -- PNG and SVG show the same -----------------------------------------------------------------


@pytest.mark.parametrize("size", [None, (300, 200)])
@pytest.mark.parametrize(
    ("style", "background"),
    [(Style("#aa3311", "#112233", 4.0), "#ffeedd"), (Style("#aa331180", "", 4.0), "")],
)
def test_svg_and_png_agree(style: Style, background: str, size: tuple[int, int] | None) -> None:
    shown = picture(style, background, (120, 80))
    png = render_image(shown, size)
    svg = QImage(png.size(), QImage.Format.Format_ARGB32_Premultiplied)
    svg.fill(0)
    painter = QPainter(svg)
    QSvgRenderer(QByteArray(drawing(shown, size).encode())).render(painter)
    painter.end()
    difference = np.abs(pixels(png).astype(int) - pixels(svg))
    assert (difference > 8).mean() < 1e-3


def test_real_drawings_look_like_qt_draws_them(shared_data: Path) -> None:
    """An importer and a painter that agree with somebody else's."""
    for file in sorted((shared_data / "svg").glob("*.svg")):
        theirs = QImage(256, 256, QImage.Format.Format_ARGB32_Premultiplied)
        theirs.fill(0)
        painter = QPainter(theirs)
        renderer = QSvgRenderer(str(file))
        renderer.render(painter)
        painter.end()
        size = (renderer.viewBoxF().width(), renderer.viewBoxF().height())
        layers = tuple(
            Layer(i, part.name, (Keyframe(1, part.outline),), (), part.style_on(""))
            for i, part in enumerate(importers.read(file))
        )
        shown = picture_at(Document(layers, size=size, background=""), 1, lambda _: None)
        ours = render_image(shown, (256, 256))
        a, b = pixels(ours), pixels(theirs)
        visible = np.maximum(a[..., 3], b[..., 3]) > 32
        difference = np.abs(a.astype(int) - b).max(axis=2)
        assert (visible & (difference > 64)).sum() < 40, file.name


# -- films and exports -------------------------------------------------------------------------


def test_an_exported_frame_is_what_the_scene_shows(tmp_path: Path) -> None:
    shown = document(Easing(), Easing())
    morphs = solve_all(shown)
    paths = Export(shown, (1, 5), BY_KEY["png"], tmp_path, "bar").run({}, silent)
    for frame, path in zip(range(1, 6), paths, strict=True):
        expected = render_image(picture_at(shown, frame, morphs.get))
        np.testing.assert_array_equal(pixels(QImage(str(path))), pixels(expected))


def test_the_same_frame_is_the_same_file_to_the_last_byte(tmp_path: Path) -> None:
    shown = picture(Style())
    for name in ("a.png", "b.png"):
        write_picture(shown, tmp_path / name, (64, 64))
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_a_picture_is_the_same_with_and_without_an_application(
    tmp_path: Path, qapp: object
) -> None:
    code = (
        "import sys; from pathlib import Path; from tests.app.test_render import picture;"
        "from app.render.png import write_picture; from core.model import Style;"
        "write_picture(picture(Style()), Path(sys.argv[1]), (64, 64))"
    )
    root = Path(__file__).parents[2]
    subprocess.run([sys.executable, "-c", code, tmp_path / "a.png"], cwd=root, check=True)
    write_picture(picture(Style()), tmp_path / "b.png", (64, 64))
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_vertex_meshes_hold_the_frames_of_each_span_once() -> None:
    shown = document(Easing(), Easing(hold=True), Easing())
    film = DocumentFilm(shown, (0, 12), solve_all(shown).get)
    first, second = film.meshes
    assert [list(mesh.frames) for mesh in (first, second)] == [[0, 1, 2, 3, 4], [*range(5, 13)]]
    for mesh in (first, second):
        for frame, time, positions in zip(mesh.frames, mesh.times, mesh.positions, strict=True):
            assert time == (frame - 1) / 24
            [ring] = mesh.rings
            [shape] = film.picture(frame).shapes
            gap = np.abs(positions[ring][:, None] - shape.rings[0]).max(axis=2).min(axis=0)
            assert gap.max() < 1e-9


def test_no_frame_of_a_mesh_is_made_before_it_is_asked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    shown, made, at = document(Easing(), Easing()), [], Morph.at
    film = DocumentFilm(shown, (1, 5), solve_all(shown).get)
    monkeypatch.setattr(Morph, "at", lambda morph, s: made.append(s) or at(morph, s))
    [mesh] = film.meshes
    assert made == []
    assert mesh.positions[2] is not None
    assert made == [0.5]


def test_a_layer_with_one_keyframe_is_a_mesh_without_triangles() -> None:
    [mesh] = DocumentFilm(document(Easing()), (1, 3), lambda _: None).meshes
    assert len(mesh.triangles) == 0
    np.testing.assert_array_equal(mesh.positions[2], BAR.rings[0].points)


def test_only_the_spans_that_show_are_solved() -> None:
    shown = document(Easing(), Easing(), Easing(), Easing())
    assert [len(solve_all(shown, frames)) for frames in ((1, 4), (5, 9), (-5, 99))] == [1, 2, 2]


def test_known_solutions_are_used() -> None:
    shown = document(Easing(), Easing())
    known = solve_all(shown)
    again = solve_all(shown, known=known, progress=lambda *_: pytest.fail("solved again"))
    assert again == known


def test_an_error_names_layer_and_frames() -> None:
    rings = BAR.rings[0].points, [[30, 45], [40, 45], [40, 55]]
    keys = (Keyframe(1, BAR), Keyframe(9, Outline.polygon(*rings)))
    with pytest.raises(SolveError, match=r"Layer “arm”, frames 1 to 9: .*hole"):
        solve_all(Document((Layer(1, "arm", keys),)))


def test_solving_can_be_cancelled() -> None:
    def stop(fraction: float, stage: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        solve_all(document(Easing(), Easing()), progress=stop)


def test_a_background_takes_the_place_of_the_documents() -> None:
    film = DocumentFilm(document(Easing()), (1, 2), lambda _: None, background="")
    assert [shown.background for shown in film.pictures] == ["", ""]
    assert [shown.frame for shown in film.pictures[:1]] == [1]


def test_an_animation_is_one_file_of_the_frames_as_they_are_seen(tmp_path: Path) -> None:
    shown = document(Easing(), Easing())
    export = Export(shown, (1, 5), BY_KEY["apng"], tmp_path, "bar", (64, 48), "")
    (path,) = export.run({}, silent)
    assert path == tmp_path / "bar.png"
    frames, seconds = read(path.read_bytes())
    film = DocumentFilm(shown, (1, 5), solve_all(shown).get, background="")
    for frame, picture in zip(frames, film.pictures, strict=True):
        assert frame.shape == (48, 64, 4)
        assert np.array_equal(frame, animation.pixels(picture, (64, 48)))
    assert not np.array_equal(frames[0], frames[-1])
    assert frames[0][..., 3].min() == 0
    assert seconds == pytest.approx([1 / shown.fps] * 5)
    assert QImage(str(path)).size().toTuple() == (64, 48)


def test_a_cancelled_animation_leaves_nothing(tmp_path: Path) -> None:
    def stop(fraction: float, stage: str) -> None:
        if stage == "Frame 3 of 5":
            raise Cancelled

    with pytest.raises(Cancelled):
        Export(document(Easing(), Easing()), (1, 5), BY_KEY["apng"], tmp_path / "new", "bar").run(
            {}, stop
        )
    assert not list(tmp_path.iterdir())


def test_formats_have_keys_of_their_own() -> None:
    assert [entry.key for entry in FORMATS] == list(BY_KEY) == ["png", "apng", "svg", "npz"]
