"""How Betwixt looks: every colour named once, for a dark and a light theme."""

from __future__ import annotations

from dataclasses import dataclass, replace
from importlib.resources import files
from pathlib import Path
from typing import Literal

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QFont, QPalette
from PySide6.QtWidgets import QApplication, QStyleFactory

Theme = Literal["dark", "light", "system"]
THEMES: tuple[Theme, ...] = ("dark", "light", "system")

TARGET_SIZE = 28
"""Pixels: the least height of whatever is clicked."""
RADIUS = 5
SMALLEST_FONT = 10.0
"""Points: some systems start with less than can be read."""


@dataclass(frozen=True)
class Colours:
    """The colours of a theme, as "#rrggbb"."""

    window: str
    """Behind panels, menus and bars."""
    base: str
    """Inside lists and fields."""
    raised: str
    """Buttons, headers."""
    hover: str
    line: str
    """Borders and separators."""
    text: str
    muted: str
    """Text that comes second."""
    disabled: str
    pasteboard: str
    """Around the artboard."""
    accent: str
    """What is chosen or pressed."""
    on_accent: str
    error_ground: str
    """Behind an error message."""
    note_ground: str
    """Behind any other message."""
    source: str = "#e4572e"
    """The keyframe before, and onion skins of what came before."""
    target: str = "#2e86de"
    """The keyframe after, and onion skins of what comes after."""
    mark: str = "#f5b700"
    on_mark: str = "#2b2100"
    selection: str = "#00b8d9"
    error: str = "#ff2d7a"
    solved: str = "#3fa66b"
    solving: str = "#d9a514"


DARK = Colours(
    window="#2a2c31",
    base="#212327",
    raised="#383b42",
    hover="#444850",
    line="#17181b",
    text="#e6e8ec",
    muted="#a3a9b4",
    disabled="#6c727d",
    pasteboard="#1b1c20",
    accent="#2f7fd6",
    on_accent="#ffffff",
    error_ground="#5c1f3a",
    note_ground="#23415e",
)
LIGHT = replace(
    DARK,
    window="#f1f2f4",
    base="#ffffff",
    raised="#fbfbfc",
    hover="#dfe5ee",
    line="#c3c8d0",
    text="#1c1f24",
    muted="#59606c",
    disabled="#9aa1ac",
    pasteboard="#d3d7dd",
    accent="#1f6fc4",
    error_ground="#ffdce8",
    note_ground="#d8e8fa",
    solved="#2c8d57",
    solving="#b98700",
)

_current = DARK


def colours() -> Colours:
    """Return the colours of the theme in use; widgets are repainted when it changes."""
    return _current


def colours_of(theme: Theme) -> Colours:
    """Return the colours of a theme; "system" follows the desktop, and is dark if that is mute."""
    light = QApplication.styleHints().colorScheme() == Qt.ColorScheme.Light
    return LIGHT if theme == "light" or (theme == "system" and light) else DARK


def apply_theme(theme: Theme) -> None:
    """Dress the whole application."""
    global _current
    _current = colours_of(theme)
    app = QApplication.instance()
    assert isinstance(app, QApplication)
    app.setStyle(QStyleFactory.create("Fusion"))
    app.setPalette(_palette(_current))
    app.setStyleSheet(_sheet(_current))
    font = QFont(app.font())
    if 0 < font.pointSizeF() < SMALLEST_FONT:
        font.setPointSizeF(SMALLEST_FONT)
        app.setFont(font)


def _palette(c: Colours) -> QPalette:
    role = QPalette.ColorRole
    palette = QPalette(QColor(c.raised), QColor(c.window))
    for which, colour in {
        role.Window: c.window,
        role.WindowText: c.text,
        role.Base: c.base,
        role.AlternateBase: c.window,
        role.Text: c.text,
        role.PlaceholderText: c.muted,
        role.Button: c.raised,
        role.ButtonText: c.text,
        role.BrightText: c.error,
        role.ToolTipBase: c.raised,
        role.ToolTipText: c.text,
        role.Highlight: c.accent,
        role.HighlightedText: c.on_accent,
        role.Accent: c.accent,
        role.Link: c.accent,
        role.LinkVisited: c.accent,
        role.Light: c.hover,
        role.Midlight: c.raised,
        role.Mid: c.line,
        role.Dark: c.line,
        role.Shadow: c.line,
    }.items():
        palette.setColor(which, QColor(colour))
    off = QPalette.ColorGroup.Disabled
    for which in (role.WindowText, role.Text, role.ButtonText, role.HighlightedText):
        palette.setColor(off, which, QColor(c.disabled))
    palette.setColor(off, role.Highlight, QColor(c.raised))
    return palette


def _image(name: str) -> str:
    return (Path(str(files("resources"))) / "icons" / f"{name}.svg").as_posix()


def _sheet(c: Colours) -> str:
    """Return what a palette cannot say; everything else is left to Fusion."""
    return f"""
    QMainWindow::separator {{ background: {c.line}; width: 3px; height: 3px; }}
    QMainWindow::separator:hover {{ background: {c.accent}; }}
    DockTitle QLabel {{ font-weight: 600; }}
    QToolBar {{ background: {c.window}; border: 0; spacing: 3px; padding: 4px; }}
    QToolBar::separator {{ background: {c.hover}; margin: 6px; width: 1px; height: 1px; }}
    QToolButton {{
        border: 1px solid transparent; border-radius: {RADIUS}px; padding: 3px;
        min-width: {TARGET_SIZE - 8}px; min-height: {TARGET_SIZE - 8}px;
    }}
    QToolButton:hover, QToolButton:focus {{ background: {c.hover}; }}
    QToolButton:focus {{ border-color: {c.accent}; }}
    QToolButton:checked {{ background: {c.accent}; color: {c.on_accent}; }}
    QToolButton:pressed {{ background: {c.accent}; }}
    QPushButton {{
        background: {c.raised}; border: 1px solid {c.line}; border-radius: {RADIUS}px;
        padding: 4px 14px; min-height: {TARGET_SIZE - 10}px;
    }}
    QPushButton:hover {{ background: {c.hover}; }}
    QPushButton:focus {{ border-color: {c.accent}; }}
    QPushButton:pressed {{ background: {c.line}; }}
    QPushButton:default {{
        background: {c.accent}; color: {c.on_accent}; border-color: {c.accent};
    }}
    QPushButton:disabled {{ color: {c.disabled}; background: {c.window}; }}
    QCheckBox, QRadioButton {{ spacing: 8px; min-height: {TARGET_SIZE - 4}px; }}
    QCheckBox::indicator, QRadioButton::indicator {{
        width: 14px; height: 14px; border: 1px solid {c.muted}; background: {c.base};
    }}
    QCheckBox::indicator {{ border-radius: 3px; }}
    QRadioButton::indicator {{ border-radius: 8px; }}
    QCheckBox::indicator:checked {{
        background: {c.accent}; border-color: {c.accent}; image: url({_image("checked")});
    }}
    QRadioButton::indicator:checked {{
        border-color: {c.accent};
        background: qradialgradient(cx: 0.5, cy: 0.5, radius: 0.5, fx: 0.5, fy: 0.5,
            stop: 0.4 {c.on_accent}, stop: 0.5 {c.accent});
    }}
    QCheckBox::indicator:hover, QRadioButton::indicator:hover {{ border-color: {c.accent}; }}
    QCheckBox::indicator:disabled, QRadioButton::indicator:disabled {{
        border-color: {c.disabled}; background: {c.window};
    }}
    QMenuBar {{ background: {c.window}; padding: 2px; }}
    QMenuBar::item {{ padding: 5px 9px; border-radius: {RADIUS}px; }}
    QMenuBar::item:selected {{ background: {c.hover}; }}
    QMenu {{ background: {c.window}; border: 1px solid {c.line}; padding: 4px; }}
    QMenu::item {{ padding: 5px 28px 5px 10px; border-radius: {RADIUS}px; }}
    QMenu::item:selected {{ background: {c.accent}; color: {c.on_accent}; }}
    QMenu::item:disabled {{ color: {c.disabled}; background: transparent; }}
    QMenu::icon {{ padding-left: 6px; }}
    QMenu::separator {{ height: 1px; background: {c.hover}; margin: 4px 8px; }}
    QStatusBar {{ background: {c.window}; border-top: 1px solid {c.line}; }}
    QStatusBar::item {{ border: 0; }}
    MessageBar[tone="error"] {{ background: {c.error_ground}; border-color: {c.error}; }}
    MessageBar[tone="note"] {{ background: {c.note_ground}; border-color: {c.accent}; }}
    MessageBar {{ border: 1px solid {c.line}; border-radius: {RADIUS}px; }}
    WelcomePanel {{ border: 0; border-left: 1px solid {c.line}; }}
    WelcomePanel QPushButton {{ padding: 4px 6px; }}
    QLabel#problem {{
        background: {c.error_ground}; border: 1px solid {c.error}; border-radius: {RADIUS}px;
        padding: 6px 10px;
    }}
    QLabel#title {{ font-size: 14pt; font-weight: 600; }}
    QLabel#heading {{ color: {c.muted}; font-weight: 600; padding-top: 6px; }}
    QToolTip {{
        background: {c.raised}; color: {c.text}; border: 1px solid {c.line}; padding: 4px;
    }}
    """
