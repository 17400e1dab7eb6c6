"""The application around the window: its name, its log, and what happens to faults."""

from __future__ import annotations

import logging
import signal
import sys
from collections.abc import Callable
from importlib.metadata import version
from importlib.resources import files
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType

from PySide6.QtCore import QStandardPaths
from PySide6.QtGui import QGuiApplication, QIcon
from PySide6.QtWidgets import QApplication

from app.jobs.collector import Collector

log = logging.getLogger(__name__)


def make_application() -> QApplication:
    """Return the application, named, with its icon and its log."""
    QGuiApplication.setDesktopFileName("betwixt")
    app = QApplication(sys.argv[:1])
    app.setApplicationName("Betwixt")
    app.setApplicationVersion(version("betwixt"))
    app.setWindowIcon(QIcon(str(files("resources") / "icons" / "betwixt.svg")))
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl+C in the terminal; the work is kept
    Collector(app)
    _start_log()
    return app


def log_file() -> Path:
    """Return where faults are written down."""
    place = QStandardPaths.StandardLocation.AppDataLocation
    return Path(QStandardPaths.writableLocation(place)) / "betwixt.log"


def watch_faults(tell: Callable[[BaseException], None]) -> None:
    """Write faults of the program to the log, and tell the artist of them."""

    def hook(kind: type[BaseException], fault: BaseException, trace: TracebackType | None) -> None:
        log.error("Fault", exc_info=(kind, fault, trace))
        tell(fault)

    sys.excepthook = hook


def _start_log() -> None:
    try:
        log_file().parent.mkdir(parents=True, exist_ok=True)
        handler = RotatingFileHandler(log_file(), maxBytes=2**18, backupCount=1, delay=True)
    except OSError:
        return  # without a log rather than not at all
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s"))
    logging.getLogger().addHandler(handler)
