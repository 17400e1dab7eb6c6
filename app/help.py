"""The Help menu: every shortcut, and what this program is."""

from __future__ import annotations

from importlib.metadata import version

from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from app.actions import ENTRIES, translated
from app.icons import pixmap
from app.menus import MENUS, Items
from app.style import colours

ON_THE_CANVAS = (
    ("Wheel", "Zoom at the cursor"),
    ("Middle drag, H or Space with drag", "Move the view"),
    ("Enter", "Close the outline that is being drawn"),
    ("Esc", "Leave what is under way, then the tool"),
    ("Arrows", "Move what is selected; with Shift ten times as far"),
    ("Del", "Delete what is selected"),
)
COLUMNS = 3
LICENCES = """
<p>Betwixt draws the frames between two outlines, as rigidly as possible.</p>
<p>Betwixt itself is under the MIT licence. It uses, among others:</p>
<ul>
<li><b>Triangle</b> by Jonathan Richard Shewchuk, through the <i>triangle</i> package: free to use,
but it may not be sold or included in commercial products without an arrangement with its
author.</li>
<li><b>Qt</b> through <i>PySide6</i>: LGPL version 3.</li>
<li><b>NumPy</b>, <b>SciPy</b>, <b>shapely</b>, <b>msgspec</b>: BSD licences.</li>
<li><b>pyqtgraph</b>, <b>svgelements</b>, <b>tqdm</b>: MIT licences (tqdm also MPL 2.0).</li>
</ul>
"""


def show_shortcuts(parent: QWidget) -> None:
    """List every shortcut, menu by menu."""
    dialog = _dialog(parent, _tr("Keyboard shortcuts"))
    grid = QHBoxLayout()
    grid.setSpacing(36)
    sections = [(title.replace("&", ""), _rows(items)) for title, items in MENUS]
    sections = [section for section in sections if section[1]]
    sections.append(
        (_tr("On the canvas"), [(_tr(keys), _tr(text)) for keys, text in ON_THE_CANVAS])
    )
    for sections_of_column in _balanced(sections):
        column = QVBoxLayout()
        for title, rows in sections_of_column:
            column.addLayout(_section(translated(title), rows))
        column.addStretch(1)
        grid.addLayout(column)
    content = QWidget()
    content.setLayout(grid)
    scroll = QScrollArea(widgetResizable=True, frameShape=QScrollArea.Shape.NoFrame)
    scroll.setWidget(content)
    hint = content.sizeHint()
    scroll.setMinimumSize(min(hint.width() + 24, 1180), min(hint.height() + 8, 640))
    dialog.layout().insertWidget(0, scroll)
    dialog.exec()
    dialog.deleteLater()


def show_about(parent: QWidget) -> None:
    """Say what this program is, and under which terms it comes."""
    dialog = _dialog(parent, _tr("About Betwixt"))
    head = QHBoxLayout()
    head.setSpacing(14)
    picture = QLabel()
    picture.setPixmap(pixmap("betwixt", 64, "", parent.devicePixelRatioF()))
    title = QLabel(f"<h2>Betwixt {version('betwixt')}</h2>")
    head.addWidget(picture)
    head.addWidget(title, 1)
    text = QLabel(_tr(LICENCES), wordWrap=True)
    text.setMinimumWidth(460)
    dialog.layout().insertLayout(0, head)
    dialog.layout().insertWidget(1, text)
    dialog.exec()
    dialog.deleteLater()


def _rows(items: Items) -> list[tuple[str, str]]:
    """Return (keys, text) for every action in a menu and in the menus within it."""
    entries = {entry.id: entry for entry in ENTRIES}
    rows = []
    for item in items:
        if isinstance(item, tuple):
            rows += _rows(item[1])
        elif item in entries and entries[item].keys:
            native = QKeySequence.SequenceFormat.NativeText
            keys = "  or  ".join(QKeySequence(key).toString(native) for key in entries[item].keys)
            rows.append((keys, translated(entries[item].text).replace("&", "").rstrip("…")))
    return rows


def _balanced(sections: list[tuple[str, list]]) -> list[list[tuple[str, list]]]:
    """Share the sections out to columns of about the same height, in order."""
    height = sum(len(rows) + 2 for _, rows in sections) / COLUMNS
    columns: list[list[tuple[str, list]]] = [[]]
    filled = 0.0
    for section in sections:
        if filled >= height and len(columns) < COLUMNS:
            columns.append([])
            filled = 0.0
        columns[-1].append(section)
        filled += len(section[1]) + 2
    return columns


def _section(title: str, rows: list[tuple[str, str]]) -> QGridLayout:
    grid = QGridLayout()
    grid.setHorizontalSpacing(16)
    grid.setVerticalSpacing(4)
    grid.setColumnStretch(1, 1)
    head = QLabel(f"<b>{title}</b>")
    grid.addWidget(head, 0, 0, 1, 2)
    for i, (keys, text) in enumerate(rows, 1):
        label = QLabel(keys)
        label.setStyleSheet(f"color: {colours().muted}")
        grid.addWidget(label, i, 0)
        grid.addWidget(QLabel(text), i, 1)
    grid.setContentsMargins(0, 0, 0, 14)
    return grid


def _dialog(parent: QWidget, title: str) -> QDialog:
    dialog = QDialog(parent)
    dialog.setWindowTitle(title)
    column = QVBoxLayout(dialog)
    column.setContentsMargins(18, 16, 18, 14)
    buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
    buttons.rejected.connect(dialog.reject)
    column.addWidget(buttons, alignment=Qt.AlignmentFlag.AlignRight)
    return dialog


def _tr(text: str) -> str:
    return QCoreApplication.translate("Help", text)
