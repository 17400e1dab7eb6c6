"""The icons in resources/icons, in the colours of the theme."""

from __future__ import annotations

from functools import cache
from importlib.resources import files

from PySide6.QtCore import QByteArray, Qt
from PySide6.QtGui import QAction, QIcon, QPainter, QPixmap
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QAbstractButton, QApplication

from app.style import Colours, colours

SIZES = (16, 20, 32, 40)
"""Pixels: menus and bars, and the same at double density."""
_NAME = "iconName"


def set_icon(thing: QAction | QAbstractButton, name: str) -> None:
    """Give an action or a button an icon, by its file name without suffix; it follows the theme."""
    thing.setProperty(_NAME, name)
    thing.setIcon(_icon(name, colours()))


def retint() -> None:
    """Draw every icon in use in the colours of the theme now in use."""
    for widget in QApplication.allWidgets():
        things = [*widget.actions(), *([widget] if isinstance(widget, QAbstractButton) else [])]
        for thing in things:
            if name := thing.property(_NAME):
                thing.setIcon(_icon(name, colours()))


def pixmap(name: str, size: int, colour: str, ratio: float = 1.0) -> QPixmap:
    """Draw an icon ``size`` pixels wide, for a screen with ``ratio`` device pixels to each."""
    image = _drawn(_renderer(name, colour), round(size * ratio))
    image.setDevicePixelRatio(ratio)
    return image


@cache
def _icon(name: str, c: Colours) -> QIcon:
    icon = QIcon()
    for mode, state, colour in (
        (QIcon.Mode.Normal, QIcon.State.Off, c.text),
        (QIcon.Mode.Normal, QIcon.State.On, c.on_accent),
        (QIcon.Mode.Selected, QIcon.State.Off, c.on_accent),
        (QIcon.Mode.Disabled, QIcon.State.Off, c.disabled),
    ):
        renderer = _renderer(name, colour)
        for size in SIZES:
            icon.addPixmap(_drawn(renderer, size), mode, state)
    return icon


def _drawn(renderer: QSvgRenderer, size: int) -> QPixmap:
    image = QPixmap(size, size)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    renderer.render(painter)
    painter.end()
    return image


def _renderer(name: str, colour: str) -> QSvgRenderer:
    return QSvgRenderer(QByteArray(_svg(name).replace("currentColor", colour).encode()))


@cache
def _svg(name: str) -> str:
    return (files("resources") / "icons" / f"{name}.svg").read_text("utf-8")
