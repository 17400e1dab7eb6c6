"""The JavaScript library flubber as a peer: it blends outlines in ways of its own.

It needs node and npm. The package is fetched once, into a folder that git ignores.
"""

from __future__ import annotations

import atexit
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np

from core.geometry.polyline import arc_lengths, signed_area

VERSION = "0.4.2"
FOLDER = Path(__file__).parents[2] / "out" / "node"
SCRIPT = Path(__file__).with_suffix(".mjs")
PIXELS = 200.0
"""√area for flubber, some of whose tolerances are absolute."""
PATIENCE = 60
"""Seconds to wait for the package."""


class AbsentError(Exception):
    """Flubber cannot be had, and why."""


def installed(folder: Path = FOLDER) -> Path:
    """Return the folder that holds the package, fetched if need be; raises ``AbsentError``."""
    if shutil.which("node") is None:
        raise AbsentError("node is not here")
    if (folder / "node_modules" / "flubber").is_dir():
        return folder
    npm = shutil.which("npm")
    if npm is None:
        raise AbsentError("npm is not here")
    folder.mkdir(parents=True, exist_ok=True)
    command = [npm, "install", "--no-audit", "--no-fund", "--fetch-retries=0"]
    try:
        subprocess.run(
            [*command, "--prefix", str(folder), f"flubber@{VERSION}"],
            check=True,
            capture_output=True,
            timeout=PATIENCE,
        )
    except (subprocess.SubprocessError, OSError) as problem:
        raise AbsentError(f"npm could not fetch flubber {VERSION}: {problem}") from problem
    return folder


class Flubber:
    """A running node that answers pair by pair."""

    def __init__(self, folder: Path) -> None:
        """Start with the folder that holds the package."""
        self._node = subprocess.Popen(
            ["node", str(SCRIPT), str(folder)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )
        atexit.register(self.close)

    def close(self) -> None:
        """Let it end."""
        self._node.communicate()

    def frames(
        self, source: np.ndarray, target: np.ndarray, times: np.ndarray, density: int
    ) -> list[np.ndarray]:
        """Return rings (k, 2) at times, from polygons (n, 2) and (m, 2).

        Their edges are split to the source's perimeter over ``density``, as ours are.
        """
        scale = PIXELS / np.sqrt(abs(signed_area(source)))
        request = {
            "source": (scale * source).tolist(),
            "target": (scale * target).tolist(),
            "times": times.tolist(),
            "maxSegmentLength": scale * arc_lengths(source)[-1] / density,
        }
        assert self._node.stdin is not None
        assert self._node.stdout is not None
        print(json.dumps(request), file=self._node.stdin, flush=True)
        return [np.array(ring) / scale for ring in json.loads(self._node.stdout.readline())]
