"""The transport: playing, stepping, the current frame, the range and the frame rate."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QMenu, QToolButton, QWidget

from app.document.keyframes import step_key
from app.document.playhead import Loop
from app.fields.frame_rate import FrameRateField
from app.fields.number import NumberField
from app.icons import set_icon
from app.workspace import Workspace
from core.model.structure import MAX_FRAME

LOOP_ICONS = {Loop.ONCE: "once", Loop.LOOP: "loop", Loop.PING_PONG: "ping-pong"}


class Transport(QWidget):
    """A row of controls; all it knows is in the playhead and the document."""

    frame_entered = Signal()
    """A frame number was typed and Return pressed."""
    fit_asked = Signal()

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workspace = workspace
        playhead = workspace.playhead
        row = QHBoxLayout(self)
        row.setContentsMargins(6, 3, 6, 3)
        row.setSpacing(2)
        for widget in self._buttons():
            row.addWidget(widget)
        row.addSpacing(12)
        self.frame = _frame_field(self.tr("Current frame"), decimals=2)
        self.frame.setToolTip(self.tr("Current frame; 12.5 lies half way to frame 13"))
        self.frame.edited.connect(playhead.move_to)
        self.frame.lineEdit().returnPressed.connect(self.frame_entered)
        self._time = QLabel(self)
        row.addWidget(_label(self.tr("Frame"), self.frame))
        row.addWidget(self.frame)
        row.addSpacing(6)
        row.addWidget(self._time)
        row.addSpacing(12)
        row.addStretch(1)
        self._add_range(row)
        row.addSpacing(12)
        self.frame_rate = FrameRateField(workspace.session)
        self.frame_rate.setFixedWidth(68)
        row.addWidget(self.frame_rate)
        row.addWidget(_label(self.tr("fps"), self.frame_rate))
        row.addSpacing(8)
        fit = _button("fit", self.tr("Show all of time"), self.fit_asked.emit)
        row.addWidget(fit)
        playhead.moved.connect(self._show_frame)
        playhead.playing_changed.connect(self._show_playing)
        playhead.loop_changed.connect(self._show_loop)
        playhead.range_changed.connect(self._show_range)
        workspace.session.changed.connect(self._show_range)
        self._show_loop()
        self._show_range()

    def _buttons(self) -> list[QToolButton]:
        playhead = self._workspace.playhead
        self.play = _button("play", self.tr("Play (Space)"), playhead.toggle)
        self.loop = _button("loop", "", None)
        self.loop.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self.loop)
        for loop, text in self._loop_names().items():
            set_icon(menu.addAction(text, partial(playhead.set_loop, loop)), LOOP_ICONS[loop])
        self.loop.setMenu(menu)
        step, jump = playhead.step, partial(step_key, playhead, self._workspace.selection)
        return [
            _button("first", self.tr("To the start (Home)"), playhead.to_start),
            _button("previous-key", self.tr("Previous key (Ctrl+Left)"), partial(jump, -1)),
            _button("previous-frame", self.tr("Previous frame (Left)"), partial(step, -1)),
            self.play,
            _button("next-frame", self.tr("Next frame (Right)"), partial(step, 1)),
            _button("next-key", self.tr("Next key (Ctrl+Right)"), partial(jump, 1)),
            _button("last", self.tr("To the end (End)"), playhead.to_end),
            self.loop,
        ]

    def _add_range(self, row: QHBoxLayout) -> None:
        self.first = _frame_field(self.tr("First frame played"))
        self.last = _frame_field(self.tr("Last frame played"))
        self.everything = _button(
            "close", self.tr("Play everything"), partial(self._workspace.playhead.set_range, None)
        )
        for field in (self.first, self.last):
            field.edited.connect(self._set_range)
        row.addWidget(_label(self.tr("Play"), self.first))
        row.addWidget(self.first)
        row.addWidget(_label("–", self.last))
        row.addWidget(self.last)
        row.addWidget(self.everything)

    def _loop_names(self) -> dict[Loop, str]:
        return {
            Loop.ONCE: self.tr("Play once"),
            Loop.LOOP: self.tr("Loop"),
            Loop.PING_PONG: self.tr("Ping-pong"),
        }

    # -- keeping up ----------------------------------------------------------------------------

    def _set_range(self) -> None:
        self._workspace.playhead.set_range((int(self.first.value()), int(self.last.value())))

    def _show_frame(self) -> None:
        playhead, fps = self._workspace.playhead, self._workspace.session.document.fps
        self.frame.limit(playhead.lowest, MAX_FRAME)
        self.frame.show_value(playhead.frame)
        self._time.setText(self.tr("{:.2f} s").format((playhead.frame - playhead.lowest) / fps))

    def _show_playing(self, playing: bool) -> None:
        set_icon(self.play, "pause" if playing else "play")
        name = self.tr("Pause (Space)") if playing else self.tr("Play (Space)")
        self.play.setToolTip(name)
        self.play.setAccessibleName(name)

    def _show_loop(self) -> None:
        loop = self._workspace.playhead.loop
        name = self._loop_names()[loop]
        set_icon(self.loop, LOOP_ICONS[loop])
        self.loop.setToolTip(self.tr("At the end: {}").format(name))
        self.loop.setAccessibleName(self.tr("At the end: {}").format(name))

    def _show_range(self) -> None:
        playhead = self._workspace.playhead
        first, last = playhead.range
        self.first.limit(playhead.lowest, last)
        self.last.limit(first, MAX_FRAME)
        self.first.show_value(first)
        self.last.show_value(last)
        self.everything.setEnabled(playhead.limited)
        self._show_frame()


def _button(name: str, text: str, clicked: Callable[[], object] | None) -> QToolButton:
    button = QToolButton(autoRaise=True)
    set_icon(button, name)
    button.setIconSize(QSize(18, 18))
    button.setToolTip(text)
    button.setAccessibleName(text)
    if clicked:
        button.clicked.connect(clicked)
    return button


def _frame_field(name: str, decimals: int = 0) -> NumberField:
    field = NumberField(name, 1, MAX_FRAME, decimals=decimals)
    field.setFixedWidth(64)
    return field


def _label(text: str, buddy: QWidget) -> QLabel:
    label = QLabel(text)
    label.setBuddy(buddy)
    label.setContentsMargins(2, 0, 4, 0)
    return label
