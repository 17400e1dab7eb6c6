"""Talking to a terminal: messages, progress, exit codes, and what Qt needs from the system."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from core.errors import FileError
from core.progress import Progress, silent

OK = 0
WRONG = 1
"""A file or shape is at fault."""
USAGE = 2
"""The command was mistyped, or there is no display for the editor."""
UNSOUND = 3
"""``check`` found something."""
STOPPED = 130
"""Interrupted from the keyboard."""

OFFSCREEN_PACKAGES = "libglib2.0-0 libgl1 libegl1 libxkbcommon0 libfontconfig1 libdbus-1-3"
WINDOW_PACKAGES = "libxcb-cursor0 libxcb-icccm4 libxcb-keysyms1 libxcb-shape0 libxkbcommon-x11-0"


def complain(message: str) -> None:
    """Print a message to standard error."""
    print(f"betwixt: {message}", file=sys.stderr)


@contextmanager
def progress_bar() -> Iterator[Progress]:
    """Yield a progress callback that draws a bar; where nobody is looking it does nothing."""
    if not sys.stderr.isatty():
        yield silent
        return
    from shutil import get_terminal_size

    from tqdm import tqdm

    columns, rows = get_terminal_size()  # some terminals say 0 × 0; this makes it 80 × 24
    form = "{desc} {bar} {percentage:3.0f} %"
    with tqdm(total=100, bar_format=form, ncols=columns, nrows=rows, leave=False) as bar:

        def show(fraction: float, stage: str) -> None:
            bar.desc = f"{stage[:24]:24}"
            bar.update(round(100 * fraction) - bar.n)

        yield show


def require_qt(module: str, packages: str, advice: str = "") -> None:
    """Import a module of Qt; FileError names the system packages if that fails."""
    from importlib import import_module

    try:
        import_module(module)
    except ImportError as error:
        raise FileError(
            f"Qt does not load: {error}.",
            hint="\n".join(
                line
                for line in (
                    "It needs some libraries of the system; on Debian and Ubuntu:",
                    f"  sudo apt install {packages}",
                    advice,
                )
                if line
            ),
        ) from error
