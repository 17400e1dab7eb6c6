"""``betwixt render``: a project's frames as files."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from app.cli import values
from app.cli.mirrors import note_mirrors
from app.cli.terminal import OFFSCREEN_PACKAGES, OK, progress_bar, require_qt

SUMMARY = "write a project's frames as files"
DESCRIPTION = """\
Write the frames of a project, exactly as the editor exports them.

The files are called after the project, NAME-0001.png and so on. They appear
together when the last one is done; after an error or Ctrl+C there is none.
"""
EXAMPLES = """\
examples:
  betwixt render jump.betwixt -o frames
  betwixt render jump.betwixt --frames 1-12 --size 1920x1080 --background none -o frames
  betwixt render jump.betwixt --format svg -o frames
  betwixt render jump.betwixt --format npz -o mesh      positions, triangles, rings, times
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a project (.betwixt)")
    parser.add_argument(
        "-o", dest="folder", type=Path, required=True, metavar="DIR", help="where the files go"
    )
    parser.add_argument(
        "--frames", type=values.frames, metavar="A-B", help="first and last frame (default: all)"
    )
    parser.add_argument(
        "--size",
        type=values.size,
        metavar="WxH",
        help="pixels to fit into (default: the artboard's)",
    )
    parser.add_argument(
        "--format",
        choices=("png", "apng", "svg", "npz"),
        default="png",
        help="kind of file; apng is one animated picture (default png)",
    )
    parser.add_argument(
        "--background",
        type=values.background,
        metavar="COLOUR",
        help="#rrggbb, #rrggbbaa, white, black, or none for transparent (default: the project's)",
    )


def run(options: Namespace) -> int:
    """Solve the project and write its frames."""
    from app.jobs.export import Export
    from app.jobs.solve_all import solve_all
    from app.render.formats import BY_KEY
    from core.io import project

    chosen = BY_KEY[options.format]
    if not chosen.paints and (options.size or options.background is not None):
        options.parser.error(f"--size and --background mean nothing to {chosen.key} files")
    if chosen.key in ("png", "apng"):
        require_qt("PySide6.QtGui", OFFSCREEN_PACKAGES, "--format svg works without them.")
    document = project.load(options.file)
    export = Export(
        document,
        options.frames or document.frames,
        chosen,
        options.folder,
        options.file.stem,
        options.size,
        options.background,
    )
    with progress_bar() as progress:
        solved = solve_all(document, export.frames, {}, progress)
    note_mirrors(document, solved)
    with progress_bar() as progress:
        paths = export.run(solved, progress)
    several = f" to {paths[-1].name}" if len(paths) > 1 else ""
    print(f"{options.folder}: {paths[0].name}{several}")
    return OK
