from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import Cancelled, FileError
from core.io import exporters
from core.io.exporters import SVG, VERTICES, MovingMesh, Size
from core.io.exporters.sequence import export_sequence
from core.io.exporters.svg import drawing, write_picture
from core.io.exporters.vertices import write_vertices
from core.io.importers.svg import read
from core.io.replacing import replacing, staging
from core.model import Style
from core.model.picture import Picture, Shape
from core.progress import silent

SQUARE = np.array([[10, 10], [90, 10], [90, 90], [10, 90]], dtype=float)
HOLE = np.array([[30, 30], [30, 60], [60, 60]], dtype=float)


def picture(frame: float = 1, style: Style | None = None, name: str = "leg") -> Picture:
    shape = Shape(1, name, style or Style("#102030", "#405060", 3.0), (SQUARE, HOLE))
    return Picture(frame, (200.0, 100.0), "#ffffff", (shape,))


def write_text(picture: Picture, path: Path) -> None:
    path.write_text(f"frame {picture.frame}")


def names(folder: Path) -> list[str]:
    return sorted(os.listdir(folder)) if folder.exists() else []


class Film:
    pictures: Sequence[Picture] = [picture(frame) for frame in (3, 4, 5)]
    meshes: Sequence[MovingMesh] = ()
    frames = (3, 5)

    @property
    def mesh_count(self) -> int:
        return len(self.meshes)


# -- sequences ---------------------------------------------------------------------------------


def test_every_frame_is_written_under_its_number(tmp_path: Path) -> None:
    paths = export_sequence(Film.pictures, tmp_path / "new" / "out", "run", ".txt", write_text)
    assert [path.name for path in paths] == ["run-0003.txt", "run-0004.txt", "run-0005.txt"]
    assert [path.read_text() for path in paths] == ["frame 3", "frame 4", "frame 5"]
    assert names(tmp_path / "new" / "out") == [path.name for path in paths]


@pytest.mark.parametrize("stop_at", range(4))
def test_cancelling_leaves_the_folder_as_it_was(tmp_path: Path, stop_at: int) -> None:
    (tmp_path / "run-0004.txt").write_text("old")
    calls = []

    def progress(fraction: float, stage: str) -> None:
        calls.append((fraction, stage))
        if len(calls) > stop_at:
            raise Cancelled

    with pytest.raises(Cancelled):
        export_sequence(Film.pictures, tmp_path, "run", ".txt", write_text, progress)
    assert names(tmp_path) == ["run-0004.txt"]
    assert (tmp_path / "run-0004.txt").read_text() == "old"


def test_cancelling_leaves_no_folder_that_was_not_there(tmp_path: Path) -> None:
    def stop(fraction: float, stage: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        export_sequence(Film.pictures, tmp_path / "a" / "b", "run", ".txt", write_text, stop)
    assert names(tmp_path) == []


def test_an_error_while_writing_leaves_the_folder_as_it_was(tmp_path: Path) -> None:
    def fail(picture: Picture, path: Path) -> None:
        write_text(picture, path)
        if picture.frame == 5:
            raise OSError(28, "No space left on device")

    with pytest.raises(FileError, match="No space left"):
        export_sequence(Film.pictures, tmp_path, "run", ".txt", fail)
    assert names(tmp_path) == []


@pytest.mark.parametrize("refused", range(4))
def test_a_folder_that_refuses_one_of_the_files_keeps_all_as_they_were(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, refused: int
) -> None:
    for frame in (3, 5):
        (tmp_path / f"run-000{frame}.txt").write_text("old")
    move, calls = os.replace, []

    def replace(source: Path, target: Path) -> None:
        calls.append(target)
        if len(calls) == refused + 1:
            raise PermissionError(13, "Permission denied")
        move(source, target)

    monkeypatch.setattr(os, "replace", replace)
    with pytest.raises(FileError, match="Permission denied"):
        export_sequence(Film.pictures, tmp_path, "run", ".txt", write_text)
    assert names(tmp_path) == ["run-0003.txt", "run-0005.txt"]
    assert {path.read_text() for path in tmp_path.iterdir()} == {"old"}


def test_existing_frames_are_replaced_when_all_is_written(tmp_path: Path) -> None:
    (tmp_path / "run-0004.txt").write_text("old")
    seen = []

    def write(picture: Picture, path: Path) -> None:
        seen.append((tmp_path / "run-0004.txt").read_text())
        write_text(picture, path)

    export_sequence(Film.pictures, tmp_path, "run", ".txt", write)
    assert seen == ["old"] * 3
    assert (tmp_path / "run-0004.txt").read_text() == "frame 4"


def test_progress_rises_from_0_to_1(tmp_path: Path) -> None:
    fractions = []
    export_sequence(
        Film.pictures, tmp_path, "run", ".txt", write_text, lambda f, _: fractions.append(f)
    )
    assert fractions == [0, pytest.approx(1 / 3), pytest.approx(2 / 3), 1]


def test_no_frames_are_an_error(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="no frame"):
        export_sequence([], tmp_path, "run", ".txt", write_text)


def test_a_file_in_place_of_the_folder_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file")
    with pytest.raises(FileError):
        export_sequence(Film.pictures, tmp_path / "out", "run", ".txt", write_text)
    assert (tmp_path / "out").read_text() == "a file"


def test_a_folder_in_place_of_a_file_is_an_error_and_nothing_moves(tmp_path: Path) -> None:
    (tmp_path / "b").mkdir()

    def stage() -> None:
        with staging(tmp_path) as draft:
            (draft / "a").write_text("a")
            (draft / "b").write_text("b")

    with pytest.raises(FileError, match="folder of the same name"):
        stage()
    assert names(tmp_path) == ["b"]


# -- SVG ---------------------------------------------------------------------------------------


def test_an_exported_drawing_reads_back_as_it_was() -> None:
    style = Style("#10203040", "#405060", 3.0)
    background, part = read(drawing(picture(style=style)).encode(), "x", lambda _: None)
    assert background.outline.bounds() == (0, 0, 200, 100)
    assert part.name == "leg"
    assert part.style == style
    assert [ring.points.tolist() for ring in part.outline.rings] == [SQUARE.tolist(), HOLE.tolist()]


@pytest.mark.parametrize("size", [(400, 200), (400, 400), (50, 100)])
def test_the_picture_keeps_its_proportions_and_the_background_fills_the_rest(
    size: tuple[int, int],
) -> None:
    background, part = read(drawing(picture(), size).encode(), "x", lambda _: None)
    assert background.outline.bounds() == pytest.approx((0, 0, *size))
    left, top, right, bottom = part.outline.bounds()
    scale = min(size[0] / 200, size[1] / 100)
    assert (right - left, bottom - top) == pytest.approx((80 * scale, 80 * scale))
    assert (top + bottom) / 2 == pytest.approx(size[1] / 2)


def test_what_is_not_painted_is_not_in_the_file() -> None:
    bare = Picture(1, (10, 10), "", picture(style=Style("", "", 2.0)).shapes)
    text = drawing(bare)
    assert "rect" not in text
    assert "stroke" not in text
    assert 'fill="none"' in text


@given(st.text(st.characters(codec="utf-8")))
def test_any_name_makes_well_formed_svg(name: str) -> None:
    root = ElementTree.fromstring(drawing(picture(name=name)))
    [title] = root.iter("{http://www.w3.org/2000/svg}title")
    if name.isprintable():
        assert (title.text or "") == name


def test_a_drawing_is_written_whole(tmp_path: Path) -> None:
    write_picture(picture(), tmp_path / "a.svg")
    assert (tmp_path / "a.svg").read_text(encoding="utf-8") == drawing(picture())
    assert names(tmp_path) == ["a.svg"]


@pytest.mark.parametrize("stem", ["a/b", "../b", "/tmp/b"])
@pytest.mark.parametrize("form", exporters.FORMATS)
def test_no_name_leads_out_of_the_folder(
    tmp_path: Path, form: exporters.ExportFormat, stem: str
) -> None:
    film = Film()
    film.meshes = [mesh()]
    with pytest.raises(FileError, match="not the name of a file"):
        form.export(film, tmp_path / "in", stem, None, silent)
    assert names(tmp_path) == []


@pytest.mark.parametrize("size", [(0, 0), (0, 5), (-5, 5), (10**6, 5)])
def test_a_size_that_no_picture_can_have_is_refused(tmp_path: Path, size: Size) -> None:
    with pytest.raises(FileError, match=f"{size[0]} x {size[1]}"):
        SVG.export(Film(), tmp_path, "run", size, silent)


def test_an_error_names_the_file_that_was_to_be(tmp_path: Path) -> None:
    def fail(picture: Picture, path: Path) -> None:
        with replacing(path, flush=False):
            raise OSError(28, "No space left on device")

    with pytest.raises(FileError) as caught:
        export_sequence(Film.pictures, tmp_path, "run", ".txt", fail)
    assert caught.value.where.path == str(tmp_path / "run-0003.txt")


# -- vertices ----------------------------------------------------------------------------------


def mesh(layer: str = "leg") -> MovingMesh:
    positions = np.arange(30.0).reshape(3, 5, 2)
    return MovingMesh(
        layer, positions, [[0, 1, 4]], ([0, 1, 2], [3, 4, 0]), [3, 4, 5], [0.1, 0.2, 0.3]
    )


def test_vertex_frames_come_back(tmp_path: Path) -> None:
    one = mesh()
    write_vertices(tmp_path / "a.npz", one.positions, one.triangles, one.rings, one.times)
    with np.load(tmp_path / "a.npz") as found:
        np.testing.assert_array_equal(found["positions"], one.positions)
        np.testing.assert_array_equal(found["triangles"], one.triangles)
        np.testing.assert_array_equal(found["times"], one.times)
        rings = np.split(found["rings"], np.cumsum(found["ring_sizes"])[:-1])
    assert [ring.tolist() for ring in rings] == [[0, 1, 2], [3, 4, 0]]


@pytest.mark.parametrize(
    ("meshes", "files"), [([mesh()], ["x.npz"]), ([mesh(), mesh("Ω")], ["x-1.npz", "x-2.npz"])]
)
def test_each_mesh_has_its_own_archive(
    tmp_path: Path, meshes: list[MovingMesh], files: list[str]
) -> None:
    film = Film()
    film.meshes = meshes
    paths = VERTICES.export(film, tmp_path, "x", None, silent)
    assert [path.name for path in paths] == files == names(tmp_path)
    with np.load(paths[-1]) as found:
        assert found["layer"] == meshes[-1].layer
        assert found["frames"].tolist() == [3, 4, 5]


def test_vertex_frames_can_be_cancelled_before_each_and_leave_nothing(tmp_path: Path) -> None:
    class Made(list[np.ndarray]):
        count = 0

        def __getitem__(self, index: int) -> np.ndarray:
            Made.count += 1
            return super().__getitem__(index)

    film, fractions = Film(), []
    film.meshes = [replace(mesh(), positions=Made(mesh().positions)) for _ in range(2)]

    def progress(fraction: float, stage: str) -> None:
        fractions.append(fraction)
        if len(fractions) > 5:
            raise Cancelled

    with pytest.raises(Cancelled):
        VERTICES.export(film, tmp_path, "x", None, progress)
    assert fractions == [k / 6 for k in range(6)]
    assert Made.count == 5
    assert names(tmp_path) == []


def test_a_film_without_meshes_has_no_vertices(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="no mesh"):
        VERTICES.export(Film(), tmp_path, "x", None, silent)


# -- the registry ------------------------------------------------------------------------------


def test_formats_export_a_film(tmp_path: Path) -> None:
    assert exporters.FORMATS == (SVG, VERTICES)
    paths = SVG.export(Film(), tmp_path, "run", (20, 10), silent)
    assert [path.name for path in paths] == ["run-0003.svg", "run-0004.svg", "run-0005.svg"]
    assert 'width="20" height="10"' in paths[0].read_text()
