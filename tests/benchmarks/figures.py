"""The paper's figures, computed anew: ``python -m tests.benchmarks.figures -o out/figures``.

Song 2013 shows why correspondence decides over in-betweens. Each function here returns the panels
of one such figure; tests/benchmarks/test_figures.py checks what each is to show.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

import core
from core.fem.elements import Elements
from core.geometry.polyline import signed_area
from core.geometry.rotation import turn_and_mirror
from core.morph.motion.motion import Motion
from core.morph.quality import folds
from tests.benchmarks.sheet import Panel, application, draw_row, save, stack
from tests.core.shapes import limb, rotation

TRIANGLE = np.array([[0.0, 0.0], [3.0, 0.0], [1.0, 1.4]])


def _panel(title: str, points: np.ndarray, morph: core.Morph, *, mesh: bool = False) -> Panel:
    triangles = morph.triangles if mesh else None
    return Panel(title, points, morph.rings, triangles, folds(points, morph.triangles))


def wrench() -> np.ndarray:
    """Return a shape whose turning is easy to see: a bar with an open jaw."""
    return np.array(
        [
            [0, 0], [5, 0], [5.4, -0.6], [6.6, -0.9], [7.6, -0.5], [6.6, 0.1], [6.6, 0.9],
            [7.6, 1.5], [6.6, 1.9], [5.4, 1.6], [5, 1], [0, 1], [-0.4, 0.5],
        ]
    )  # fmt: skip


def figure_1_and_3() -> list[list[Panel]]:
    """Large rotation: straight vertex paths collapse, rigid ones only turn."""
    source = wrench()
    target = source @ rotation(np.radians(165)).T
    marks = [(0, 0), (5, 5), (7, 7)]
    rows = []
    for method in ("linear", "arap"):
        morph = core.solve(source, target, marks, recipe=core.Recipe(method=method))
        rows.append(
            [_panel(f"{method}, t = {t:.2f}", morph.at(t), morph) for t in np.linspace(0, 1, 6)]
        )
    return rows


def figure_2() -> list[list[Panel]]:
    """Two mirrored triangles: between them every straight path passes through a line."""
    mirrored = TRIANGLE * [-1, 1]
    ring = [np.arange(3)]
    triangle = np.array([[0, 1, 2]])
    row = []
    for t in (0.0, 0.25, 0.5, 0.75, 1.0):
        points = (1 - t) * TRIANGLE + t * mirrored
        turned = folds(points, triangle)
        state = "inside out" if len(turned) else "as drawn"
        row.append(Panel(f"t = {t:.2f}: {state}", points, ring, triangle, turned))
    return [row]


def figure_2_refusal() -> str:
    """Return what the program says to marks that would mirror the shape."""
    try:
        core.solve(TRIANGLE, TRIANGLE * [-1, 1], [(0, 0), (1, 1), (2, 2)])
    except core.MarkError as error:
        return str(error)
    raise AssertionError("mirrored marks were accepted")


def figure_3_angles() -> list[list[Panel]]:
    """A limb that curls through more than a full turn: principal angles against unwrapped ones."""
    source, target = (limb(bend, 40, 12, 0.5, curl=2) for bend in (0.0, 8.5))
    morph = core.solve(source, target, [(0, 0), (39, 39), (40, 40), (79, 79)])
    shape = Motion.of("arap", (morph.rest, morph.target), morph.triangles).shape
    elements = Elements.of(morph.rest, morph.triangles)
    turn, _ = turn_and_mirror(elements.deformation_gradients(morph.target))
    shape.ideal.theta = np.angle(turn)
    return [
        [_panel(f"{name}, t = {t:.1f}", frame(t), morph) for t in (0.2, 0.4, 0.6, 0.8, 1.0)]
        for name, frame in (
            ("principal angles", lambda t: shape.fit(shape.ideal(t))),
            ("unwrapped", morph.at),
        )
    ]


def figure_7() -> list[list[Panel]]:
    """One frame, t = 0.8, with the mesh: straight paths against rigid ones."""
    source, target = limb(0.0, 24), limb(2.9, 24) @ rotation(1.2).T
    marks = [(0, 0), (23, 23), (24, 24), (47, 47)]
    row = []
    for method in ("linear", "arap"):
        morph = core.solve(source, target, marks, recipe=core.Recipe(method=method))
        area = signed_area(morph.at(0.8)[morph.rings[0]]) / signed_area(source)
        row.append(_panel(f"{method}: area {area:.2f}", morph.at(0.8), morph, mesh=True))
    ends = [
        _panel("source", morph.rest, morph, mesh=True),
        _panel("target", morph.target, morph, mesh=True),
    ]
    return [[ends[0], *row, ends[1]]]


def figure_8() -> list[list[Panel]]:
    """Interpolation of simple shapes at t = 0.2, 0.4 … 1.0, at the paper's mesh size."""
    pairs = [
        (limb(-0.6, 30, 6, 1.2), limb(3.4, 30, 6, 1.2), [(0, 0), (29, 29), (30, 30), (59, 59)]),
        (wrench(), wrench() @ rotation(2.2).T * [1.2, 0.8], [(0, 0), (5, 5), (7, 7), (11, 11)]),
    ]
    rows = []
    for source, target, marks in pairs:
        morph = core.solve(source, target, marks)
        rows.append([_panel(f"t = {t:.1f}", morph.at(t), morph) for t in np.arange(0, 1.01, 0.2)])
    return rows


FIGURES: dict[str, Callable[[], list[list[Panel]]]] = {
    "figure-1-and-3-large-rotation": figure_1_and_3,
    "figure-2-mirrored-triangles": figure_2,
    "figure-3-angles-beyond-a-turn": figure_3_angles,
    "figure-7-one-frame": figure_7,
    "figure-8-sequence": figure_8,
}


def main() -> None:
    """Write every figure as a PNG."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, default=Path("out/figures"))
    folder = parser.parse_args().output
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    app = application()
    for name, figure in FIGURES.items():
        path = folder / f"{name}.png"
        save(stack([draw_row(row) for row in figure()]), path)
        print(path)
    print(f"Mirrored marks are refused: {figure_2_refusal()}")
    del app


if __name__ == "__main__":
    main()
