"""Marks on shapes that were bent in a known way: how near they are, and how well they know it."""

from __future__ import annotations

import numpy as np
import pytest

from core.geometry.polyline import arc_lengths, resample
from core.model.outline import Array
from core.morph.marks.rings import match_rings
from tests.core.shapes import rotation

SHAPES = (
    "bat-00",
    "camel-03",
    "deer-05",
    "guitar-02",
    "hammer-04",
    "horse-01",
    "key-06",
    "shoe-01",
)


def bent(ring: Array, seed: int) -> Array:
    """Return a ring (n, 2) bent by smooth waves, turned and enlarged, vertex by vertex."""
    random = np.random.default_rng(seed)
    points = (ring - ring.mean(axis=0)) / np.sqrt(ring.var(axis=0).sum())
    moved = points.copy()
    for _ in range(3):
        wave, phase, along = (
            random.normal(size=2) * 1.5,
            random.uniform(0, 6),
            random.normal(size=2),
        )
        moved += 0.12 * np.sin(points @ wave + phase)[:, None] * along
    return 2 * moved @ rotation(random.uniform(-0.6, 0.6)).T


@pytest.fixture(scope="module")
def judged(shared_data: object) -> tuple[Array, Array]:
    """Return the confidences (k,) of all marks, and how far off they are in perimeters."""
    confidences, errors = [], []
    with np.load(f"{shared_data}/mpeg7_outlines.npz") as file:
        rings = [resample(file[name].astype(float), 500) for name in SHAPES]
    for seed, ring in enumerate(rings):
        goal = bent(ring, seed)
        match = next(each for each in match_rings(ring, goal) if not each.mirrored)
        here, there, confidence = match.marks()
        truth, perimeter = arc_lengths(goal), arc_lengths(goal)[-1]
        off = there - np.interp(here, arc_lengths(ring), truth)
        errors.append(np.abs(np.mod(off / perimeter + 0.5, 1) - 0.5))
        confidences.append(confidence)
    return np.concatenate(confidences), np.concatenate(errors)


def test_marks_lie_where_they_belong(judged: tuple[Array, Array]) -> None:
    _, errors = judged
    assert errors.mean() < 0.005
    assert (errors < 0.02).mean() > 0.9


def test_surer_marks_are_nearer_to_where_they_belong(judged: tuple[Array, Array]) -> None:
    confidences, errors = judged
    assert ((confidences >= 0) & (confidences <= 1)).all()
    sure = confidences > np.median(confidences)
    assert errors[sure].mean() < 0.7 * errors[~sure].mean()
