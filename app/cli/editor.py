"""``betwixt`` and ``betwixt FILE``: open the editor."""

from __future__ import annotations

import os
import shlex
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

from app.cli.terminal import (
    OFFSCREEN_PACKAGES,
    USAGE,
    WINDOW_PACKAGES,
    WRONG,
    complain,
    require_qt,
)


def run(arguments: Sequence[str]) -> int:
    """Open the editor, with a file if one is named; return its exit code."""
    if len(arguments) > 1:
        complain("The editor opens one file at a time.\nTry: betwixt --help")
        return USAGE
    path = Path(arguments[0]) if arguments else None
    if path is not None and not path.is_file():
        complain(
            f"{path}: There is no such file, and no command of that name.\nTry: betwixt --help"
        )
        return WRONG
    if not _display():
        complain(_headless_advice(path))
        return USAGE
    require_qt("PySide6.QtWidgets", f"{OFFSCREEN_PACKAGES} {WINDOW_PACKAGES}")
    return _open(path)


def _open(path: Path | None) -> int:
    from app.main_window import run as open_window

    return int(open_window(path))


def _display() -> bool:
    """Whether a window can open; only Linux may lack a display."""
    names = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
    return not sys.platform.startswith("linux") or any(os.environ.get(name) for name in names)


def _headless_advice(path: Path | None) -> str:
    from core.io.project import EXTENSION
    from resources import samples

    project = path if path and path.suffix == EXTENSION else samples()[0]
    return (
        "There is no display to open the editor on"
        " (neither DISPLAY nor WAYLAND_DISPLAY is set).\n"
        "Frames can be made without one:\n"
        f"  {_program()} render {_quoted(project)} -o frames"
    )


def _program() -> str:
    """Return what to type to run this program again from where it was started."""
    started = Path(sys.argv[0])
    if shutil.which("betwixt") or started.name != "betwixt":
        return "betwixt"
    return _quoted(started)


def _quoted(path: Path | str) -> str:
    """Return a path for the shell, from the working directory where it is inside."""
    inside = Path(path).absolute()
    if inside.is_relative_to(Path.cwd()):
        inside = inside.relative_to(Path.cwd())
    return shlex.quote(str(inside))
