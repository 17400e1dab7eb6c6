"""The ``betwixt`` command: the editor and the command line."""

from __future__ import annotations

import os
import sys


def main() -> int:
    """Run the command that was typed."""
    # before numpy loads: threads within small matrices only wait for each other
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from app.cli import run

    return run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
