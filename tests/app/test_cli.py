from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtGui import QImage

from app import cli
from app.cli import editor
from app.jobs.export import Export
from app.render.formats import BY_KEY
from core.io import project
from core.io.exporters import svg
from core.model import Document, Keyframe, Layer, Outline, Recipe
from core.progress import silent
from resources import sample, samples

ROOT = Path(__file__).parents[2]
BAR = "0,0\n9,0\n9,1\n0,1\n"
POLE = "x;y\n5;-4\n5;5\n4;5\n4;-4\n"
DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 40">'
    '<rect id="box" width="9" height="5" fill="#fff"/>'
    '<path id="ring" fill-rule="evenodd" fill="#aa0000" stroke="#00bb00"'
    ' d="M0 0h30v30h-30zM10 10h10v10h-10z"/></svg>'
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to work in, with a few shapes."""
    (tmp_path / "bar.csv").write_text(BAR)
    (tmp_path / "pole.csv").write_text(POLE)
    (tmp_path / "two.svg").write_text(DRAWING)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def turn(folder: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """A project: a bar that turns upright."""
    assert cli.run(["new", "bar.csv", "pole.csv", "--frames", "5", "-o", "turn.betwixt"]) == 0
    capsys.readouterr()
    return folder / "turn.betwixt"


def run(arguments: list[str]) -> object:
    """Return the exit code, however the command leaves."""
    try:
        return cli.run(arguments)
    except SystemExit as leaving:
        return leaving.code


def refused(arguments: list[str], capsys: pytest.CaptureFixture[str], code: int) -> str:
    """Run a command that must fail, and return what it says."""
    assert run(arguments) == code
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("betwixt: ")
    assert "Traceback" not in said.err
    return said.err


# -- new ---------------------------------------------------------------------------------------


def test_new_makes_a_project_of_two_files(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--frames", "12", "--fps", "12.5", "--size", "400x300", "--marks", "0:3,2:1"]
    assert cli.run(["new", "bar.csv", "pole.csv", *options, "-o", "turn"]) == 0
    assert "turn.betwixt" in capsys.readouterr().out
    document = project.load(folder / "turn.betwixt")
    [layer] = document.layers
    assert (document.fps, document.size, document.frames) == (12.5, (400, 300), (1, 12))
    assert (layer.name, layer.labels) == ("bar", ("a", "b"))
    assert [[mark.at for mark in key.marks] for key in layer.keyframes] == [[0, 2], [3, 1]]


def test_both_shapes_keep_their_places_relative_to_each_other(turn: Path) -> None:
    source, target = (key.outline.rings[0].points for key in project.load(turn).layers[0].keyframes)
    scale = np.ptp(source, axis=0)[0] / 9
    np.testing.assert_allclose((target - source[0]) / scale, [[5, -4], [5, 5], [4, 5], [4, -4]])


def test_a_small_shape_beside_a_large_one_is_noticed(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "tiny.csv").write_text("0,0\n.9,0\n0,.9\n")
    assert cli.run(["new", "bar.csv", "tiny.csv", "-o", "a.betwixt"]) == 0
    assert "10 times smaller than the source. Use --fit each" in capsys.readouterr().err
    assert cli.run(["new", "bar.csv", "tiny.csv", "--fit", "each", "-o", "a.betwixt"]) == 0
    assert capsys.readouterr().err == ""
    sizes = [
        np.subtract(key.outline.bounds()[2:], key.outline.bounds()[:2])
        for key in project.load(folder / "a.betwixt").layers[0].keyframes
    ]
    assert (sizes[0] / [960, 540]).max() == pytest.approx((sizes[1] / [960, 540]).max())


@pytest.mark.parametrize("part", ["2", "ring"])
def test_a_part_is_chosen_by_number_or_name(folder: Path, part: str) -> None:
    assert cli.run(["new", f"two.svg#{part}", f"two.svg#{part}", "-o", "a.betwixt"]) == 0
    [layer] = project.load(folder / "a.betwixt").layers
    assert len(layer.keyframes[0].outline.rings) == 2
    assert layer.name == "two ring"
    assert (layer.style.fill, layer.style.stroke) == ("#aa0000", "#00bb00")


def test_white_shapes_get_a_colour_that_shows_on_white(folder: Path) -> None:
    assert cli.run(["new", "two.svg#box", "bar.csv", "-o", "a.betwixt"]) == 0
    assert project.load(folder / "a.betwixt").layers[0].style.fill != "#ffffff"


def test_several_parts_without_a_choice_are_listed(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = refused(["new", "two.svg", "bar.csv", "-o", "a.betwixt"], capsys, 1)
    assert "two.svg#1   box, 9 × 5, #ffffff" in said
    assert "two.svg#2   ring, 30 × 30, #aa0000, 1 hole" in said
    said = refused(["new", "two.svg#moon", "bar.csv", "-o", "a.betwixt"], capsys, 1)
    assert "no part 'moon'" in said
    assert not (folder / "a.betwixt").exists()


def test_a_sign_in_a_file_name_is_no_choice_of_part(folder: Path) -> None:
    (folder / "a#1.csv").write_text(BAR)
    assert cli.run(["new", "a#1.csv", "bar.csv", "-o", "a.betwixt"]) == 0


def test_marks_count_on_through_the_holes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["new", "two.svg#2", "two.svg#2", "-o", "a.betwixt", "--marks"]
    assert cli.run([*command, "1:2,6:5"]) == 0
    source, target = project.load(folder / "a.betwixt").layers[0].keyframes
    assert [(mark.ring, mark.at) for mark in source.marks] == [(0, 1), (1, 2)]
    assert [(mark.ring, mark.at) for mark in target.marks] == [(0, 2), (1, 1)]
    capsys.readouterr()
    assert "no node 8 on the target, which has 8 nodes" in refused([*command, "0:8"], capsys, 1)


def test_a_target_that_should_be_mirrored_is_told_by_every_command(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    flag = [(0, 0), (40, 0), (200, 30), (200, 130), (40, 110), (40, 350), (0, 350)]
    for name, sign in (("flag", 1), ("galf", -1)):
        rows = "".join(f"{sign * x},{y}\n" for x, y in flag)
        (folder / f"{name}.csv").write_text(rows)
    new = ["new", "flag.csv", "galf.csv", "--frames", "3", "-o", "flag.betwixt"]
    assert cli.run(new) == 0
    assert "far better mirrored. Use --mirror" in capsys.readouterr().err
    assert cli.run(["check", "flag.betwixt"]) == 0
    assert "note        the target matches far better mirrored" in capsys.readouterr().out
    assert cli.run(["render", "flag.betwixt", "--format", "svg", "-o", "frames"]) == 0
    assert "flag, frames 1 to 3: the target matches far better" in capsys.readouterr().err
    assert cli.run([*new, "--mirror"]) == 0
    assert cli.run(["check", "flag.betwixt"]) == 0
    said = capsys.readouterr()
    assert "mirrored" not in said.out + said.err


# -- render ------------------------------------------------------------------------------------


def test_render_writes_the_frames_that_the_editor_exports(
    turn: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.run(["render", "turn.betwixt", "-o", "out"]) == 0
    assert capsys.readouterr().out == "out: turn-0001.png to turn-0005.png\n"
    document = project.load(turn)
    export = Export(document, document.frames, BY_KEY["png"], folder / "editor", "turn")
    for path in export.run({}, silent):
        assert path.read_bytes() == (folder / "out" / path.name).read_bytes()


def test_render_obeys_frames_size_and_background(turn: Path, folder: Path) -> None:
    options = ["--frames", "2-3", "--size", "64x32", "--background", "none"]
    assert cli.run(["render", "turn.betwixt", *options, "-o", "out"]) == 0
    assert sorted(os.listdir("out")) == ["turn-0002.png", "turn-0003.png"]
    image = QImage("out/turn-0002.png")
    assert (image.width(), image.height()) == (64, 32)
    assert image.pixelColor(0, 0).alpha() == 0
    assert image.pixelColor(32, 16).alpha() == 255


@pytest.mark.parametrize(
    ("form", "files"),
    [("svg", [f"turn-000{i}.svg" for i in range(1, 6)]), ("npz", ["turn.npz"])],
)
def test_render_writes_other_formats(turn: Path, form: str, files: list[str]) -> None:
    assert cli.run(["render", "turn.betwixt", "--format", form, "-o", "out"]) == 0
    assert sorted(os.listdir("out")) == files


def test_frames_before_zero_can_be_asked_for(turn: Path, folder: Path) -> None:
    run(["render", str(turn), "--frames", "-3-2", "--format", "svg", "-o", "out"])
    assert len(list((folder / "out").iterdir())) == 6


def test_formats_without_pictures_have_no_size(
    turn: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["render", "turn.betwixt", "--format", "npz", "--size", "9x9", "-o", "out"]
    assert "mean nothing to npz" in refused(command, capsys, 2)


def test_a_shape_that_cannot_be_solved_leaves_no_files(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.run(["new", "two.svg#2", "bar.csv", "--fit", "each", "-o", "a.betwixt"]) == 0
    capsys.readouterr()
    said = refused(["render", "a.betwixt", "-o", "out"], capsys, 1)
    assert "Layer “two ring”, frames 1 to 24: The source has 1 hole" in said
    assert not (folder / "out").exists()


def test_without_qts_libraries_render_names_the_packages(
    turn: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "PySide6.QtGui", None)
    said = refused(["render", "turn.betwixt", "-o", "out"], capsys, 1)
    assert "sudo apt install" in said
    assert "libegl1" in said
    assert "--format svg works" in said
    assert cli.run(["render", "turn.betwixt", "--format", "svg", "-o", "out"]) == 0


def test_ctrl_c_leaves_no_files(
    turn: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(svg, "drawing", interrupt)
    command = ["render", "turn.betwixt", "--format", "svg", "-o", "out"]
    assert "nothing was written" in refused(command, capsys, 130)
    assert not Path("out").exists()


# -- check -------------------------------------------------------------------------------------


def test_ctrl_c_while_the_note_on_mirroring_is_sought_leaves_no_project(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupt(_: object) -> bool:
        raise KeyboardInterrupt

    monkeypatch.setattr("app.cli.new._better_mirrored", interrupt)
    arguments = ["new", "bar.csv", "pole.csv", "-o", "bar"]
    assert "nothing was written" in refused(arguments, capsys, 130)
    assert not (folder / "bar.betwixt").exists()


def test_check_finds_a_turning_bar_sound(turn: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(["check", "turn.betwixt"]) == 0
    said = capsys.readouterr().out
    assert "bar, frames 1 to 5" in said
    assert "folds       none" in said
    assert "all frames are sound" in said


def test_check_reports_in_json(turn: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(["check", "turn.betwixt", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    [span] = report["spans"]
    assert report["sound"] is span["sound"] is True
    assert span["frames"] == [1, 5]
    assert span["folds"] == span["crossings"] == [0] * 5
    assert max(span["end_errors"].values()) <= 1e-9
    assert span["distortion"]["mean"] == pytest.approx(1, abs=1e-6)
    assert set(span["seconds"]) == {"solve", "stages", "frame"}
    assert all(seconds > 0 for seconds in span["seconds"]["stages"].values())


def test_check_says_what_is_not_sound(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Blades that swap their places by straight paths run through each other."""
    cross = Outline.polygon([[0, 0], [100, 0], [100, 20], [20, 20], [20, 100], [0, 100]])
    mirrored = Outline.polygon([[0, 0], [20, 0], [100, 80], [80, 100], [20, 40], [0, 100]])
    far = mirrored.transformed([[-1, 0], [0, -1]])
    keys = (Keyframe(1, cross), Keyframe(9, far))
    layer = Layer(1, "blades", keys, recipe=Recipe(method="linear"))
    project.save(Document((layer,)), folder / "a.betwixt")
    assert cli.run(["check", "a.betwixt", "--json"]) == 3
    [span] = json.loads(capsys.readouterr().out)["spans"]
    assert sum(span["folds"]) > 0
    assert span["sound"] is False
    for frame, places in span["places"].items():
        found = int(frame) - span["frames"][0]
        assert len(places) == span["folds"][found] + span["crossings"][found] > 0
    assert cli.run(["check", "a.betwixt"]) == 3
    said = capsys.readouterr().out
    assert "NOT SOUND" in said
    assert "at frame 5" in said


def test_check_goes_on_after_a_span_that_has_no_solution(
    turn: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    good = project.load(turn).layers[0]
    ring = Outline.polygon([[0, 0], [9, 0], [9, 9], [0, 9]], [[3, 3], [6, 3], [6, 6]])
    bad = Layer(9, "ring", (Keyframe(1, ring), Keyframe(5, Outline(ring.rings[:1]))))
    project.save(Document((bad, good)), folder / "a.betwixt")
    assert cli.run(["check", "a.betwixt", "--json"]) == 1
    spans = json.loads(capsys.readouterr().out)["spans"]
    assert "1 hole" in spans[0]["error"]
    assert spans[1]["sound"] is True
    assert cli.run(["check", "a.betwixt"]) == 1
    assert "not solved" in capsys.readouterr().out


def test_check_of_what_does_not_move_says_so(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    project.save(Document(), folder / "a.betwixt")
    assert cli.run(["check", "a.betwixt"]) == 0
    assert "nothing moves" in capsys.readouterr().out


# -- words that are wrong ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["render"], 2, "Try: betwixt render --help"),
        (["--frob"], 2, "Try: betwixt --help"),
        (["rendr", "turn.betwixt"], 2, "one file at a time"),
        (["missing.betwixt"], 1, "no such file, and no command of that name"),
        (["render", "missing.betwixt", "-o", "out"], 1, "missing.betwixt: Cannot be read"),
        (["render", "two.svg", "-o", "out"], 1, "not a Betwixt project"),
        (["render", "a", "-o", "b", "--size", "0x5"], 2, "WIDTHxHEIGHT"),
        (["render", "a", "-o", "b", "--size", "99999x5"], 2, "WIDTHxHEIGHT"),
        (["render", "a", "-o", "b", "--frames", "9-3"], 2, "frame 3 comes before frame 9"),
        (["render", "a", "-o", "b", "--frames", "one"], 2, "FIRST-LAST"),
        (["render", "a", "-o", "b", "--background", "blurple"], 2, "not a colour"),
        (["render", "a", "-o", "b", "--format", "gif"], 2, "invalid choice"),
        (["new", "bar.csv", "pole.csv", "-o", "b", "--marks", "1-2"], 2, "pairs of node numbers"),
        (["new", "bar.csv", "pole.csv", "-o", "b", "--fps", "0"], 2, "no frame rate"),
        (["new", "bar.csv", "pole.csv", "-o", "b", "--frames", "1"], 2, "2 or more"),
        (["new", "bar.doc", "pole.csv", "-o", "b"], 1, "format is not known"),
        (["new", "bar.csv", "pole.csv", "-o", "no/where.betwixt"], 1, "Cannot be written"),
    ],
)
def test_a_wrong_word_is_explained(
    turn: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], code: int, said: str
) -> None:
    assert said in refused(arguments, capsys, code)


@pytest.mark.parametrize("command", [[], ["new"], ["render"], ["check"]])
def test_help_teaches_by_examples(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*command, "--help"]) == 0
    said = capsys.readouterr().out
    assert f"betwixt {command[0] if command else 'new'}" in said.split("xamples:")[-1]
    assert max(map(len, said.splitlines())) <= 100


def test_the_version_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--version"]) == 0
    assert capsys.readouterr().out.startswith("betwixt ")


# -- the editor --------------------------------------------------------------------------------


def test_without_a_display_the_editor_names_a_command_that_works(
    turn: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    said = refused(["turn.betwixt"], capsys, 2)
    command = said.splitlines()[-1].split()
    assert command == ["betwixt", "render", "turn.betwixt", "-o", "frames"]
    assert cli.run(command[1:]) == 0
    if samples():
        capsys.readouterr()
        assert str(samples()[0]) in refused([], capsys, 2)


def test_without_qts_libraries_the_editor_names_the_packages(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    monkeypatch.setitem(sys.modules, "PySide6.QtWidgets", None)
    assert "libxcb-cursor0" in refused([], capsys, 1)


@pytest.mark.parametrize("arguments", [[], ["turn.betwixt"]])
def test_no_command_opens_the_editor(
    turn: Path, arguments: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    opened = []
    monkeypatch.setattr(editor, "_open", lambda path: opened.append(path) or 0)
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    assert cli.run(arguments) == 0
    assert opened == [Path(arguments[0]) if arguments else None]


def test_samples_are_found_by_name() -> None:
    for path in samples():
        assert sample(path.stem) == path
        assert project.load(path).layers


# -- as a process ------------------------------------------------------------------------------


def test_the_command_runs_as_a_module_and_fails_without_a_traceback(folder: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "app", "check", str(folder / "missing.betwixt")],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1
    assert done.stdout == ""
    assert done.stderr.startswith("betwixt: ")
    assert "Traceback" not in done.stderr


def test_nothing_heavy_is_loaded_for_help() -> None:
    code = (
        "import sys, contextlib, app.cli\n"
        "with contextlib.suppress(SystemExit): app.cli.run(['--help'])\n"
        "sys.exit(bool({'numpy', 'scipy', 'PySide6', 'msgspec', 'tqdm'} & set(sys.modules)))"
    )
    assert (
        subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True).returncode == 0
    )
