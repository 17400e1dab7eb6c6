"""Every question that is asked of the artist about files, each as one function."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Literal, TypeVar

from PySide6.QtCore import QCoreApplication, QLocale, Qt, QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from app.document.autosave import Leftover

Answer = TypeVar("Answer")


def ask_open(parent: QWidget, title: str, folder: Path, filters: str) -> Path | None:
    """Ask for a file to read."""
    name, _ = QFileDialog.getOpenFileName(parent, title, str(folder), filters)
    return Path(name) if name else None


def ask_save(parent: QWidget, title: str, path: Path, filters: str) -> Path | None:
    """Ask for a file to write; replacing one was agreed to."""
    name, _ = QFileDialog.getSaveFileName(parent, title, str(path), filters)
    return Path(name) if name else None


def ask_folder(parent: QWidget, title: str, folder: Path) -> Path | None:
    """Ask for a folder."""
    name = QFileDialog.getExistingDirectory(parent, title, str(folder))
    return Path(name) if name else None


def ask_unsaved(parent: QWidget, name: str) -> Literal["save", "discard", "cancel"]:
    """Ask what becomes of unsaved work."""
    return _ask(
        parent,
        _tr("Save the changes to “{name}”?").format(name=name),
        _tr("They are lost if you do not save them."),
        {"save": _tr("&Save"), "discard": _tr("&Discard"), "cancel": _tr("&Cancel")},
        default="save",
    )


def ask_recovery(parent: QWidget, leftover: Leftover) -> Literal["recover", "discard", "later"]:
    """Ask what becomes of the work that a crash left behind."""
    name = leftover.origin.stem if leftover.origin else _tr("an unsaved project")
    when = QLocale().toString(leftover.kept, QLocale.FormatType.ShortFormat)
    return _ask(
        parent,
        _tr("Betwixt did not close properly. Recover your work?"),
        _tr("Unsaved changes to {name}, kept {when}.").format(name=name, when=when),
        {"recover": _tr("&Recover"), "discard": _tr("&Discard"), "later": _tr("&Later")},
        default="recover",
    )


def ask_replace(parent: QWidget, paths: Sequence[Path]) -> bool:
    """Ask whether files that exist, all in one folder, may be replaced."""
    text = _tr("Replace {count} files in “{folder}”?") if len(paths) > 1 else _tr("Replace “{}”?")
    return _ask(
        parent,
        text.format(paths[0].name, count=len(paths), folder=paths[0].parent.name),
        "",
        {True: _tr("&Replace"), False: _tr("&Cancel")},
        default=False,
    )


def show_folder(folder: Path) -> None:
    """Show a folder in the system's file manager."""
    QDesktopServices.openUrl(QUrl.fromLocalFile(str(folder)))


def _ask(
    parent: QWidget, text: str, details: str, answers: dict[Answer, str], *, default: Answer
) -> Answer:
    """Ask a question: the first answer says yes, the last one is also that of Esc."""
    box = QMessageBox(QMessageBox.Icon.Question, "Betwixt", text, parent=parent)
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setInformativeText(details)
    first, *others, last = answers
    roles = {first: QMessageBox.ButtonRole.AcceptRole, last: QMessageBox.ButtonRole.RejectRole}
    roles |= dict.fromkeys(others, QMessageBox.ButtonRole.DestructiveRole)
    buttons = {answer: box.addButton(answers[answer], roles[answer]) for answer in answers}
    box.setDefaultButton(buttons[default])
    box.setEscapeButton(buttons[last])
    box.exec()
    return next((a for a, button in buttons.items() if button is box.clickedButton()), last)


def _tr(text: str) -> str:
    return QCoreApplication.translate("FileDialogs", text)
