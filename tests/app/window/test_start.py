"""The program from its start to its end, as a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import resources

OPEN_LOOK_AND_CLOSE = """
import sys
from pathlib import Path
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
import app.main_window as main_window

def look_and_close():
    (window,) = (w for w in QApplication.topLevelWidgets() if w.isVisible())
    layer = window.workspace.selection.layer
    if layer is None or window.workspace.solver.state(layer.id, 0).value != "solved":
        QTimer.singleShot(10, look_and_close)
        return
    print(window.windowTitle(), window.workspace.playhead.playing, flush=True)
    window.close()

real_exec = QApplication.exec

def exec_with_a_look(*_):
    QTimer.singleShot(10, look_and_close)
    return real_exec()

QApplication.exec = exec_with_a_look
sys.exit(main_window.run(Path(sys.argv[1]) if len(sys.argv) > 1 else None))
"""


def start(tmp_path: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the program in a home of its own."""
    environment = os.environ | {"HOME": str(tmp_path), "QT_QPA_PLATFORM": "offscreen"}
    for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME"):
        environment.pop(name, None)
    return subprocess.run(
        [sys.executable, "-c", OPEN_LOOK_AND_CLOSE, *arguments],
        capture_output=True,
        text=True,
        env=environment,
        cwd=Path(__file__).parents[3],
        timeout=60,
        check=False,
    )


def test_it_starts_with_a_moving_sample_and_ends_without_a_complaint(tmp_path: Path) -> None:
    ended = start(tmp_path)
    assert (ended.returncode, ended.stdout) == (0, "Untitled[*] – Betwixt True\n"), ended.stderr
    assert "Traceback" not in ended.stderr


def test_it_opens_the_file_it_is_given(tmp_path: Path) -> None:
    path = resources.samples()[0]
    ended = start(tmp_path, str(path))
    assert (ended.returncode, ended.stdout) == (0, f"{path.stem}[*] – Betwixt False\n")
