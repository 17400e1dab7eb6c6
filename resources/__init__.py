"""What comes with the program: icons, and sample documents drawn for it."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

FIRST_SAMPLE = "running-fox"
"""It is open, and already moving, when the editor starts for the first time."""


def samples() -> list[Path]:
    """Return the sample documents, in the order they are offered."""
    found = (Path(str(files(__name__))) / "samples").glob("*.betwixt")
    return sorted(found, key=lambda path: (path.stem != FIRST_SAMPLE, path.stem))


def sample(name: str) -> Path:
    """Return a sample by its name, without the extension; KeyError when there is none."""
    return {path.stem: path for path in samples()}[name]
