"""What a row of the table of actions says: what is done, how it is called, and when it can be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication

from app.document.playhead import Loop, Playhead
from app.document.selection import Selection
from app.document.session import Session
from app.workspace import ShowSuggestions, ViewOptions
from core.model.easing import PRESETS

if TYPE_CHECKING:
    from app.canvas.canvas import Canvas
    from app.clipboard import Clipboard
    from app.commands import Commands
    from app.files.files import Files
    from app.jobs.solver import Solver
    from app.jobs.suggestions import Suggestions
    from app.main_window import MainWindow


@dataclass(frozen=True)
class Desk:
    """All that an action may act on."""

    session: Session
    selection: Selection
    playhead: Playhead
    solver: Solver
    view: ViewOptions
    suggestions: Suggestions
    canvas: Canvas
    commands: Commands
    files: Files
    clipboard: Clipboard
    window: MainWindow


Do = Callable[[Desk], object]
Ask = Callable[[Desk], bool]


@dataclass(frozen=True)
class Entry:
    """One row of the table."""

    id: str
    text: str
    do: Do
    keys: tuple[str, ...] = ()
    icon: str = ""
    when: Ask | None = None
    """Whether it can be done now; None for always."""
    on: Ask | None = None
    """Whether it is on now; None for what is never on."""
    group: str = ""
    """Entries of the same group exclude each other."""
    title: Callable[[Desk], str] | None = None
    """The text as things stand, where it depends on them."""


def translated(text: str) -> str:
    """Return a text of this table in the language of the user."""
    return QCoreApplication.translate("Actions", text)


# -- when ------------------------------------------------------------------------------------------


def has_layer(d: Desk) -> bool:
    """Whether there is a layer."""
    return d.selection.layer is not None


def has_span(d: Desk) -> bool:
    """Whether the current layer moves."""
    return d.selection.layer is not None and d.selection.layer.spans > 0


def on_free_frame(d: Desk) -> bool:
    """Whether the playhead is where the current layer has no keyframe."""
    layer = d.selection.layer
    return layer is not None and layer.key_at(round(d.playhead.frame)) is None


def has_marks(d: Desk) -> bool:
    """Whether the current layer has marks."""
    return d.selection.layer is not None and bool(d.selection.layer.labels)


def has_mark(d: Desk) -> bool:
    """Whether a mark is selected."""
    return d.selection.mark is not None


def has_suggestions(d: Desk) -> bool:
    """Whether suggested marks are on show."""
    return bool(d.suggestions.shown)


def has_undo(d: Desk) -> bool:
    """Whether there is a step to take back."""
    return d.session.undo_stack.canUndo() or d.session.dragging


def key_title(text: str) -> Callable[[Desk], str]:
    """Return a title that names the frame of the chosen keyframe."""

    def title(d: Desk) -> str:
        keyframe = d.selection.keyframe
        return translated(text).format(frame=keyframe.frame if keyframe else "")

    return title


# -- rows of a kind --------------------------------------------------------------------------------


def tool(name: str, text: str, *keys: str) -> Entry:
    """Return the entry of a tool."""

    def is_on(d: Desk) -> bool:
        return d.canvas.tool == name

    return Entry(
        f"tool-{name}", text, lambda d: d.canvas.set_tool(name), keys, name, on=is_on, group="tool"
    )


def option(name: str, text: str, keys: str, icon: str = "") -> Entry:
    """Return the entry of something that is shown or not."""

    def is_on(d: Desk) -> bool:
        return bool(getattr(d.view, name))

    return Entry(
        name, text, lambda d: d.view.update(**{name: not is_on(d)}), (keys,), icon, on=is_on
    )


def layout_choice(layout: str, text: str, keys: str, icon: str) -> Entry:
    """Return the entry of an arrangement of the canvas."""

    def is_on(d: Desk) -> bool:
        return d.view.layout == layout

    return Entry(
        icon, text, lambda d: d.view.update(layout=layout), (keys,), icon, on=is_on, group="layout"
    )


def suggestions_choice(when: ShowSuggestions, text: str) -> Entry:
    """Return the entry of when suggested marks are shown."""

    def is_on(d: Desk) -> bool:
        return d.view.suggestions == when

    return Entry(
        f"suggestions-{when}",
        text,
        lambda d: d.view.update(suggestions=when),
        on=is_on,
        group="suggestions",
    )


def loop_choice(loop: Loop, text: str) -> Entry:
    """Return the entry of what happens at the end."""

    def is_on(d: Desk) -> bool:
        return d.playhead.loop is loop

    return Entry(
        f"loop-{loop.value}",
        text,
        lambda d: d.playhead.set_loop(loop),
        icon=loop.value,
        on=is_on,
        group="loop",
    )


def theme_choice(theme: str, text: str) -> Entry:
    """Return the entry of a theme."""

    def is_on(d: Desk) -> bool:
        return d.window.theme == theme

    return Entry(
        f"theme-{theme}", text, lambda d: d.window.set_theme(theme), on=is_on, group="theme"
    )


def easing_choice(preset: str) -> Entry:
    """Return the entry of an easing."""

    def is_on(d: Desk) -> bool:
        layer = d.selection.layer
        if layer is None or not layer.spans:
            return False
        return layer.keyframes[layer.span_at(d.playhead.frame)[0]].easing == PRESETS[preset]

    return Entry(
        f"easing-{preset}",
        preset.capitalize(),
        lambda d: d.commands.set_easing(preset),
        when=has_span,
        on=is_on,
        group="easing",
    )


def layer_state(name: str, text: str) -> Entry:
    """Return the entry of what a layer is or is not."""

    def is_on(d: Desk) -> bool:
        return bool(getattr(d.selection.layer, name, False))

    return Entry(
        f"layer-{name}", text, lambda d: d.commands.toggle_layer(name), when=has_layer, on=is_on
    )
