"""How long the method takes: ``python -m tests.benchmarks.speed``.

Correspondence by stage and a frame by part, at the paper's size and two larger ones, beside the
bare back-substitution measured in the same run. Times are medians in milliseconds; machines are
noisy, so the ratios are what to compare.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from itertools import cycle
from statistics import median
from time import perf_counter

import numpy as np

import core
from core.geometry.rotation import phasor
from core.morph.motion.rigid import Rigid
from tests.core.shapes import limb

PAPER_CORRESPONDENCE, PAPER_FRAME = 256.0, 42.0
"""Milliseconds that Song 2013 reports, on a laptop of 2011, for about 530 vertices."""
DENSITIES = {"paper size": 118, "13k triangles": 1450, "60k triangles": 5600}


def milliseconds(work: Callable[[], object], repeats: int) -> float:
    """Return the median time of a call, after one to warm up."""
    work()
    times = []
    for _ in range(repeats):
        start = perf_counter()
        work()
        times.append(perf_counter() - start)
    return 1e3 * median(times)


def measure(density: int, repeats: int) -> tuple[core.Morph, dict[str, float], dict[str, float]]:
    """Solve a bending limb; return the morph, ms by stage, and ms of a frame by part."""
    source, target = limb(-0.4, 32), limb(2.2, 32)
    marks = [(0, 0), (31, 31), (32, 32), (63, 63)]
    recipe = core.Recipe(density=density)
    morphs: list[core.Morph] = []
    total = milliseconds(
        lambda: morphs.append(core.solve(source, target, marks, recipe=recipe)), repeats
    )
    stages = {stage.name: 1e3 * stage.seconds for stage in morphs[-1].report.stages}
    stages["total"] = total
    return morphs[-1], stages, frame_parts(morphs[-1], 20 * repeats)


def frame_parts(morph: core.Morph, repeats: int) -> dict[str, float]:
    """Return ms of a frame: its ideal gradients, its load, the bare back-substitution, and all."""
    frame = morph.inbetween.shape
    assert isinstance(frame, Rigid)
    ideal = frame.ideal(0.37)
    load = frame.fit.load(ideal)
    moments = cycle(np.linspace(0.1, 0.9, 101))  # what a frame costs depends on its moment
    return {
        "ideal gradients": milliseconds(lambda: frame.ideal(0.37), repeats),
        "  of that, turning": milliseconds(lambda: phasor(0.37 * frame.ideal.theta), repeats),
        "load": milliseconds(lambda: frame.fit.load(ideal), repeats),
        "back-substitution": milliseconds(lambda: frame.fit.solve(load), repeats),
        "frame": milliseconds(lambda: morph.at(next(moments)), repeats),
    }


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=7)
    repeats = parser.parse_args().repeats
    for name, density in DENSITIES.items():
        morph, stages, parts = measure(density, repeats if density < 1000 else 3)
        vertices, triangles = morph.report.vertices, morph.report.triangles
        boundary = sum(len(ring) for ring in morph.rings)
        print(f"\n{name}: {vertices} vertices ({boundary} on the boundary), {triangles} triangles,")
        print(f"  {len(morph.report.iterations)} Newton steps, ", end="")
        print(f"{len(morph.report.folds_target)} folds")
        for part, value in (stages | parts).items():
            print(f"  {part:<22}{value:10.3f} ms")
        print(f"  {'frame / bare solve':<22}{parts['frame'] / parts['back-substitution']:10.2f}")
        if name == "paper size":
            print(f"  Song 2013: correspondence {PAPER_CORRESPONDENCE:.0f} ms", end="")
            print(f" ({PAPER_CORRESPONDENCE / stages['total']:.1f} x ours)", end="")
            print(f", a frame {PAPER_FRAME:.0f} ms ({PAPER_FRAME / parts['frame']:.0f} x ours)")
        assert np.isfinite(morph.at(0.37)).all()


if __name__ == "__main__":
    main()
