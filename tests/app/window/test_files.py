"""Files in and out of the real window; nothing unsaved is lost without being asked about."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPoint, Qt, QThread, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu
from pytestqt.qtbot import QtBot

from app.files.export_dialog import DONE, FORM, RUNNING, ExportDialog
from app.files.export_form import TRANSPARENT, Subject
from app.files.import_dialog import Choice, ImportDialog
from app.files.placing import Place
from app.main_window import MainWindow
from app.menus import RECENT
from core.errors import SolveError
from core.io import importers, project
from core.io.exporters import SequenceFormat
from core.model import Document, Keyframe, Layer, Outline
from core.model.edits import add_layer
from tests.app.window.conftest import Artist, press

SQUARE = Outline.polygon([(100, 100), (300, 100), (300, 300), (100, 300)])
WIDE = Outline.polygon([(100, 100), (500, 100), (500, 300), (100, 300)])
TWO_SHAPES = """<svg xmlns="http://www.w3.org/2000/svg">
<rect id="box" x="100" y="100" width="200" height="100" fill="#aa0000"/>
<circle id="ball" cx="400" cy="300" r="80" fill="#00aa00"/></svg>"""
LEFT = Qt.MouseButton.LeftButton


def draw(window: MainWindow, name: str = "square") -> None:
    window.workspace.session.apply("Draw", add_layer, name, 1, SQUARE)


def moving() -> Document:
    return Document((Layer(1, "card", (Keyframe(1, SQUARE), Keyframe(5, WIDE))),))


@pytest.fixture
def svg(tmp_path: Path) -> Path:
    path = tmp_path / "shapes.svg"
    path.write_text(TWO_SHAPES)
    return path


# -- saving and opening ----------------------------------------------------------------------------


def test_the_title_tells_unsaved_work(window: MainWindow, artist: Artist, tmp_path: Path) -> None:
    assert not window.isWindowModified()
    draw(window)
    assert window.isWindowModified()
    artist["save"] = tmp_path / "fish.betwixt"
    press(window, "Ctrl+S")
    assert window.windowTitle() == "fish[*] – Betwixt"
    assert not window.isWindowModified()
    press(window, "Ctrl+Z")
    assert window.isWindowModified()


def test_save_asks_only_the_first_time_and_save_as_always(
    window: MainWindow, artist: Artist, tmp_path: Path
) -> None:
    artist["save"] = tmp_path / "one.betwixt"
    for keys in ("Ctrl+S", "Ctrl+S", "Ctrl+Shift+S"):
        draw(window)
        press(window, keys)
    assert artist.asked == ["save", "save"]
    assert project.load(tmp_path / "one.betwixt") == window.workspace.session.document


def test_a_name_without_its_ending_replaces_a_project_only_when_agreed_to(
    window: MainWindow, artist: Artist, tmp_path: Path
) -> None:
    taken = tmp_path / "one.betwixt"
    taken.write_text("precious")
    draw(window)
    artist["save"], artist["replace"] = tmp_path / "one", False
    press(window, "Ctrl+S")
    assert artist.asked == ["save", "replace"]
    assert taken.read_text() == "precious"
    assert window.workspace.session.dirty
    artist["replace"] = True
    press(window, "Ctrl+S")
    assert project.load(taken) == window.workspace.session.document


def test_a_folder_that_refuses_leaves_the_work_unsaved_and_offers_another_place(
    window: MainWindow, artist: Artist, tmp_path: Path
) -> None:
    draw(window)
    (tmp_path / "file").touch()
    artist["save"] = tmp_path / "file" / "fish.betwixt"
    press(window, "Ctrl+S")
    assert window.isWindowModified()
    assert window.messages.text
    artist["save"] = tmp_path / "fish.betwixt"
    QTest.mouseClick(window.messages.findChildren(type(window.status.cancel))[0], LEFT)
    assert not window.isWindowModified()
    assert not window.messages.text


def test_a_damaged_file_is_refused_and_what_is_open_stays(
    window: MainWindow, artist: Artist, tmp_path: Path
) -> None:
    draw(window)
    before = window.workspace.session.document
    artist["unsaved"] = "discard"
    artist["open"] = tmp_path / "bad.betwixt"
    artist.answers["open"].write_bytes(b"not a project")
    press(window, "Ctrl+O")
    assert window.workspace.session.document is before
    assert "bad.betwixt" in window.messages.text


@pytest.mark.parametrize("way", ["open_path", "open_sample"])
def test_opening_the_same_file_again_brings_back_what_was_just_saved(
    window: MainWindow, artist: Artist, tmp_path: Path, way: str
) -> None:
    artist["save"] = tmp_path / "fish.betwixt"
    press(window, "Ctrl+S")
    draw(window)
    edited = window.workspace.session.document
    artist["unsaved"] = "save"
    assert getattr(window.files, way)(tmp_path / "fish.betwixt")
    assert window.workspace.session.document == edited
    assert project.load(tmp_path / "fish.betwixt") == edited


@pytest.mark.parametrize(("answer", "closed"), [("cancel", False), ("discard", True)])
def test_closing_with_unsaved_work_asks(
    window: MainWindow, artist: Artist, answer: str, closed: bool
) -> None:
    draw(window)
    artist["unsaved"] = answer
    assert window.close() is closed
    assert artist.asked == ["unsaved"]
    assert window.isHidden() is closed


def test_closing_can_save_and_stays_open_when_saving_is_cancelled(
    window: MainWindow, artist: Artist, tmp_path: Path
) -> None:
    draw(window)
    artist["unsaved"] = "save"
    artist["save"] = None
    assert not window.close()
    artist["save"] = tmp_path / "fish.betwixt"
    drawn = window.workspace.session.document
    assert window.close()
    assert project.load(tmp_path / "fish.betwixt") == drawn


def test_closing_in_the_middle_of_solving_and_playing_leaves_no_thread(
    window: MainWindow,
) -> None:
    window.workspace.session.replace(moving())
    window.workspace.playhead.play()
    threads = window.findChildren(QThread)
    assert any(thread.isRunning() for thread in threads)
    window.close()
    assert not any(thread.isRunning() for thread in threads)


def test_recent_files_are_listed_newest_first_and_missing_ones_are_greyed(
    window: MainWindow, artist: Artist, tmp_path: Path
) -> None:
    for name in ("one", "two"):
        artist["save"] = tmp_path / f"{name}.betwixt"
        press(window, "Ctrl+Shift+S")
    (tmp_path / "one.betwixt").unlink()
    menu: QMenu = window.actions_.menus[RECENT]
    menu.aboutToShow.emit()
    files = [action for action in menu.actions() if action.data()]
    assert [action.data().stem for action in files] == ["two", "one"]
    assert [action.isEnabled() for action in files] == [True, False]
    window.files.new()
    files[0].trigger()
    assert window.windowTitle() == "two[*] – Betwixt"


# -- recovery --------------------------------------------------------------------------------------


def crash(tmp_path: Path) -> Document:
    """Leave what a killed program leaves."""
    lost = moving()
    (tmp_path / "recovery").mkdir()
    project.save(lost, tmp_path / "recovery" / "lost.betwixt")
    return lost


def test_after_a_crash_the_work_is_offered_and_comes_back_unsaved(
    open_window: Callable[[], MainWindow], artist: Artist, tmp_path: Path
) -> None:
    lost = crash(tmp_path)
    artist["recovery"] = "recover"
    window = open_window()
    window.begin(None)
    assert window.workspace.session.document == lost
    assert window.isWindowModified()
    artist["unsaved"] = "discard"
    window.close()
    assert not list((tmp_path / "recovery").iterdir())


@pytest.mark.parametrize(("answer", "offers"), [("discard", 1), ("later", 2)])
def test_work_that_is_not_recovered_is_deleted_or_offered_again(
    open_window: Callable[[], MainWindow],
    artist: Artist,
    tmp_path: Path,
    answer: str,
    offers: int,
) -> None:
    crash(tmp_path)
    artist["recovery"] = answer
    for _ in range(2):
        window = open_window()
        window.begin(None)
        window.close()
        window.autosave.deleteLater()
    assert artist.asked.count("recovery") == offers


# -- importing -------------------------------------------------------------------------------------


def test_a_drawing_that_the_program_is_started_with_is_imported(
    window: MainWindow, tmp_path: Path
) -> None:
    path = tmp_path / "ball.svg"
    path.write_text(f"{TWO_SHAPES.splitlines()[0]}<circle id='ball' cx='9' cy='9' r='8'/></svg>")
    window.beginning.open_first(path, welcome=True)
    assert [layer.name for layer in window.workspace.session.document.layers] == ["ball"]
    assert not window.beginning.welcoming


def test_one_shape_into_an_empty_project_needs_no_question(
    window: MainWindow, artist: Artist, tmp_path: Path
) -> None:
    (tmp_path / "tiny.csv").write_text("0,0\n1,0\n1,1\n0,1\n")
    artist["open"] = tmp_path / "tiny.csv"
    press(window, "Ctrl+I")
    (layer,) = window.workspace.session.document.layers
    left, top, right, bottom = layer.keyframes[0].outline.bounds()
    assert 0 < left < right < 960
    assert 0 < top < bottom < 540
    assert bottom - top > 300


def test_parts_become_layers_in_one_step(window: MainWindow, artist: Artist, svg: Path) -> None:
    parts = tuple(importers.read(svg))
    artist["open"], artist["parts"] = svg, Choice(parts, Place.LAYERS, fit=False)
    press(window, "Ctrl+I")
    layers = window.workspace.session.document.layers
    assert [layer.name for layer in layers] == ["box", "ball"]
    assert [layer.style.fill for layer in layers] == ["#aa0000", "#00aa00"]
    assert window.workspace.selection.layer.name == "ball"
    press(window, "Ctrl+Z")
    assert window.workspace.session.document.layers == ()


def test_two_parts_become_one_layer_that_turns_one_into_the_other(
    window: MainWindow, artist: Artist, svg: Path
) -> None:
    box, ball = importers.read(svg)
    artist["open"], artist["parts"] = svg, Choice((box, ball), Place.POSES, fit=False)
    press(window, "Ctrl+I")
    (layer,) = window.workspace.session.document.layers
    assert [key.outline for key in layer.keyframes] == [box.outline, ball.outline]


@pytest.mark.parametrize(("place", "key"), [(Place.SOURCE, 0), (Place.TARGET, 1)])
def test_a_part_becomes_the_source_or_target_of_the_current_layer(
    window: MainWindow, artist: Artist, svg: Path, place: Place, key: int
) -> None:
    window.workspace.session.replace(moving())
    box, _ = importers.read(svg)
    artist["open"], artist["parts"] = svg, Choice((box,), place, fit=False)
    press(window, "Ctrl+I")
    keys = window.workspace.session.document.layers[0].keyframes
    assert [k.outline == box.outline for k in keys] == [i == key for i in range(2)]


def test_a_part_as_the_target_of_a_single_key_adds_the_key(
    window: MainWindow, artist: Artist, svg: Path
) -> None:
    draw(window)
    box, _ = importers.read(svg)
    artist["open"], artist["parts"] = svg, Choice((box,), Place.TARGET, fit=False)
    press(window, "Ctrl+I")
    assert [k.frame for k in window.workspace.selection.layer.keyframes] == [1, 25]


def test_the_import_dialog_offers_what_fits_the_number_chosen(
    window: MainWindow, svg: Path, qtbot: QtBot
) -> None:
    draw(window)
    document = window.workspace.session.document
    dialog = ImportDialog([importers.read(svg)], document, document.layers[0], window)
    qtbot.addWidget(dialog)
    radios = dialog._radios
    dialog.list.clearSelection()
    dialog.list.item(1).setSelected(True)
    assert not radios[Place.POSES].isEnabled()
    assert radios[Place.TARGET].isEnabled()
    dialog.list.item(0).setSelected(True)
    assert radios[Place.POSES].isEnabled()
    assert not radios[Place.TARGET].isEnabled()
    radios[Place.POSES].click()
    assert [part.name for part in dialog.choice().parts] == ["ball", "box"]
    assert dialog.choice().place is Place.POSES


ICON = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 512 512">
<path d="M0 0h512v512H0z"/><path d="M100 400L256 90l156 310z" fill="#fff"/></svg>"""


def test_an_icon_is_wanted_without_its_backdrop_and_can_be_seen(
    window: MainWindow, tmp_path: Path, qtbot: QtBot
) -> None:
    draw(window)
    (tmp_path / "icon.svg").write_text(ICON)
    document = window.workspace.session.document
    parts = importers.read(tmp_path / "icon.svg")
    dialog = ImportDialog([parts], document, document.layers[0], window)
    qtbot.addWidget(dialog)
    assert dialog.choice().parts == (parts[1],)
    assert dialog.choice().place is Place.TARGET
    image = dialog.list.item(1).icon().pixmap(96, 96).toImage()
    assert image.pixelColor(48, 60) != image.pixelColor(48, 3)


def test_of_many_shapes_the_largest_is_chosen_at_first(window: MainWindow, qtbot: QtBot) -> None:
    parts = [
        importers.Part(f"s{size}", Outline.polygon([(0, 0), (size, 0), (0, size)]))
        for size in (10, 90, 30)
    ]
    dialog = ImportDialog([parts], Document(), None, window)
    qtbot.addWidget(dialog)
    assert [part.name for part in dialog.choice().parts] == ["s90"]


def test_files_dropped_together_are_the_poses_of_one_layer(
    window: MainWindow, artist: Artist, tmp_path: Path, qtbot: QtBot
) -> None:
    for name, left in (("crouch", 100), ("leap", 200), ("land", 300)):
        (tmp_path / f"{name}.svg").write_text(ICON.replace("M100 400", f"M{left} 400"))
    paths = [tmp_path / f"{name}.svg" for name in ("crouch", "leap", "land")]
    dialog = ImportDialog([importers.read(path) for path in paths], Document(), None, window)
    qtbot.addWidget(dialog)
    artist["parts"] = choice = dialog.choice()
    assert [part.name for part in choice.parts] == ["crouch 2", "leap 2", "land 2"]
    assert choice.place is Place.POSES
    drop(window, *paths)
    (layer,) = window.workspace.session.document.layers
    assert [key.frame for key in layer.keyframes] == [1, 25, 49]
    assert [key.outline for key in layer.keyframes] == [part.outline for part in choice.parts]


def test_an_emoji_in_units_of_its_own_is_fitted_to_the_artboard(
    window: MainWindow, tmp_path: Path
) -> None:
    (tmp_path / "heart.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 36 36">'
        '<path d="M2 12l16 22 16-22-8-8-8 6-8-6z"/></svg>'
    )
    drop(window, tmp_path / "heart.svg")
    (layer,) = window.workspace.session.document.layers
    assert layer.name == "heart"
    left, top, right, bottom = layer.keyframes[0].outline.bounds()
    assert ((left + right) / 2, (top + bottom) / 2) == pytest.approx((480, 270))
    assert bottom - top > 300


def drop(window: MainWindow, *paths: Path) -> None:
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path)) for path in paths])
    copy, none = Qt.DropAction.CopyAction, Qt.KeyboardModifier.NoModifier
    at = QPoint(400, 300)
    enter = QDragEnterEvent(at, copy, data, LEFT, none)
    QApplication.sendEvent(window, enter)
    assert enter.isAccepted()
    QApplication.sendEvent(window, QDropEvent(at, copy, data, LEFT, none))


def test_dropped_projects_open_and_dropped_shapes_are_imported(
    window: MainWindow, artist: Artist, svg: Path, tmp_path: Path
) -> None:
    project.save(moving(), tmp_path / "card.betwixt")
    drop(window, tmp_path / "card.betwixt")
    assert window.workspace.session.document == moving()
    artist["parts"] = None
    drop(window, svg)
    assert artist.asked == ["parts"]
    (tmp_path / "song.mp3").touch()
    drop(window, tmp_path / "song.mp3")
    assert "song.mp3" in window.messages.text


# -- exporting -------------------------------------------------------------------------------------


@pytest.fixture
def export(window: MainWindow, tmp_path: Path, qtbot: QtBot) -> ExportDialog:
    workspace = window.workspace
    workspace.session.replace(moving())
    subject = Subject(moving(), "card", workspace.playhead, workspace.solver)
    dialog = ExportDialog(subject, window.settings, window)
    dialog.form.folder.setText(str(tmp_path / "out"))
    dialog.show()
    return dialog


def test_the_form_says_which_files_it_will_make(export: ExportDialog) -> None:
    assert export.form.preview.text() == "5 files: card-0001.png to card-0005.png"
    export.form.last.setValue(3)
    export.form.format.setCurrentText("SVG sequence")
    assert export.form.preview.text() == "3 files: card-0001.svg to card-0003.svg"
    export.form.stem.setText("a/b")
    assert not export.go.isEnabled()


def test_sizes_keep_the_proportions_unless_unlinked(export: ExportDialog) -> None:
    export.form.wide.setValue(480)
    assert export.form.high.value() == 270
    export.form.high.setValue(540)
    assert export.form.wide.value() == 960
    export.form.linked.click()
    export.form.wide.setValue(100)
    assert export.form.high.value() == 540


def test_frames_are_written_as_the_form_says_and_the_choices_remembered(
    export: ExportDialog, window: MainWindow, tmp_path: Path, qtbot: QtBot
) -> None:
    export.form.background.setCurrentIndex(TRANSPARENT)
    export.form.wide.setValue(96)
    QTest.mouseClick(export.go, LEFT)
    qtbot.waitUntil(lambda: export.faces.currentIndex() == DONE)
    image = export.grab().toImage()
    assert not image.isNull()
    written = sorted((tmp_path / "out").iterdir())
    assert len(written) == 5
    from PySide6.QtGui import QImage

    picture = QImage(str(written[0]))
    assert (picture.width(), picture.height()) == (96, 54)
    assert picture.pixelColor(90, 50).alpha() == 0
    assert picture.pixelColor(20, 20).alpha() == 255
    assert window.settings.folder("export") == tmp_path / "out"


def test_files_that_exist_are_replaced_only_when_agreed_to(
    export: ExportDialog, artist: Artist, tmp_path: Path, qtbot: QtBot
) -> None:
    (tmp_path / "out").mkdir()
    old = tmp_path / "out" / "card-0002.png"
    old.write_text("precious")
    artist["replace"] = False
    QTest.mouseClick(export.go, LEFT)
    assert export.faces.currentIndex() == FORM
    assert old.read_text() == "precious"
    artist["replace"] = True
    QTest.mouseClick(export.go, LEFT)
    qtbot.waitUntil(lambda: export.faces.currentIndex() == DONE)
    assert old.read_bytes().startswith(b"\x89PNG")


def test_the_meshes_of_several_layers_are_replaced_only_when_agreed_to(
    export: ExportDialog, artist: Artist, tmp_path: Path, qtbot: QtBot
) -> None:
    [layer] = moving().layers
    document = replace(moving(), layers=(layer, replace(layer, id=2), replace(layer, id=3)))
    export.form._subject = replace(export.form._subject, document=document)
    export.form.format.setCurrentText("Vertex frames (NumPy)")
    assert export.form.preview.text() == "3 files: card-1.npz to card-3.npz"
    (tmp_path / "out").mkdir()
    old = tmp_path / "out" / "card-2.npz"
    old.write_text("precious")
    artist["replace"] = False
    QTest.mouseClick(export.go, LEFT)
    assert export.faces.currentIndex() == FORM
    assert old.read_text() == "precious"
    artist["replace"] = True
    QTest.mouseClick(export.go, LEFT)
    qtbot.waitUntil(lambda: export.faces.currentIndex() == DONE)
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        f"card-{number}.npz" for number in (1, 2, 3)
    ]


def test_a_million_frames_are_told_without_naming_each(
    export: ExportDialog, monkeypatch: pytest.MonkeyPatch
) -> None:
    named: list[str] = []
    name = SequenceFormat.file_name
    monkeypatch.setattr(
        SequenceFormat, "file_name", lambda *asked: named.append(name(*asked)) or named[-1]
    )
    export.form.last.setMaximum(1_000_000)
    export.form.last.setValue(1_000_000)
    assert export.form.preview.text() == "1000000 files: card-0001.png to card-1000000.png"
    assert len(named) < 10


def test_a_cancelled_export_leaves_nothing_and_shows_the_form_again(
    export: ExportDialog, tmp_path: Path, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    def endless(*_: object) -> None:
        progress = _[-1]
        while True:
            progress(0.5, "Frame 2 of 5")

    monkeypatch.setattr("app.jobs.export.solve_all", endless)
    QTest.mouseClick(export.go, LEFT)
    assert export.faces.currentIndex() == RUNNING
    qtbot.waitUntil(lambda: export.stage.text() == "Frame 2 of 5")
    QTest.mouseClick(export.stop_button, LEFT)
    qtbot.waitUntil(lambda: export.faces.currentIndex() == FORM)
    assert not list(tmp_path.glob("out/*"))
    assert export.problem.isHidden()


def test_an_export_that_fails_says_why_and_can_be_tried_again(
    export: ExportDialog, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> None:
        raise SolveError("The layer cannot be solved.", hint="Mend it.")

    monkeypatch.setattr("app.jobs.export.solve_all", broken)
    QTest.mouseClick(export.go, LEFT)
    qtbot.waitUntil(lambda: export.faces.currentIndex() == FORM)
    assert export.problem.text() == "The layer cannot be solved. Mend it."
    assert export.problem.isVisible()
    QTest.keyClicks(export.form.stem, "2")
    assert export.problem.isHidden()  # it was about the choices before


def test_an_animation_is_exported_as_one_file(
    export: ExportDialog, tmp_path: Path, qtbot: QtBot
) -> None:
    form = export.form
    form.format.setFocus()
    QTest.keyClick(form.format, Qt.Key.Key_Down)
    assert form.preview.text() == "card.png"
    assert form.wide.isEnabled()
    QTest.mouseClick(export.go, LEFT)
    qtbot.waitUntil(lambda: export.faces.currentIndex() == DONE)
    assert "One file" in export.summary.text()
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["card.png"]


def test_closing_the_dialog_while_exporting_ends_the_thread(
    export: ExportDialog, monkeypatch: pytest.MonkeyPatch
) -> None:
    def endless(*_: object) -> None:
        while True:
            _[-1](0.5, "")

    monkeypatch.setattr("app.jobs.export.solve_all", endless)
    QTest.mouseClick(export.go, LEFT)
    thread = export.findChild(QThread)
    assert thread.isRunning()
    export.close()
    assert thread.isFinished()
