"""Every action once: its text, keys, icon, what it does, and when it can be done.

Menus, toolbars, shortcuts and the overview of shortcuts are built from this table. The texts are
shown through ``translate("Actions", …)``.
"""

from __future__ import annotations

from app.document.playhead import Loop
from app.entries import (
    Desk,
    Entry,
    easing_choice,
    has_layer,
    has_mark,
    has_marks,
    has_span,
    has_suggestions,
    has_undo,
    key_title,
    layer_state,
    layout_choice,
    loop_choice,
    on_free_frame,
    option,
    suggestions_choice,
    theme_choice,
    tool,
    translated,
)
from core.model.easing import PRESETS


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
    return translated("&Accept all suggested marks" if has_suggestions(d) else "&Suggest marks")


def _undo_title(d: Desk) -> str:
    return translated("&Undo {step}").format(step=d.session.undo_stack.undoText())


def _redo_title(d: Desk) -> str:
    return translated("&Redo {step}").format(step=d.session.undo_stack.redoText())


def _delete_title(d: Desk) -> str:
    if d.selection.nodes:
        return translated("&Delete nodes")
    if d.selection.mark is not None:
        return translated("&Delete mark")
    return key_title("&Delete keyframe {frame}")(d)


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
    Entry("export", "&Export…", lambda d: d.files.export(), ("Ctrl+E",), "export", has_layer),
    Entry("quit", "&Quit", lambda d: d.window.close(), ("Ctrl+Q",)),

    Entry("undo", "&Undo", lambda d: d.session.undo(), ("Ctrl+Z",), "undo", has_undo,
          title=_undo_title),
    Entry("redo", "&Redo", lambda d: d.session.redo(), ("Ctrl+Shift+Z", "Ctrl+Y"), "redo",
          lambda d: d.session.undo_stack.canRedo(), title=_redo_title),
    Entry("cut", "Cut &keyframe", lambda d: d.clipboard.cut(), ("Ctrl+X",), when=has_span,
          title=key_title("Cut &keyframe {frame}")),
    Entry("copy", "&Copy keyframe", lambda d: d.clipboard.copy(), ("Ctrl+C",), when=has_layer,
          title=key_title("&Copy keyframe {frame}")),
    Entry("paste", "&Paste here", lambda d: d.clipboard.paste(), ("Ctrl+V",)),
    Entry("delete", "&Delete", lambda d: d.commands.delete(), ("Del",), "delete", has_layer,
          title=_delete_title),
    Entry("select-all", "Select &all nodes", lambda d: d.commands.select_all_nodes(),
          ("Ctrl+A",), when=has_layer),

    tool("select", "&Select and transform", "V", "F1"),
    tool("nodes", "Edit &nodes", "N", "F2"),
    tool("pen", "&Pen: draw point by point", "P", "F3"),
    tool("freehand", "&Freehand: draw in one stroke", "B", "F4"),
    tool("marks", "Place &marks", "M", "F5"),

    Entry("fit", "&Fit to window", lambda d: d.canvas.framing.fit(), ("Ctrl+0",), "fit"),
    Entry("zoom-drawing", "Zoom to the &drawing", lambda d: d.canvas.framing.show_drawing(), ("F",),
          when=has_layer),
    Entry("zoom-100", "Zoom to &100 %", lambda d: d.canvas.framing.show_pixels(), ("Ctrl+1",)),
    Entry("flip", "Fli&p view", lambda d: d.canvas.camera.flip(), ("Shift+H",), "flip"),
    layout_choice("side by side", "&Side by side", "Ctrl+2", "side-by-side"),
    layout_choice("overlay", "O&verlay", "Ctrl+3", "overlay"),
    option("onion", "Show &onion skin", "O", "onion"),
    option("mesh", "Show mes&h", "Shift+M", "mesh"),
    option("marks", "Show mar&ks", "Ctrl+M"),
    suggestions_choice("with the tool", "&While marks are placed"),
    suggestions_choice("always", "&Always"),
    suggestions_choice("never", "&Never"),
    theme_choice("dark", "&Dark"),
    theme_choice("light", "&Light"),
    theme_choice("system", "&System"),
    Entry("reset-layout", "&Reset layout", lambda d: d.window.reset_layout()),
    Entry("full-screen", "F&ull screen", lambda d: d.window.toggle_full_screen(), ("F11",),
          on=lambda d: d.window.isFullScreen()),

    Entry("add-layer", "&New layer", lambda d: d.window.layers.add(), ("Ctrl+Shift+N",), "add"),
    Entry("duplicate-layer", "&Duplicate layer", lambda d: d.window.layers.duplicate(),
          ("Ctrl+D",), "duplicate", has_layer),
    Entry("remove-layer", "D&elete layer", lambda d: d.window.layers.remove(), (), "delete",
          has_layer),
    Entry("raise-layer", "&Raise", lambda d: d.window.layers.raise_layer(), ("Ctrl+]",), "up",
          has_layer),
    Entry("lower-layer", "&Lower", lambda d: d.window.layers.lower_layer(), ("Ctrl+[",), "down",
          has_layer),
    Entry("layer-above", "Select layer &above", lambda d: d.commands.select_layer(1), ("PgUp",),
          when=has_layer),
    Entry("layer-below", "Select layer &below", lambda d: d.commands.select_layer(-1), ("PgDown",),
          when=has_layer),
    layer_state("visible", "&Visible"),
    layer_state("locked", "Loc&ked"),

    Entry("insert-key", "&Insert keyframe here", lambda d: d.commands.insert_keyframe(),
          ("F6", "K"), "keyframe", on_free_frame),
    Entry("draw-key", "D&raw keyframe here", _draw_key, ("F7",), "blank-keyframe", has_layer),
    Entry("remove-key", "&Delete keyframe", lambda d: d.commands.remove_keyframe(),
          ("Shift+Del",), "delete", has_span, title=key_title("&Delete keyframe {frame}")),
    *(easing_choice(preset) for preset in PRESETS),

    Entry("suggest-marks", "&Suggest marks", _suggest, ("Ctrl+Shift+M",), when=has_span,
          title=_suggest_title),
    Entry("hide-suggestions", "&Hide suggested marks", lambda d: d.commands.hide_suggestions(),
          when=has_suggestions),
    Entry("remove-mark", "&Delete mark", lambda d: d.commands.remove_mark(), (), "delete",
          has_mark),
    Entry("remove-marks", "Delete &all marks", lambda d: d.commands.remove_all_marks(),
          when=has_marks),

    Entry("play", "&Play", lambda d: d.playhead.toggle(), ("Space", "Return", "Enter"), "play",
          has_layer, title=_play_title),
    Entry("play-from-start", "Play from the &start", lambda d: d.playhead.play(from_start=True),
          ("Shift+Space",), when=has_layer),
    Entry("stop", "S&top", lambda d: d.window.escape(), ("Esc",), "stop"),
    loop_choice(Loop.LOOP, "&Loop"),
    loop_choice(Loop.PING_PONG, "&Ping-pong"),
    loop_choice(Loop.ONCE, "&Once"),
    Entry("next-frame", "&Next frame", lambda d: d.playhead.step(1), ("Right", "."), "next-frame"),
    Entry("previous-frame", "Pre&vious frame", lambda d: d.playhead.step(-1), ("Left", ","),
          "previous-frame"),
    Entry("next-key", "Next &keyframe", lambda d: d.commands.step_key(1), ("Ctrl+Right", "Alt+."),
          "next-key"),
    Entry("previous-key", "Previous ke&yframe", lambda d: d.commands.step_key(-1),
          ("Ctrl+Left", "Alt+,"), "previous-key"),
    Entry("first", "&First frame", lambda d: d.playhead.to_start(), ("Home",), "first"),
    Entry("last", "L&ast frame", lambda d: d.playhead.to_end(), ("End",), "last"),
    Entry("cancel", "&Cancel solving", lambda d: d.solver.cancel(), when=lambda d: d.solver.busy),
    Entry("solve", "Solve a&gain", lambda d: d.solver.resume(), ("F9",), when=has_span),

    Entry("welcome", "&Welcome", lambda d: d.window.beginning.toggle_welcome(),
          on=lambda d: d.window.beginning.welcoming),
    Entry("shortcuts", "&Keyboard shortcuts", lambda d: d.window.show_shortcuts(),
          ("Ctrl+/", "?")),
    Entry("about", "&About Betwixt", lambda d: d.window.show_about()),
)
# fmt: on
