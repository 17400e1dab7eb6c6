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

from app.actions import ENTRIES
from app.entries import Entry, translated
from app.icons import pixmap
from app.menus import MENUS, Items
from app.style import colours

ON_THE_CANVAS = (
    ("Wheel", "Zoom at the cursor"),
    ("Middle drag   H   Space", "Move the view"),
    ("Enter", "Close the outline"),
    ("Esc", "Leave a drawing, then the tool"),
    ("Arrows", "Move what was clicked; Shift: ten times as far"),
    ("Del", "Delete what is selected"),
)
COLUMNS = 3
WIDEST, HIGHEST = 1200, 680
Row = tuple[str, str]
"""Keys, and what they do."""
Section = tuple[str, list[Row]]
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
    content = QWidget()
    columns = QHBoxLayout(content)
    columns.setContentsMargins(0, 0, 12, 12)
    columns.setSpacing(40)
    for sections in _balanced(_sections()):
        columns.addWidget(_column(sections), alignment=Qt.AlignmentFlag.AlignTop)
    scroll = QScrollArea(widgetResizable=True, frameShape=QScrollArea.Shape.NoFrame)
    scroll.setWidget(content)
    hint = content.sizeHint()
    scroll.setMinimumSize(min(hint.width() + 16, WIDEST), min(hint.height(), HIGHEST))
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


def _sections() -> list[Section]:
    """Return every menu that has shortcuts, each action where it comes first."""
    entries = {entry.id: entry for entry in ENTRIES if entry.keys}
    sections: list[Section] = []

    def add(title: str, items: Items) -> None:
        rows = [_row(entries.pop(item)) for item in items if item in entries]
        if rows:
            sections.append((translated(title).replace("&", ""), rows))
        for item in items:
            if isinstance(item, tuple):
                add(*item)

    for menu in MENUS:
        add(*menu)
    on_canvas = [(_tr(keys), _tr(text)) for keys, text in ON_THE_CANVAS]
    return [*sections, (_tr("On the canvas"), on_canvas)]


def _row(entry: Entry) -> Row:
    native = QKeySequence.SequenceFormat.NativeText
    keys = [QKeySequence(key).toString(native) for key in entry.keys]
    return "   ".join(keys), translated(entry.text).replace("&", "").rstrip("…")


def _balanced(sections: list[Section]) -> list[list[Section]]:
    """Share the sections out to columns of about the same height, in order."""
    height = sum(len(rows) + 2 for _, rows in sections) / COLUMNS
    columns: list[list[Section]] = [[]]
    filled = 0.0
    for section in sections:
        size = len(section[1]) + 2
        if columns[-1] and filled + size / 2 > height and len(columns) < COLUMNS:
            columns.append([])
            filled = 0.0
        columns[-1].append(section)
        filled += size
    return columns


def _column(sections: list[Section]) -> QWidget:
    column = QWidget()
    grid = QGridLayout(column)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.setHorizontalSpacing(16)
    grid.setVerticalSpacing(4)
    for title, rows in sections:
        head = QLabel(f"<b>{title}</b>")
        head.setContentsMargins(0, 12 if grid.count() else 0, 0, 0)
        grid.addWidget(head, grid.rowCount(), 0, 1, 2)
        for keys, text in rows:
            label = QLabel(keys)
            label.setStyleSheet(f"color: {colours().muted}")
            grid.addWidget(label, grid.rowCount(), 0)
            grid.addWidget(QLabel(text), grid.rowCount() - 1, 1)
    return column


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
