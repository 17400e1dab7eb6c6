"""Unsaved work is kept on disk while the program runs, and offered again after a crash.

Each running program has one recovery file, a lock that tells the living from the dead, and a note
of where the work belongs. Closing in good order removes all three.
"""

from __future__ import annotations

import json
import logging
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from uuid import uuid4

from PySide6.QtCore import QLockFile, QObject, QStandardPaths, QTimer, Signal

from app.document.session import Session
from core.errors import FileError
from core.io import project
from core.model import Document

EVERY_MS = 120_000
IDLE_MS = 8_000
"""How long the artist pauses before unsaved work is kept."""

log = logging.getLogger(__name__)


def recovery_folder() -> Path:
    """Return where recovery files are kept."""
    place = QStandardPaths.StandardLocation.AppDataLocation
    return Path(QStandardPaths.writableLocation(place)) / "recovery"


@dataclass(frozen=True)
class Leftover:
    """Unsaved work of a program that did not close in good order."""

    file: Path
    origin: Path | None
    """The project it belongs to; None if it was never saved."""
    kept: datetime
    lock: QLockFile
    """Held, so that no other running program offers the same work."""


class Autosave(QObject):
    """Keeps the session's unsaved work every two minutes, and whenever the artist pauses."""

    failed = Signal(object)
    """A FileError: the work could not be kept. Told once, until it succeeds again."""

    def __init__(
        self, session: Session, folder: Path | None = None, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session = session
        self._folder = folder or recovery_folder()
        self._file = self._folder / f"{uuid4().hex}{project.EXTENSION}"
        self._lock: QLockFile | None = None
        self._kept: Document | None = None
        self._complained = False
        self._every = QTimer(self, interval=EVERY_MS)
        self._idle = QTimer(self, singleShot=True, interval=IDLE_MS)
        self._every.timeout.connect(self.keep)
        self._idle.timeout.connect(self.keep)
        session.changed.connect(self._on_changed)
        session.file_changed.connect(self._on_file_changed)
        self._every.start()

    def keep(self) -> None:
        """Keep the work now, if there is any that is neither saved nor kept."""
        document = self._session.document
        if self._session.dragging or not self._session.dirty or document is self._kept:
            return
        try:
            self._claim()
            project.save(document, self._file)
            self._kept = document
            self._complained = False
        except FileError as error:
            log.warning("Autosave: %s", error)
            if not self._complained:
                self._complained = True
                self.failed.emit(error)

    def leftovers(self) -> list[Leftover]:
        """Return the unsaved work of programs that crashed, newest first."""
        found = []
        for file in self._folder.glob(f"*{project.EXTENSION}"):
            lock = _lock_of(file)
            if file != self._file and lock.tryLock(0):
                kept = datetime.fromtimestamp(file.stat().st_mtime)
                found.append(Leftover(file, _origin(file), kept, lock))
        return sorted(found, key=lambda leftover: leftover.kept, reverse=True)

    def recover(self, leftover: Leftover) -> None:
        """Open unsaved work in the session, still unsaved; FileError when it is damaged."""
        document = project.load(leftover.file)
        self._session.replace(document, leftover.origin, saved=False)
        self.keep()
        if self._kept is document:
            self.discard(leftover)

    def discard(self, leftover: Leftover) -> None:
        """Delete unsaved work."""
        _remove(leftover.file)
        leftover.lock.unlock()

    def close(self) -> None:
        """End in good order: whatever is unsaved now, the artist has chosen to leave."""
        self._session.changed.disconnect(self._on_changed)
        self._session.file_changed.disconnect(self._on_file_changed)
        self._every.stop()
        self._idle.stop()
        self._drop()
        if self._lock:
            self._lock.unlock()

    def _on_changed(self, _document: Document) -> None:
        self._idle.start()

    def _on_file_changed(self) -> None:
        if not self._session.dirty:
            self._drop()
        elif self._lock:
            self._write_note()

    def _claim(self) -> None:
        """Lock the recovery file before it exists, so that it is never taken for a leftover."""
        if self._lock:
            return
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileError(f"Cannot be written: {error.strerror}.") from error
        lock = _lock_of(self._file)
        if not lock.tryLock(0):
            raise FileError("Unsaved work cannot be kept: its folder refuses files.")
        self._lock = lock
        self._write_note()

    def _write_note(self) -> None:
        origin = str(self._session.path or "")
        try:
            _note_of(self._file).write_text(json.dumps({"origin": origin}), "utf-8")
        except OSError as error:
            log.warning("Autosave: %s", error)

    def _drop(self) -> None:
        self._kept = None
        _remove(self._file)


def _origin(file: Path) -> Path | None:
    try:
        origin = json.loads(_note_of(file).read_text("utf-8"))["origin"]
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return Path(origin) if origin and isinstance(origin, str) else None


def _remove(file: Path) -> None:
    for path in (file, _note_of(file)):
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            log.warning("Autosave: %s", error)


def _note_of(file: Path) -> Path:
    return file.with_suffix(".json")


def _lock_of(file: Path) -> QLockFile:
    lock = QLockFile(str(file.with_suffix(".lock")))
    lock.setStaleLockTime(0)  # a program may run for days: only its death makes its lock stale
    return lock
