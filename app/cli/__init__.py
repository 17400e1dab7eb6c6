"""The command line. Only argparse is imported until a command runs."""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Sequence
from typing import NoReturn

from app.cli import check, editor, new, render
from app.cli.terminal import OK, STOPPED, USAGE, WRONG, complain
from core.errors import MorphError

COMMANDS = {"new": new, "render": render, "check": check}

DESCRIPTION = """\
Betwixt draws the in-betweens: two outlines in, every frame between them out,
moving as rigidly as possible.

  betwixt              open the editor
  betwixt FILE         open it with a project, an SVG drawing or a point list
"""
EPILOG = """\
A complete run, without a display:

  betwixt new standing.svg jumping.svg -o jump.betwixt
  betwixt check jump.betwixt
  betwixt render jump.betwixt --size 1920x1080 -o frames

"betwixt COMMAND --help" explains each of them.

Exit codes: 0 done · 1 a file or shape is at fault · 2 wrong usage, or no display
for the editor · 3 check found frames that are not sound · 130 interrupted.
"""


def run(arguments: Sequence[str]) -> int:
    """Run a command line, without the program's name; return the exit code."""
    try:
        if not arguments or not (arguments[0] in COMMANDS or arguments[0].startswith("-")):
            return editor.run(arguments)
        options = _parser().parse_args(arguments)
        code = int(options.run(options))
        sys.stdout.flush()
        return code
    except MorphError as error:
        complain(str(error))
        return WRONG
    except KeyboardInterrupt:
        complain("Interrupted; nothing was written.")
        return STOPPED
    except BrokenPipeError:  # the reader of our output has left; Python shall not mind at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OK


class _Parser(argparse.ArgumentParser):
    def __init__(self, **options: object) -> None:
        options.setdefault("formatter_class", argparse.RawDescriptionHelpFormatter)
        super().__init__(**options)  # type: ignore[arg-type]
        self._negative_number_matcher = re.compile(r"-\d")  # of frames, too, as in -3-2

    def error(self, message: str) -> NoReturn:
        """Say what is wrong, and where to read on."""
        complain(f"{message}\nTry: {self.prog} --help")
        sys.exit(USAGE)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="betwixt",
        usage="betwixt [FILE]\n       betwixt {new,render,check} …",
        description=DESCRIPTION,
        epilog=EPILOG,
    )
    parser.add_argument("--version", action=_Version, help="print the version and leave")
    commands = parser.add_subparsers(
        title="commands", metavar="COMMAND", required=True, prog="betwixt"
    )
    for name, module in COMMANDS.items():
        command = commands.add_parser(
            name, help=module.SUMMARY, description=module.DESCRIPTION, epilog=module.EXAMPLES
        )
        module.add_arguments(command)
        command.set_defaults(run=module.run, parser=command)
    return parser


class _Version(argparse.Action):
    """Looks the version up only when it is asked for."""

    def __init__(self, option_strings: Sequence[str], dest: str, help: str) -> None:
        super().__init__(option_strings, dest, nargs=0, help=help)

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        from importlib.metadata import version

        print(f"betwixt {version('betwixt')}")
        parser.exit()
