"""What to begin with: a sample, a recent file, or something new."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.icons import set_icon
from app.settings import Settings
from app.thumbnails import document_thumbnail
from core.errors import FileError
from core.io import project

WIDTH = 300
THUMBNAIL = QSize(112, 66)
COLUMNS = 2
RECENT_SHOWN = 5


class WelcomePanel(QFrame):
    """Stands beside the canvas, so that the sample keeps moving in sight."""

    new_asked = Signal()
    open_asked = Signal()
    import_asked = Signal()
    sample_chosen = Signal(object)
    """The Path of a sample."""
    recent_chosen = Signal(object)
    """The Path of a recent file."""
    closed = Signal()

    def __init__(
        self, samples: Sequence[Path], settings: Settings, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._samples, self._settings = list(samples), settings
        self._cards: list[_Card] = []
        self.setAccessibleName(self.tr("Welcome"))
        self.setFixedWidth(WIDTH)
        self._make_widgets()
        self._lay_out()
        self._list_recent()
        settings.recent_changed.connect(self._list_recent)
        self._draw_later = QTimer(self, singleShot=True, interval=0)
        self._draw_later.timeout.connect(self._draw_next)
        self._draw_later.start()

    # -- making it -----------------------------------------------------------------------------

    def _make_widgets(self) -> None:
        self.title = QLabel(self.tr("Welcome to Betwixt"), objectName="title")
        self.about = QLabel(
            self.tr("Draw or import two outlines, mark the points that belong together, and play."),
            wordWrap=True,
        )
        self.close_button = QToolButton()
        self.close_button.setAccessibleName(self.tr("Close welcome"))
        self.close_button.setToolTip(self.tr("Close; the Help menu brings it back"))
        set_icon(self.close_button, "close")
        self.close_button.clicked.connect(self.closed)
        self.new = self._button(self.tr("New"), "new", self.new_asked)
        self.open = self._button(self.tr("Open…"), "open", self.open_asked)
        self.import_ = self._button(self.tr("Import…"), "import", self.import_asked)
        self.at_start = QCheckBox(self.tr("Show at the start"))
        self.at_start.setChecked(self._settings.welcome)
        self.at_start.toggled.connect(self._on_at_start)
        for path in self._samples:
            card = _Card(path)
            card.chosen.connect(self.sample_chosen)
            self._cards.append(card)

    def _button(self, text: str, icon: str, signal: Signal) -> QPushButton:
        button = QPushButton(text)
        set_icon(button, icon)
        button.clicked.connect(signal)
        return button

    def _lay_out(self) -> None:
        content = QWidget()
        column = QVBoxLayout(content)
        column.setContentsMargins(14, 12, 14, 12)
        column.setSpacing(6)
        head = QHBoxLayout()
        head.addWidget(self.title, 1)
        head.addWidget(self.close_button)
        column.addLayout(head)
        column.addWidget(self.about)
        column.addSpacing(4)
        begin = QHBoxLayout()
        begin.setSpacing(6)
        for button in (self.new, self.open, self.import_):
            button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
            begin.addWidget(button)
        column.addLayout(begin)
        column.addWidget(_heading(self.tr("Samples")))
        grid = QGridLayout()
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(2)
        for i, card in enumerate(self._cards):
            grid.addWidget(card, i // COLUMNS, i % COLUMNS)
        column.addLayout(grid)
        self.recent_heading = _heading(self.tr("Recent"))
        column.addWidget(self.recent_heading)
        self._recent = QVBoxLayout()
        self._recent.setSpacing(0)
        column.addLayout(self._recent)
        column.addStretch(1)
        column.addWidget(self.at_start)
        scroll = QScrollArea(widgetResizable=True, frameShape=QFrame.Shape.NoFrame)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setWidget(content)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.addWidget(scroll)

    # -- what is shown -------------------------------------------------------------------------

    def _draw_next(self) -> None:
        """Draw one thumbnail at a time, so that the window is not kept waiting."""
        card = next((card for card in self._cards if not card.drawn), None)
        if card is not None:
            card.draw()
            self._draw_later.start()

    def _list_recent(self) -> None:
        while (item := self._recent.takeAt(0)) is not None:
            item.widget().deleteLater()
        paths = [path for path in self._settings.recent if path.is_file()][:RECENT_SHOWN]
        self.recent_heading.setVisible(bool(paths))
        for path in paths:
            link = _Link(path)
            link.chosen.connect(self.recent_chosen)
            self._recent.addWidget(link)

    def _on_at_start(self, shown: bool) -> None:
        self._settings.welcome = shown


class _Card(QToolButton):
    """A sample: its picture above its name."""

    chosen = Signal(object)

    def __init__(self, path: Path) -> None:
        super().__init__()
        self._path = path
        self.drawn = False
        name = _title(path.stem)
        self.setText(name)
        self.setAccessibleName(self.tr("Sample: {name}").format(name=name))
        self.setToolTip(self.tr("Open a copy of this sample"))
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextUnderIcon)
        self.setIconSize(THUMBNAIL)
        self.setMinimumWidth(0)
        blank = QPixmap(THUMBNAIL)
        blank.fill(Qt.GlobalColor.transparent)
        self.setIcon(blank)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.clicked.connect(self._on_clicked)

    def draw(self) -> None:
        """Draw the picture."""
        self.drawn = True
        try:
            document = project.load(self._path)
        except FileError:
            self.setEnabled(False)
        else:
            self.setIcon(document_thumbnail(document, THUMBNAIL, self.devicePixelRatioF()))

    def _on_clicked(self) -> None:
        self.chosen.emit(self._path)


class _Link(QToolButton):
    """A recent file."""

    chosen = Signal(object)

    def __init__(self, path: Path) -> None:
        super().__init__()
        self._path = path
        self.setText(path.stem.replace("&", "&&"))
        self.setToolTip(str(path))
        self.setAccessibleName(self.tr("Open {name}").format(name=path.stem))
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        set_icon(self, "open")
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.clicked.connect(self._on_clicked)

    def _on_clicked(self) -> None:
        self.chosen.emit(self._path)


def _title(stem: str) -> str:
    """Turn "letter-a-to-r" into "Letter A to R"."""
    first, *others = stem.split("-")
    words = [first.capitalize(), *(word.upper() if len(word) == 1 else word for word in others)]
    return " ".join(words)


def _heading(text: str) -> QLabel:
    label = QLabel(text)
    label.setObjectName("heading")
    return label
