"""The README's pictures, made by the program: ``python -m tests.benchmarks.pictures``."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np

import resources
from core.io import project
from core.morph.scene import picture_at, span_of

if TYPE_CHECKING:
    from PySide6.QtGui import QImage

COLUMNS, ROWS, CELL = 4, 2, (300, 169)
WINDOW = 1360, 860


def strip(sample: Path) -> QImage:
    """Return frames of a sample, side by side."""
    from PySide6.QtGui import QImage, QPainter

    from app.jobs.solve_all import solve_all
    from app.render.painter import render_image

    document = project.load(sample)
    solved = solve_all(document)
    first, last = document.frames
    image = QImage(COLUMNS * CELL[0], ROWS * CELL[1], QImage.Format.Format_RGB32)
    painter = QPainter(image)
    frames = np.linspace(first, first + (last - first) / 2, COLUMNS * ROWS)
    for i, frame in enumerate(frames):
        picture = picture_at(document, float(frame), solved.get)
        row, column = divmod(i, COLUMNS)
        painter.drawImage(column * CELL[0], row * CELL[1], render_image(picture, CELL))
    painter.end()
    return image


def window(sample: Path, folder: str) -> QImage:
    """Return the editor, open on a sample with everything solved and looked at."""
    from PySide6.QtCore import QSettings
    from PySide6.QtWidgets import QApplication

    from app.main_window import MainWindow
    from app.settings import Settings
    from app.style import apply_theme

    settings = Settings(QSettings(f"{folder}/settings.ini", QSettings.Format.IniFormat))
    apply_theme("dark")
    main = MainWindow(settings)
    main.resize(*WINDOW)
    main.show()
    space = main.workspace
    space.session.replace(project.load(sample), sample)
    space.playhead.move_to(3.0)
    layers = space.session.document.layers
    spans = [span_of(layer, index) for layer in layers for index in range(layer.spans)]
    while any(space.solver.morph_of(span) is None for span in spans):
        QApplication.processEvents()
    space.selection.select_layer(layers[-1].id)
    for _ in range(50):
        QApplication.processEvents()
    while space.inspector.busy:
        QApplication.processEvents()
    image = main.grab().toImage()
    main.close()
    return image


def main() -> None:
    """Write both pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=Path("resources/pictures"))
    folder = parser.parse_args().output
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from tests.benchmarks.sheet import save

    with TemporaryDirectory() as private:
        os.environ["XDG_CONFIG_HOME"] = os.environ["XDG_DATA_HOME"] = private
        from app.application import make_application

        app = make_application()
        sample = resources.sample(resources.FIRST_SAMPLE)
        save(strip(sample), folder / "strip.png")
        save(window(sample, private), folder / "window.png")
        app.quit()


if __name__ == "__main__":
    main()
