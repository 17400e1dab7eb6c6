"""Every action once: its text, keys, icon, what it does, and when it can be done.

Menus, toolbars, shortcuts and the overview of shortcuts are built from this table. The texts are
shown through ``translate("Actions", …)``.
"""

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


def _layer(d: Desk) -> bool:
    return d.selection.layer is not None


def _span(d: Desk) -> bool:
    return d.selection.layer is not None and d.selection.layer.spans > 0


def _free_frame(d: Desk) -> bool:
    layer = d.selection.layer
    return layer is not None and layer.key_at(round(d.playhead.frame)) is None


def _marked(d: Desk) -> bool:
    return d.selection.layer is not None and bool(d.selection.layer.labels)


def _mark(d: Desk) -> bool:
    return d.selection.mark is not None


def _suggested(d: Desk) -> bool:
    return bool(d.suggestions.shown)


def _deletable(d: Desk) -> bool:
    return bool(d.selection.nodes) or _mark(d) or _span(d)


def _undoable(d: Desk) -> bool:
    return d.session.undo_stack.canUndo() or d.session.dragging


# -- rows of a kind --------------------------------------------------------------------------------


def _tool(name: str, text: str, *keys: str) -> Entry:
    def is_on(d: Desk) -> bool:
        return d.canvas.tool == name

    return Entry(
        f"tool-{name}", text, lambda d: d.canvas.set_tool(name), keys, name, on=is_on, group="tool"
    )


def _option(name: str, text: str, keys: str, icon: str = "") -> Entry:
    def is_on(d: Desk) -> bool:
        return bool(getattr(d.view, name))

    return Entry(
        name, text, lambda d: d.view.update(**{name: not is_on(d)}), (keys,), icon, on=is_on
    )


def _layout(layout: str, text: str, keys: str, icon: str) -> Entry:
    def is_on(d: Desk) -> bool:
        return d.view.layout == layout

    return Entry(
        icon, text, lambda d: d.view.update(layout=layout), (keys,), icon, on=is_on, group="layout"
    )


def _suggestions(when: ShowSuggestions, text: str) -> Entry:
    def is_on(d: Desk) -> bool:
        return d.view.suggestions == when

    return Entry(
        f"suggestions-{when}",
        text,
        lambda d: d.view.update(suggestions=when),
        on=is_on,
        group="suggestions",
    )


def _loop(loop: Loop, text: str) -> Entry:
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


def _theme(theme: str, text: str) -> Entry:
    def is_on(d: Desk) -> bool:
        return d.window.theme == theme

    return Entry(
        f"theme-{theme}", text, lambda d: d.window.set_theme(theme), on=is_on, group="theme"
    )


def _easing(preset: str) -> Entry:
    def is_on(d: Desk) -> bool:
        layer = d.selection.layer
        if layer is None or not layer.spans:
            return False
        return layer.keyframes[layer.span_at(d.playhead.frame)[0]].easing == PRESETS[preset]

    return Entry(
        f"easing-{preset}",
        preset.capitalize(),
        lambda d: d.commands.set_easing(preset),
        when=_span,
        on=is_on,
        group="easing",
    )


def _state(name: str, text: str) -> Entry:
    def is_on(d: Desk) -> bool:
        return bool(getattr(d.selection.layer, name, False))

    return Entry(
        f"layer-{name}", text, lambda d: d.commands.toggle_layer(name), when=_layer, on=is_on
    )


def _draw_key(d: Desk) -> None:
    """Take a drawing tool where what is drawn becomes the key under the playhead."""
    d.playhead.stop()
    d.view.update(layout="overlay")
    if d.canvas.tool not in ("pen", "freehand"):
        d.canvas.set_tool("pen")


def _suggest(d: Desk) -> None:
    """Accept what is suggested, if that can be seen; else show it."""
    if d.suggestions.shown:
        d.commands.accept_suggestions()
    else:
        d.canvas.set_tool("marks")
        d.commands.show_suggestions()


def _suggest_title(d: Desk) -> str:
    return translated("&Accept all suggested marks" if _suggested(d) else "&Suggest marks")


def _undo_title(d: Desk) -> str:
    return translated("&Undo {step}").format(step=d.session.undo_stack.undoText())


def _redo_title(d: Desk) -> str:
    return translated("&Redo {step}").format(step=d.session.undo_stack.redoText())


def _play_title(d: Desk) -> str:
    return translated("&Pause" if d.playhead.playing else "&Play")


# -- the table -------------------------------------------------------------------------------------

# fmt: off
ENTRIES: tuple[Entry, ...] = (
    Entry("new", "&New", lambda d: d.files.new(), ("Ctrl+N",), "new"),
    Entry("open", "&Open…", lambda d: d.files.open(), ("Ctrl+O",), "open"),
    Entry("save", "&Save", lambda d: d.files.save(), ("Ctrl+S",), "save"),
    Entry("save-as", "Save &as…", lambda d: d.files.save_as(), ("Ctrl+Shift+S",)),
    Entry("import", "&Import…", lambda d: d.files.import_shapes(), ("Ctrl+I",), "import"),
    Entry("export", "&Export…", lambda d: d.files.export(), ("Ctrl+E",), "export", _layer),
    Entry("quit", "&Quit", lambda d: d.window.close(), ("Ctrl+Q",)),

    Entry("undo", "&Undo", lambda d: d.session.undo(), ("Ctrl+Z",), "undo", _undoable,
          title=_undo_title),
    Entry("redo", "&Redo", lambda d: d.session.redo(), ("Ctrl+Shift+Z", "Ctrl+Y"), "redo",
          lambda d: d.session.undo_stack.canRedo(), title=_redo_title),
    Entry("cut", "Cut &keyframe", lambda d: d.clipboard.cut(), ("Ctrl+X",), when=_span),
    Entry("copy", "&Copy keyframe", lambda d: d.clipboard.copy(), ("Ctrl+C",), when=_layer),
    Entry("paste", "&Paste here", lambda d: d.clipboard.paste(), ("Ctrl+V",)),
    Entry("delete", "&Delete", lambda d: d.commands.delete(), ("Del",), "delete", _deletable),
    Entry("select-all", "Select &all nodes", lambda d: d.commands.select_all_nodes(),
          ("Ctrl+A",), when=_layer),

    _tool("select", "&Select and transform", "V", "F1"),
    _tool("nodes", "Edit &nodes", "N", "F2"),
    _tool("pen", "&Pen: draw point by point", "P", "F3"),
    _tool("freehand", "&Freehand: draw in one stroke", "B", "F4"),
    _tool("marks", "Place &marks", "M", "F5"),

    Entry("fit", "&Fit to window", lambda d: d.canvas.framing.fit(), ("Ctrl+0",), "fit"),
    Entry("zoom-drawing", "Zoom to the &drawing", lambda d: d.canvas.framing.show_drawing(), ("F",),
          when=_layer),
    Entry("zoom-100", "Zoom to &100 %", lambda d: d.canvas.framing.show_pixels(), ("Ctrl+1",)),
    Entry("flip", "Fli&p view", lambda d: d.canvas.camera.flip(), ("Shift+H",), "flip"),
    _layout("side by side", "&Side by side", "Ctrl+2", "side-by-side"),
    _layout("overlay", "O&verlay", "Ctrl+3", "overlay"),
    _option("onion", "Show &onion skin", "O", "onion"),
    _option("mesh", "Show mes&h", "Shift+M", "mesh"),
    _option("marks", "Show mar&ks", "Ctrl+M"),
    _suggestions("with the tool", "&While marks are placed"),
    _suggestions("always", "&Always"),
    _suggestions("never", "&Never"),
    _theme("dark", "&Dark"),
    _theme("light", "&Light"),
    _theme("system", "&System"),
    Entry("reset-layout", "&Reset layout", lambda d: d.window.reset_layout()),
    Entry("full-screen", "F&ull screen", lambda d: d.window.toggle_full_screen(), ("F11",),
          on=lambda d: d.window.isFullScreen()),

    Entry("add-layer", "&New layer", lambda d: d.window.layers.add(), ("Ctrl+Shift+N",), "add"),
    Entry("duplicate-layer", "&Duplicate layer", lambda d: d.window.layers.duplicate(),
          ("Ctrl+D",), "duplicate", _layer),
    Entry("remove-layer", "D&elete layer", lambda d: d.window.layers.remove(), (), "delete",
          _layer),
    Entry("raise-layer", "&Raise", lambda d: d.window.layers.raise_layer(), ("Ctrl+]",), "up",
          _layer),
    Entry("lower-layer", "&Lower", lambda d: d.window.layers.lower_layer(), ("Ctrl+[",), "down",
          _layer),
    Entry("layer-above", "Select layer &above", lambda d: d.commands.select_layer(1), ("PgUp",),
          when=_layer),
    Entry("layer-below", "Select layer &below", lambda d: d.commands.select_layer(-1), ("PgDown",),
          when=_layer),
    _state("visible", "&Visible"),
    _state("locked", "Loc&ked"),

    Entry("insert-key", "&Insert keyframe here", lambda d: d.commands.insert_keyframe(),
          ("F6", "K"), "keyframe", _free_frame),
    Entry("draw-key", "D&raw keyframe here", _draw_key, ("F7",), "blank-keyframe", _layer),
    Entry("remove-key", "&Delete keyframe", lambda d: d.commands.remove_keyframe(),
          ("Shift+Del",), "delete", _span),
    *(_easing(preset) for preset in PRESETS),

    Entry("suggest-marks", "&Suggest marks", _suggest, ("Ctrl+Shift+M",), when=_span,
          title=_suggest_title),
    Entry("hide-suggestions", "&Hide suggested marks", lambda d: d.commands.hide_suggestions(),
          when=_suggested),
    Entry("remove-mark", "&Delete mark", lambda d: d.commands.remove_mark(), (), "delete", _mark),
    Entry("remove-marks", "Delete &all marks", lambda d: d.commands.remove_all_marks(),
          when=_marked),

    Entry("play", "&Play", lambda d: d.playhead.toggle(), ("Space", "Return", "Enter"), "play",
          _layer, title=_play_title),
    Entry("play-from-start", "Play from the &start", lambda d: d.playhead.play(from_start=True),
          ("Shift+Space",), when=_layer),
    Entry("stop", "S&top", lambda d: d.window.escape(), ("Esc",), "stop"),
    _loop(Loop.LOOP, "&Loop"),
    _loop(Loop.PING_PONG, "&Ping-pong"),
    _loop(Loop.ONCE, "&Once"),
    Entry("next-frame", "&Next frame", lambda d: d.playhead.step(1), ("Right", "."), "next-frame"),
    Entry("previous-frame", "Pre&vious frame", lambda d: d.playhead.step(-1), ("Left", ","),
          "previous-frame"),
    Entry("next-key", "Next &keyframe", lambda d: d.playhead.step_key(1), ("Ctrl+Right", "Alt+."),
          "next-key"),
    Entry("previous-key", "Previous ke&yframe", lambda d: d.playhead.step_key(-1),
          ("Ctrl+Left", "Alt+,"), "previous-key"),
    Entry("first", "&First frame", lambda d: d.playhead.to_start(), ("Home",), "first"),
    Entry("last", "L&ast frame", lambda d: d.playhead.to_end(), ("End",), "last"),
    Entry("cancel", "&Cancel solving", lambda d: d.solver.cancel(), when=lambda d: d.solver.busy),
    Entry("solve", "Solve a&gain", lambda d: d.solver.resume(), ("F9",), when=_span),

    Entry("welcome", "&Welcome", lambda d: d.window.beginning.toggle_welcome(),
          on=lambda d: d.window.beginning.welcoming),
    Entry("shortcuts", "&Keyboard shortcuts", lambda d: d.window.show_shortcuts(),
          ("Ctrl+/", "?")),
    Entry("about", "&About Betwixt", lambda d: d.window.show_about()),
)
# fmt: on
