"""The verdict on a span, in words: for tooltips, panels and screen readers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication

from app.jobs.inspector import Inspector, Standing

if TYPE_CHECKING:
    from core.morph.soundness import FrameCheck, SpanCheck

MOST_RANGES = 4
"""Runs of frames that are named one by one."""


def _tr(text: str) -> str:
    return QCoreApplication.translate("Verdict", text)


def describe_span(inspector: Inspector, layer_id: int, index: int) -> str:
    """Say how a span stands, in a few sentences."""
    standing, error = inspector.standing(layer_id, index), inspector.error(layer_id, index)
    if error is not None:
        return str(error)
    check = inspector.check(layer_id, index)
    if check is not None and standing is Standing.UNSOUND:
        return "\n".join(_faults(check))
    return {
        Standing.NONE: _tr("Not solved."),
        Standing.STALE: _tr("Out of date: solving was cancelled."),
        Standing.SOLVING: _tr("Solving …"),
        Standing.FAILED: _tr("Could not be solved."),
        Standing.CHECKING: _tr("Solved; checking its frames …"),
        Standing.SOUND: _tr("Sound: nothing folds or crosses itself, and both ends are exact."),
    }[standing]


def describe_frame(check: FrameCheck) -> str:
    """Say what is wrong with a frame; empty if nothing is."""
    faults = []
    if check.crossings:
        text = _tr("crosses itself in {} places") if check.crossings > 1 else _tr("crosses itself")
        faults.append(text.format(check.crossings))
    if check.folds:
        text = _tr("{} folded triangles") if check.folds > 1 else _tr("1 folded triangle")
        faults.append(text.format(check.folds))
    return ", ".join(faults)


def troubled_frames(check: SpanCheck | None) -> list[int]:
    """Return the numbers of the frames that fold or cross."""
    return [] if check is None else [frame.frame for frame in check.frames if not frame.sound]


def _faults(check: SpanCheck) -> list[str]:
    crossing = [frame.frame for frame in check.frames if frame.crossings]
    folding = [frame.frame for frame in check.frames if frame.folds]
    faults = []
    if crossing:
        faults.append(_tr("Crosses itself at {}.").format(_frames(crossing)))
    if folding:
        faults.append(_tr("Folds at {}.").format(_frames(folding)))
    if not check.exact:
        error = max(check.source_error, check.target_error)
        faults.append(_tr("Its ends are off by {:.1e} of their size.").format(error))
    if not check.one_to_one:
        faults.append(_tr("Its map from key to key is not one to one."))
    return faults


def _frames(numbers: Sequence[int]) -> str:
    """Name frames in order, runs by their ends: "frames 2 to 5, 9"."""
    if len(numbers) == 1:
        return _tr("frame {}").format(numbers[0])
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1][1:] = [number]
        else:
            runs.append([number])
    named = [_tr(" to ").join(map(str, run)) for run in runs[:MOST_RANGES]]
    if len(runs) > MOST_RANGES:
        named.append(_tr("… ({} in all)").format(len(numbers)))
    return _tr("frames {}").format(", ".join(named))
