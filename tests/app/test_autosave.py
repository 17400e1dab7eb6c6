"""A crash costs at most the work since the last pause, and never anybody else's."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app.document.autosave import Autosave
from app.document.session import Session
from core.errors import FileError
from core.io import project
from core.model import Document, Outline
from core.model.edits import add_layer, update_document

SQUARE = Outline.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])

CRASH = """
import os, signal, sys
from pathlib import Path
from PySide6.QtCore import QCoreApplication
from app.document.autosave import Autosave
from app.document.session import Session
from core.model import Outline
from core.model.edits import add_layer

app = QCoreApplication(["betwixt"])
session = Session()
session.path = Path(sys.argv[2]) if sys.argv[2] else None
autosave = Autosave(session, Path(sys.argv[1]))
session.apply("Draw", add_layer, "fin", 1, Outline.polygon([(0, 0), (10, 0), (10, 10)]))
autosave.keep()
print("kept", flush=True)
if sys.argv[3] == "die":
    os.kill(os.getpid(), signal.SIGKILL)
sys.stdin.read()
"""


@pytest.fixture
def session(qapp: object) -> Session:
    return Session()


def draw(session: Session) -> None:
    session.apply("Draw", add_layer, "square", 1, SQUARE)


def run(folder: Path, origin: str, end: str) -> subprocess.Popen[str]:
    """Start another program that has unsaved work, and dies or goes on."""
    other = subprocess.Popen(
        [sys.executable, "-c", CRASH, str(folder), origin, end],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])},
    )
    assert other.stdout is not None
    assert other.stdout.readline() == "kept\n"
    return other


@pytest.mark.skipif(os.name != "posix", reason="kills a process the POSIX way")
def test_work_of_a_program_that_was_killed_is_offered_with_where_it_belongs(
    session: Session, tmp_path: Path
) -> None:
    run(tmp_path, str(tmp_path / "fish.betwixt"), "die").communicate()
    autosave = Autosave(session, tmp_path)
    (leftover,) = autosave.leftovers()
    assert leftover.origin == tmp_path / "fish.betwixt"
    autosave.recover(leftover)
    assert [layer.name for layer in session.document.layers] == ["fin"]
    assert session.path == tmp_path / "fish.betwixt"
    assert session.dirty
    autosave.close()
    assert not list(tmp_path.iterdir())


def test_work_of_a_program_that_is_running_is_not_offered(session: Session, tmp_path: Path) -> None:
    other = run(tmp_path, "", "wait")
    autosave = Autosave(session, tmp_path)
    assert autosave.leftovers() == []
    other.communicate("")
    autosave.close()


def test_recovered_work_survives_a_second_crash(session: Session, tmp_path: Path) -> None:
    project.save(add_layer(Document(), "fin", 1, SQUARE), tmp_path / "lost.betwixt")
    autosave = Autosave(session, tmp_path)
    (leftover,) = autosave.leftovers()
    assert leftover.origin is None
    autosave.recover(leftover)
    (kept,) = tmp_path.glob("*.betwixt")
    assert kept != leftover.file
    assert project.load(kept) == session.document
    autosave.close()


def test_leftovers_come_newest_first_and_only_to_one_program(
    session: Session, tmp_path: Path
) -> None:
    for age, name in enumerate(["new", "old"]):
        file = tmp_path / f"{name}.betwixt"
        project.save(Document(), file)
        os.utime(file, (1e9 - age, 1e9 - age))
    first, second = Autosave(session, tmp_path), Autosave(session, tmp_path)
    found = first.leftovers()
    assert [leftover.file.stem for leftover in found] == ["new", "old"]
    assert second.leftovers() == []
    first.discard(found[0])
    assert not found[0].file.exists()
    first.close()
    second.close()


def test_unsaved_work_is_kept_when_the_artist_pauses(
    session: Session, tmp_path: Path, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.document.autosave.IDLE_MS", 1)
    autosave = Autosave(session, tmp_path)
    draw(session)
    qtbot.waitUntil(lambda: bool(list(tmp_path.glob("*.betwixt"))))
    (kept,) = tmp_path.glob("*.betwixt")
    assert project.load(kept) == session.document
    autosave.close()


def test_nothing_is_kept_of_saved_work_or_in_the_middle_of_a_drag(
    session: Session, tmp_path: Path
) -> None:
    autosave = Autosave(session, tmp_path)
    autosave.keep()
    drag = session.begin("Move")
    drag.apply(add_layer, "square", 1, SQUARE)
    autosave.keep()
    assert not list(tmp_path.glob("*.betwixt"))
    drag.commit()
    autosave.keep()
    assert list(tmp_path.glob("*.betwixt"))
    session.mark_saved(tmp_path / "saved")
    assert not list(tmp_path.glob("*.betwixt"))
    autosave.close()


def test_undo_back_to_the_saved_state_and_a_new_edit_are_kept_again(
    session: Session, tmp_path: Path
) -> None:
    autosave = Autosave(session, tmp_path)
    draw(session)
    autosave.keep()
    session.undo()
    assert not list(tmp_path.glob("*.betwixt"))
    session.redo()
    session.apply("Speed", update_document, fps=12.0)
    autosave.keep()
    (kept,) = tmp_path.glob("*.betwixt")
    assert project.load(kept).fps == 12.0
    autosave.close()


def test_a_folder_that_refuses_is_told_once(session: Session, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    autosave = Autosave(session, tmp_path / "file")
    told: list[object] = []
    autosave.failed.connect(told.append)
    for _ in range(3):
        draw(session)
        autosave.keep()
    assert len(told) == 1
    autosave.close()


def test_damaged_leftovers_are_refused_and_stay(session: Session, tmp_path: Path) -> None:
    (tmp_path / "lost.betwixt").write_bytes(b"not a project")
    autosave = Autosave(session, tmp_path)
    (leftover,) = autosave.leftovers()
    with pytest.raises(FileError):
        autosave.recover(leftover)
    assert leftover.file.exists()
    autosave.close()
