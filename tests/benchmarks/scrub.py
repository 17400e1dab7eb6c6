"""From slider to painted frame: ``python -m tests.benchmarks.scrub``.

Opens the real window offscreen on a shape of about 10,000 triangles, moves the playhead between
frames, and waits each time until everything is painted.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

import core
from core.model import Keyframe, Outline, Recipe, edits
from tests.core.shapes import limb

if TYPE_CHECKING:
    from PySide6.QtWidgets import QApplication

    from app.document.playhead import Playhead

FRAMES = 120
SIZE = 1360, 860


def document(density: int) -> core.Document:
    """Return a limb that bends, meshed to a density."""
    bar, bent = (np.array(limb(bend, 32)) * 70 + [270, 200] for bend in (-0.4, 2.2))
    made = edits.add_layer(core.Document(), "limb", 1, Outline.polygon(bar))
    made = edits.insert_keyframe(made, 1, Keyframe(1 + FRAMES, Outline.polygon(bent)))
    return edits.update_layer(made, 1, recipe=Recipe(density=density))


def main() -> None:
    """Print medians and 95 % of move to paint, with and without the mesh shown."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--density", type=int, default=1000)
    density = parser.parse_args().density
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

    from PySide6.QtCore import QSettings, QTemporaryDir
    from PySide6.QtWidgets import QApplication

    from app.main_window import MainWindow
    from app.settings import Settings
    from core.morph.scene import span_of

    folder = QTemporaryDir()
    qt = QApplication([])
    settings = Settings(QSettings(folder.filePath("scrub.ini"), QSettings.Format.IniFormat))
    window = MainWindow(settings)
    window.resize(*SIZE)
    window.show()
    space = window.workspace
    space.session.replace(document(density))
    span = span_of(space.session.document.layers[0], 0)
    while (morph := space.solver.morph_of(span)) is None:
        qt.processEvents()
    print(f"{morph.report.triangles} triangles, window {SIZE[0]} x {SIZE[1]}, milliseconds")
    for layout in ("side by side", "overlay"):
        for mesh in (False, True):
            space.view.update(layout=layout, mesh=mesh)
            settle(qt)
            times = [1e3 * scrub(qt, space.playhead, frame) for frame in range(2, FRAMES)]
            middle, high = np.percentile(times, [50, 95])
            shown = "with mesh" if mesh else "no mesh"
            print(f"  {layout:<13} {shown:<10} median {middle:6.1f}   95 % {high:6.1f}")
    compute = [1e3 * timed(lambda t=t: morph.at(t)) for t in np.linspace(0.1, 0.9, 50)]
    print(f"  of that, the in-between itself    {np.median(compute):6.1f}")
    window.close()


def settle(qt: QApplication, seconds: float = 0.4) -> None:
    """Let layouts and timers come to rest."""
    end = perf_counter() + seconds
    while perf_counter() < end:
        qt.processEvents()


def scrub(qt: QApplication, playhead: Playhead, frame: int) -> float:
    """Return seconds from a move of the playhead until all is painted."""
    start = perf_counter()
    playhead.move_to(float(frame))
    qt.processEvents()
    return perf_counter() - start


def timed(work: Callable[[], object]) -> float:
    """Return the seconds of a call."""
    start = perf_counter()
    work()
    return perf_counter() - start


if __name__ == "__main__":
    main()
