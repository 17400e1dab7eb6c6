"""How the editor keeps up with the artist: ``python -m tests.benchmarks.responsiveness``.

Three measurements, each by itself with ``--only``:

- ``frames``: how long the window takes from frame to frame, painting included, while it solves;
- ``cancel``: how long a solve runs on after it was cancelled, and between which stages it cannot
  be stopped for longest;
- ``memory``: what stays behind after many solves, documents and windows.
"""

from __future__ import annotations

import argparse
import gc
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from itertools import count
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

import core
from core.model import Keyframe, Layer, Outline, Recipe
from core.morph.scene import TimedSpan, solve_span, timed_span_of
from tests.benchmarks.pairs import Pair, load_outlines, within_classes
from tests.core.shapes import limb

if TYPE_CHECKING:
    from app.main_window import MainWindow

HEAVY = ("spring-08", "circle-00", "octopus-02", "lizard-02", "stingray-06")
"""Sources of pairs that take long to solve, or whose frames do."""
SPAN = 24
TICK_MS = 16
COARSE = 24
"""Density of the meshes that are solved by the hundred."""
SECONDS = 2.0
"""How long frames are counted where nothing is solved."""
CANCELS = 12
"""Moments at which a solve is cancelled, evenly spread over its time."""


def document(pair: Pair, density: int = 128) -> core.Document:
    """Return a layer that goes from source to target and back."""
    outlines = pair.source, pair.target, pair.source
    keys = tuple(Keyframe(1 + k * SPAN, outline) for k, outline in enumerate(outlines))
    return core.Document((Layer(1, pair.name, keys, recipe=Recipe(density=density)),))


def bending(offset: float = 0.0) -> Pair:
    """Return a limb that bends, somewhere."""
    ends = (Outline.polygon(70 * np.array(limb(bend, 16)) + 300 + offset) for bend in (-0.4, 2.2))
    return Pair("limb", *ends)


def timed_span(pair: Pair, density: int = 128) -> TimedSpan:
    """Return the span from source to target."""
    return timed_span_of(document(pair, density).layers[0], 0)


# -- frames ------------------------------------------------------------------------------------


def report_frames(pairs: list[Pair]) -> None:
    """Print intervals between frames while nothing is done, and while each pair is solved."""
    print(f"\nmilliseconds from frame to frame, a {TICK_MS} ms timer and a moving playhead")
    print(f"{'':<28}{'frames':>8}{'p50':>8}{'p95':>8}{'p99':>8}{'max':>8}")
    with open_window() as window:
        space = window.workspace
        space.session.replace(document(bending()))
        wait(lambda: at_rest(window))
        print_row("nothing to solve", intervals(window, ends_after(SECONDS)))
        for pair in pairs:
            space.session.replace(document(pair))
            print_row(pair.name, intervals(window, lambda: at_rest(window)))
            print_row("  then scrubbed", intervals(window, ends_after(SECONDS)))


def intervals(window: MainWindow, done: Callable[[], bool]) -> np.ndarray:
    """Return milliseconds between ticks, each of which moves the playhead and paints."""
    from PySide6.QtCore import QEventLoop, Qt, QTimer

    loop, ticks = QEventLoop(), [perf_counter()]
    playhead = window.workspace.playhead

    def tick() -> None:
        ticks.append(perf_counter())
        playhead.move_to(2 + len(ticks) % (2 * SPAN - 2))
        window.canvas.repaint()
        if done():
            loop.quit()

    timer = QTimer(timerType=Qt.TimerType.PreciseTimer, interval=TICK_MS)
    timer.timeout.connect(tick)
    timer.start()
    loop.exec()
    timer.stop()
    return 1e3 * np.diff(ticks)


def print_row(name: str, times: np.ndarray) -> None:
    p50, p95, p99 = np.percentile(times, [50, 95, 99])
    figures = f"{p50:8.1f}{p95:8.1f}{p99:8.1f}{times.max():8.1f}"
    print(f"{name:<28}{len(times):8}{figures}", flush=True)


def at_rest(window: MainWindow) -> bool:
    """Whether everything is solved and checked."""
    return not window.workspace.solver.busy and not window.workspace.inspector.busy


def ends_after(seconds: float) -> Callable[[], bool]:
    """Return a condition that comes true later."""
    end = perf_counter() + seconds
    return lambda: perf_counter() > end


# -- cancel ------------------------------------------------------------------------------------


def report_cancel(pairs: list[Pair]) -> None:
    """Print how long work runs on after it was cancelled, and its longest deaf stretches."""
    from core.morph.pipeline import solve_outlines
    from core.morph.soundness import check_span

    print("\nmilliseconds from cancel to stopped, and the longest stretches without a look")
    print(f"{'':<28}{'work':>8}{'p50':>8}{'max':>8}   longest stretches, by stage")
    for pair in pairs:
        timed = timed_span(pair)
        span = timed.span

        def solve(progress: core.Progress, span=span) -> object:
            return solve_outlines(span.source, span.target, progress=progress)

        print_cancel(pair.name, solve)
        morph = solve_span(span)
        print_cancel("  its check", partial(check_span, span, morph, timed.frames()))


def print_cancel(name: str, work: Callable[[core.Progress], object]) -> None:
    seconds, gaps = stretches(work)
    late = [1e3 * run_on(work, seconds * (k + 0.5) / CANCELS) for k in range(CANCELS)]
    longest = ", ".join(f"{stage} {1e3 * gap:.0f}" for stage, gap in gaps[:3])
    figures = f"{1e3 * seconds:8.0f}{np.median(late):8.1f}{max(late):8.1f}"
    print(f"{name:<28}{figures}   {longest}", flush=True)


def stretches(work: Callable[[core.Progress], object]) -> tuple[float, list[tuple[str, float]]]:
    """Return the seconds of some work, and the longest between two reports, by their stages."""
    start = last = perf_counter()
    gaps: dict[str, float] = {}
    stage_before = "start"

    def report(fraction: float, stage: str) -> None:
        nonlocal last, stage_before
        now = perf_counter()
        stretch = f"{stage_before} → {stage}"
        gaps[stretch] = max(gaps.get(stretch, 0.0), now - last)
        last, stage_before = perf_counter(), stage

    work(report)
    report(1.0, "end")
    return perf_counter() - start, sorted(gaps.items(), key=lambda gap: -gap[1])


def run_on(work: Callable[[core.Progress], object], after: float) -> float:
    """Cancel work in a worker after some seconds; return how many it ran on."""
    from app.jobs.worker import Worker

    worker = Worker("benchmark")
    try:
        worker.start(work)
        wait(ends_after(after))
        start = perf_counter()
        worker.cancel()
        wait(lambda: not worker.busy)
        return perf_counter() - start
    finally:
        worker.close()


# -- memory ------------------------------------------------------------------------------------


def report_memory(solves: int, windows: int) -> None:
    """Print what stays behind as solves, documents and windows come and go."""
    print("\nmegabytes of the process, and Python objects alive")
    steps = 10
    offsets = count(0.0, 1e-3)  # so that nothing remembered answers

    def moved() -> Pair:
        return bending(next(offsets))

    watch_memory("solves", solves, steps, lambda: solve_span(timed_span(moved(), COARSE).span))
    with open_window() as window:

        def open_document() -> None:
            window.workspace.session.replace(document(moved(), COARSE))
            wait(lambda: at_rest(window))

        watch_memory("documents", max(solves // 5, steps), steps, open_document)

    def open_and_close() -> None:
        with open_window() as window:
            window.workspace.session.replace(document(moved(), COARSE))
            wait(lambda: at_rest(window))

    watch_memory("windows", windows, steps, open_and_close)


def watch_memory(name: str, times: int, steps: int, work: Callable[[], object]) -> None:
    """Do some work so many times, and print memory at regular steps."""
    for step in range(1, steps + 1):
        for _ in range(times // steps):
            work()
        gc.collect()
        alive = len(gc.get_objects())
        print(f"{name:<12}{step * (times // steps):6}{resident():10.1f}{alive:10}", flush=True)


def resident() -> float:
    """Return the megabytes that the process holds."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


# -- the window --------------------------------------------------------------------------------


@contextmanager
def open_window() -> Iterator[MainWindow]:
    """Open the real window offscreen, with settings of its own; close it without a question."""
    from pathlib import Path

    from PySide6.QtCore import QCoreApplication, QEvent, QSettings, QTemporaryDir

    from app.main_window import MainWindow
    from app.settings import Settings

    folder = QTemporaryDir()
    settings = Settings(QSettings(folder.filePath("settings.ini"), QSettings.Format.IniFormat))
    window = MainWindow(settings)
    window.resize(1360, 860)
    window.show()
    try:
        yield window
    finally:
        window.workspace.session.mark_saved(Path(folder.filePath("saved.betwixt")))
        window.close()
        window.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def wait(done: Callable[[], bool]) -> None:
    """Let the event loop run until something holds."""
    from PySide6.QtCore import QEventLoop, QTimer

    loop, timer = QEventLoop(), QTimer(interval=1)

    def look() -> None:
        if done():
            loop.quit()

    timer.timeout.connect(look)
    timer.start()
    loop.exec()


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", choices=["frames", "cancel", "memory"])
    parser.add_argument("--pairs", nargs="*", default=HEAVY, help="names of source outlines")
    parser.add_argument("--solves", type=int, default=1000)
    parser.add_argument("--windows", type=int, default=20)
    options = parser.parse_args()
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

    from PySide6.QtCore import QStandardPaths
    from PySide6.QtWidgets import QApplication

    QStandardPaths.setTestModeEnabled(True)
    _ = QApplication([])
    pairs = within_classes(load_outlines())
    chosen = [pair for pair in pairs if pair.name.split(" ")[0] in options.pairs]
    for name, report in {
        "frames": partial(report_frames, chosen),
        "cancel": partial(report_cancel, chosen),
        "memory": partial(report_memory, options.solves, options.windows),
    }.items():
        if options.only in (None, name):
            report()


if __name__ == "__main__":
    main()
