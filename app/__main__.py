"""The ``betwixt`` command: the editor and the command line."""

from __future__ import annotations

import sys


def main() -> int:
    """Run the command that was typed."""
    from app.cli import run

    return run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
