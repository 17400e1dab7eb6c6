"""Every question that is asked of the artist about files, each as one function."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from PySide6.QtCore import QCoreApplication, QLocale, QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from app.document.autosave import Leftover


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
    box = _box(parent, _tr("Save the changes to “{name}”?").format(name=name))
    box.setInformativeText(_tr("They are lost if you do not save them."))
    save = box.addButton(_tr("&Save"), QMessageBox.ButtonRole.AcceptRole)
    discard = box.addButton(_tr("&Discard"), QMessageBox.ButtonRole.DestructiveRole)
    cancel = box.addButton(_tr("&Cancel"), QMessageBox.ButtonRole.RejectRole)
    box.setDefaultButton(save)
    box.setEscapeButton(cancel)
    box.exec()
    clicked = box.clickedButton()
    return "save" if clicked is save else "discard" if clicked is discard else "cancel"


def ask_recovery(parent: QWidget, leftover: Leftover) -> Literal["recover", "discard", "later"]:
    """Ask what becomes of the work that a crash left behind."""
    name = leftover.origin.stem if leftover.origin else _tr("an unsaved project")
    when = QLocale().toString(leftover.kept, QLocale.FormatType.ShortFormat)
    box = _box(parent, _tr("Betwixt did not close properly. Recover your work?"))
    box.setInformativeText(
        _tr("Unsaved changes to {name}, kept {when}.").format(name=name, when=when)
    )
    recover = box.addButton(_tr("&Recover"), QMessageBox.ButtonRole.AcceptRole)
    discard = box.addButton(_tr("&Discard"), QMessageBox.ButtonRole.DestructiveRole)
    later = box.addButton(_tr("&Later"), QMessageBox.ButtonRole.RejectRole)
    box.setDefaultButton(recover)
    box.setEscapeButton(later)
    box.exec()
    clicked = box.clickedButton()
    return "recover" if clicked is recover else "discard" if clicked is discard else "later"


def ask_replace(parent: QWidget, count: int, folder: Path) -> bool:
    """Ask whether files that exist may be replaced."""
    text = _tr("Replace {count} files in “{folder}”?") if count > 1 else _tr("Replace the file?")
    box = _box(parent, text.format(count=count, folder=folder.name))
    replace = box.addButton(_tr("&Replace"), QMessageBox.ButtonRole.AcceptRole)
    cancel = box.addButton(_tr("&Cancel"), QMessageBox.ButtonRole.RejectRole)
    box.setDefaultButton(cancel)
    box.setEscapeButton(cancel)
    box.exec()
    return box.clickedButton() is replace


def show_folder(folder: Path) -> None:
    """Show a folder in the system's file manager."""
    QDesktopServices.openUrl(QUrl.fromLocalFile(str(folder)))


def _box(parent: QWidget, text: str) -> QMessageBox:
    box = QMessageBox(parent)
    box.setIcon(QMessageBox.Icon.Question)
    box.setWindowTitle("Betwixt")
    box.setText(text)
    return box


def _tr(text: str) -> str:
    return QCoreApplication.translate("FileDialogs", text)
