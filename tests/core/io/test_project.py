from __future__ import annotations

import io
import json
import os
import stat
import zipfile
from contextlib import suppress
from dataclasses import fields, replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from core.errors import FileError
from core.io import project
from core.model import (
    Document,
    Easing,
    Keyframe,
    Layer,
    Outline,
    Recipe,
    Ring,
    RingPoint,
    Style,
    Turning,
)
from tests.core.io.strategies import documents

SQUARE = Outline.polygon([[0, 0], [10, 0], [10, 10], [0, 10]])
DOCUMENT = Document(
    (
        Layer(
            7,
            "leg",
            (
                Keyframe(1, SQUARE, (RingPoint(0, 0.0), RingPoint(0, 2.5))),
                Keyframe(12, SQUARE, (RingPoint(0, 1.0), RingPoint(0, 3.5))),
            ),
            ("a", "b"),
        ),
    )
)


def as_json(document: Document = DOCUMENT) -> dict:
    with zipfile.ZipFile(io.BytesIO(project.to_bytes(document))) as archive:
        return json.loads(archive.read("document.json"))


def packed(content: object, name: str = "document.json") -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, content if isinstance(content, bytes) else json.dumps(content))
    return buffer.getvalue()


def refusal(data: bytes) -> str:
    with pytest.raises(FileError) as caught:
        project.from_bytes(data, "a.betwixt")
    assert caught.value.where.path == "a.betwixt"
    return str(caught.value)


# -- what is saved is what was drawn -----------------------------------------------------------


@given(documents())
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_every_document_comes_back_identical(document: Document) -> None:
    assert project.from_bytes(project.to_bytes(document)) == document


def test_saved_equals_loaded(tmp_path: Path) -> None:
    project.save(DOCUMENT, tmp_path / "leg.betwixt")
    assert project.load(tmp_path / "leg.betwixt") == DOCUMENT


def test_equal_documents_make_equal_files() -> None:
    assert project.to_bytes(DOCUMENT) == project.to_bytes(replace(DOCUMENT))


def test_numbers_of_numpy_are_saved_as_numbers() -> None:
    document = Document(fps=np.float64(12.5), size=(np.float64(3), np.float64(4)))
    assert project.from_bytes(project.to_bytes(document)) == document


def test_a_file_of_version_1_still_opens() -> None:
    """The format may grow; what this text says must go on meaning the same."""
    content = {
        "format": "betwixt",
        "version": 1,
        "document": {
            "fps": 12.0,
            "size": [200, 100],
            "background": "",
            "layers": [
                {
                    "id": 3,
                    "name": "Ω",
                    "labels": ["a"],
                    "visible": False,
                    "locked": True,
                    "style": {"fill": "#102030", "stroke": "", "stroke_width": 1.5},
                    "recipe": {
                        "method": "linear",
                        "density": 64,
                        "material": "st-venant-kirchhoff",
                        "mu": 2.0,
                        "lam": 0.5,
                    },
                    "keyframes": [
                        {
                            "frame": 4,
                            "marks": [{"ring": 0, "at": 1.25}],
                            "easing": {"x1": 0.1, "y1": 0.2, "x2": 0.3, "y2": 0.4, "hold": True},
                            "outline": {
                                "rings": [
                                    {
                                        "points": [[0, 0], [9, 0], [0, 9]],
                                        "handles_in": [[0, 0], [1, 2], [0, 0]],
                                        "handles_out": [[3, 4], [0, 0], [0, 0]],
                                    }
                                ]
                            },
                        }
                    ],
                }
            ],
        },
    }
    ring = Ring([[0, 0], [9, 0], [0, 9]], [[0, 0], [1, 2], [0, 0]], [[3, 4], [0, 0], [0, 0]])
    key = Keyframe(
        4,
        Outline((ring,)),
        (RingPoint(0, 1.25),),
        Easing(0.1, 0.2, 0.3, 0.4, True),
        Turning(path="straight"),
    )
    layer = Layer(
        3,
        "Ω",
        (key,),
        ("a",),
        Style("#102030", "", 1.5),
        Recipe("linear", 64, "st-venant-kirchhoff", 2.0, 0.5),
        visible=False,
        locked=True,
    )
    assert project.from_bytes(packed(content)) == Document((layer,), 12.0, (200, 100), "")


def test_the_file_holds_every_field_of_the_model() -> None:
    content = as_json()["document"]
    layer = content["layers"][0]
    for kind, found in (
        (Document, content),
        (Layer, layer),
        (Keyframe, layer["keyframes"][0]),
        (Ring, layer["keyframes"][0]["outline"]["rings"][0]),
        (Style, layer["style"]),
        (Recipe, layer["recipe"]),
        (Easing, layer["keyframes"][0]["easing"]),
        (Turning, layer["keyframes"][0]["turning"]),
    ):
        assert set(found) == {field.name for field in fields(kind)}


# -- what is refused, and how it is said -------------------------------------------------------


@pytest.mark.parametrize(
    ("path", "value", "said"),
    [
        ("layers.0.keyframes.1.frame", 1, "layers[0].keyframes[1].frame: frame 1 does not come"),
        ("layers.0.keyframes.1.frame", 1.5, "layers[0].keyframes[1].frame: Expected `int`"),
        ("layers.0.keyframes.0.marks.1.ring", 2, "keyframes[0].marks[1].ring: there is no ring 2"),
        ("layers.0.keyframes.0.marks.1.at", 4.5, "keyframes[0].marks[1].at: 4.5 is not on the"),
        ("layers.0.keyframes.0.marks", [], "keyframes[0].marks: 0 places for 2 marks"),
        ("layers.0.keyframes.0.easing.x1", 2, "easing.x1: 2.0 is not between 0 and 1"),
        ("layers.0.keyframes.0.turning.turns", -1, "turning.turns: -1 is not between 0 and"),
        ("layers.0.keyframes.0.turning.path", "zigzag", "turning.path: Invalid enum value"),
        ("layers.0.keyframes.0.outline.rings", [], "outline.rings: an outline needs at least one"),
        (
            "layers.0.keyframes.1.outline.rings.0.points.2.1",
            "x",
            "layers[0].keyframes[1].outline.rings[0].points[2][1]: Expected `float`, got `str`.",
        ),
        (
            "layers.0.keyframes.1.outline.rings.0.points.2",
            [1],
            "rings[0].points[2]: Expected `array` of length 2, got 1.",
        ),
        ("layers.0.keyframes.0.outline.rings.0.handles_in", [], "rings[0]: expected (4, 2)"),
        ("layers.0.keyframes", [], "layers[0].keyframes: a layer needs at least one keyframe"),
        ("layers.0.labels.1", "a", "layers[0].labels[1]: the letter 'a' is used twice"),
        ("layers.0.style.fill", "red", "layers[0].style.fill: 'red' is not a colour"),
        ("layers.0.style.stroke_width", -1, "style.stroke_width: -1.0 is not between 0"),
        ("layers.0.recipe.density", 10**9, "recipe.density: 1000000000 is not between"),
        ("layers.0.recipe.method", "magic", "recipe.method: Invalid enum value 'magic'."),
        ("layers.0.name", None, "layers[0].name: Expected `str`, got `null`."),
        ("layers.0.carrier", 7, "layers[0].carrier: it hangs on itself"),
        ("layers.0.carrier", 8, "layers[0].carrier: there is no layer 8"),
        ("fps", 0, "fps: 0.0 is not between 0.001 and 1000"),
        ("fps", 1e-12, "fps: 1e-12 is not between 0.001 and 1000"),
        ("size.1", -3, "size[1]: -3.0 is not between 0.001 and 1000000"),
        ("size.0", 1e12, "size[0]: 1000000000000.0 is not between 0.001 and 1000000"),
        ("hold", 0, "hold: 0 is not between 1 and 12"),
        ("background", "blue", "background: 'blue' is not a colour"),
    ],
)
def test_an_error_names_the_exact_place(path: str, value: object, said: str) -> None:
    content = as_json()
    place: object = content["document"]
    *steps, last = [int(step) if step.isdigit() else step for step in path.split(".")]
    for step in steps:
        place = place[step]  # type: ignore[index]
    place[last] = value  # type: ignore[index]
    assert said in refusal(packed(content))


def test_two_layers_with_one_id_are_refused() -> None:
    content = as_json()
    content["document"]["layers"] *= 2
    assert "layers[1].id: 7 is the id of another layer too" in refusal(packed(content))


def test_a_newer_version_is_refused_with_advice() -> None:
    content = as_json() | {"version": project.VERSION + 1, "document": "something else entirely"}
    said = refusal(packed(content))
    assert "newer Betwixt" in said
    assert "Update" in said


@pytest.mark.parametrize("version", [0, -1])
def test_a_version_that_never_was_is_refused(version: int) -> None:
    assert "version" in refusal(packed(as_json() | {"version": version}))


def test_other_zip_files_are_refused() -> None:
    assert "document.json" in refusal(packed({}, name="other.json"))
    assert "not a Betwixt project" in refusal(packed(as_json() | {"format": "other"}))


@pytest.mark.parametrize("data", [b"", b"not a zip", b"PK\x03\x04 nearly"])
def test_files_that_are_no_archive_are_refused(data: bytes) -> None:
    assert "damaged" in refusal(data)


@pytest.mark.parametrize("text", [b"", b"[", b"[" * 100_000, b'{"format":"betwixt"}', b"\xff"])
def test_archives_without_a_document_are_refused(text: bytes) -> None:
    refusal(packed(text))


@given(st.data())
@settings(max_examples=150, deadline=None)
def test_a_damaged_file_never_crashes_the_reader(data: st.DataObject) -> None:
    content = bytearray(project.to_bytes(DOCUMENT))
    for place in data.draw(st.lists(st.integers(0, len(content) - 1), min_size=1, max_size=4)):
        content[place] = data.draw(st.integers(0, 255))
    cut = data.draw(st.integers(0, len(content)))
    for damaged in (bytes(content), bytes(content[:cut])):
        with suppress(FileError):
            project.from_bytes(damaged)


def test_an_archive_that_unpacks_to_too_much_is_refused() -> None:
    text = json.dumps(as_json()).encode() + b" " * (project.RATIO_FREE + 1)
    assert "compressed beyond" in refusal(packed(text))


def test_an_archive_with_too_many_entries_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(project, "MAX_ENTRIES", 0)
    assert "more than 0 entries" in refusal(project.to_bytes(DOCUMENT))


def test_a_document_that_is_too_large_is_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    project.save(DOCUMENT, tmp_path / "a.betwixt")
    data = (tmp_path / "a.betwixt").read_bytes()
    monkeypatch.setattr(project, "MAX_BYTES", 100)
    assert "larger than" in refusal(data)
    with pytest.raises(FileError, match="larger than"):
        project.load(tmp_path / "a.betwixt")


def test_what_could_not_be_read_back_is_not_saved(tmp_path: Path) -> None:
    path = tmp_path / "a.betwixt"
    project.save(DOCUMENT, path)
    broken = Outline.polygon([[0, 0], [np.nan, 0], [1, 1]])
    with pytest.raises(FileError, match=r"rings\[0\]\.points\[1\]: not a finite number"):
        project.save(Document((Layer(1, "x", (Keyframe(1, broken),)),)), path)
    with pytest.raises(FileError, match=r"layers\[0\]\.name"):
        project.save(Document((Layer(1, "\ud800", (Keyframe(1, SQUARE),)),)), path)
    assert project.load(path) == DOCUMENT


# -- the file on the disk ----------------------------------------------------------------------


def test_a_failed_save_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.betwixt"
    project.save(DOCUMENT, path)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(FileError, match="No space left"):
        project.save(Document(), path)
    monkeypatch.undo()
    assert project.load(path) == DOCUMENT
    assert os.listdir(tmp_path) == ["a.betwixt"]


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
def test_saving_again_keeps_permissions_and_links(tmp_path: Path) -> None:
    path, link = tmp_path / "a.betwixt", tmp_path / "link.betwixt"
    project.save(DOCUMENT, path)
    path.chmod(0o640)
    link.symlink_to(path)
    project.save(Document(), link)
    assert link.is_symlink()
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert project.load(path) == Document()


def test_saving_where_there_is_no_folder_says_so(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="No such file or directory"):
        project.save(DOCUMENT, tmp_path / "missing" / "a.betwixt")


@pytest.mark.skipif(os.name != "posix", reason="pipes of POSIX")
def test_what_is_no_file_is_neither_replaced_nor_waited_for(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.betwixt"
    os.mkfifo(pipe)
    for place in (pipe, tmp_path):
        before = os.stat(place).st_mode
        with pytest.raises(FileError, match="folder or a device"):
            project.save(DOCUMENT, place)
        with pytest.raises(FileError, match="folder or a device"):
            project.load(place)
        assert os.stat(place).st_mode == before
    assert os.listdir(tmp_path) == [pipe.name]


@pytest.mark.parametrize("name", ["a\0b", "a\ud800b"])
def test_a_name_that_no_file_can_have_is_refused(tmp_path: Path, name: str) -> None:
    for act in (partial(project.save, DOCUMENT), project.load):
        with pytest.raises(FileError, match="No file can have the name"):
            act(tmp_path / name)


def test_loading_what_is_not_there_says_so(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="No such file or directory"):
        project.load(tmp_path / "a.betwixt")
    with pytest.raises(FileError, match="Cannot be read"):
        project.load(tmp_path)
