"""The bundled samples are the first shapes an artist sees: sound at every frame, and moving."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from core.geometry.crossing import crosses_itself
from core.geometry.flatten import flatten
from core.geometry.location import Located
from core.io import project
from core.model import Document, Layer
from core.morph.morph import Morph
from core.morph.scene import (
    Span,
    carrying,
    layer_rings,
    picture_at,
    solve_span,
    span_of,
    turn_of,
)
from resources import sample, samples

EVERY = [path.stem for path in samples()]
ROUNDING = 1e-6
"""Pixels."""

solved = cache(solve_span)


@dataclass(frozen=True)
class SolvedSpan:
    """One span of a layer, and its solution."""

    layer: Layer
    index: int
    span: Span
    morph: Morph


def document_of(name: str) -> Document:
    return project.load(sample(name))


def spans(document: Document) -> Iterator[SolvedSpan]:
    for layer in document.layers:
        for index in range(layer.spans):
            span = span_of(layer, index)
            yield SolvedSpan(layer, index, span, solved(span))


def frames(document: Document) -> range:
    first, last = document.frames
    return range(first, last + 1)


def test_there_are_at_least_five_samples_and_the_first_is_the_one_that_opens_first():
    assert len(EVERY) >= 5
    assert EVERY[0] == "running-fox"


@pytest.mark.parametrize("name", EVERY)
def test_a_sample_is_sound_at_both_ends_and_little_distorted(name):
    for solution in spans(document_of(name)):
        report = solution.morph.report
        assert report.repairs == ()
        assert report.folds_source == ()
        assert report.folds_target == ()
        assert report.distortion_mean < 1.5, (solution.layer.name, solution.index)


@pytest.mark.parametrize("name", EVERY)
def test_no_boundary_crosses_itself_on_the_way(name):
    for solution in spans(document_of(name)):
        morph = solution.morph
        for s in np.linspace(0, 1, 33):
            positions = morph.at(float(s))
            crossing = crosses_itself([positions[ring] for ring in morph.rings])
            assert not crossing, (solution.layer.name, solution.index, s)


@pytest.mark.parametrize("name", EVERY)
def test_every_keyframe_is_met_exactly(name):
    for solution in spans(document_of(name)):
        morph, span = solution.morph, solution.span
        for s, drawn in ((0.0, span.source), (1.0, span.target)):
            end = morph.at(s)
            for ring, line in zip(morph.rings, flatten(drawn), strict=True):
                assert {tuple(p) for p in line.points} <= {tuple(p) for p in end[ring]}


@pytest.mark.parametrize("name", EVERY)
def test_everything_stays_on_the_artboard_at_every_frame(name):
    document = document_of(name)
    for frame in frames(document):
        for shape in picture_at(document, frame, solved).shapes:
            margin = shape.style.stroke_width / 2 if shape.style.stroke else 0.0
            points = np.concatenate(shape.rings)
            assert points.min() >= margin - ROUNDING, (shape.name, frame)
            inside = points + margin <= np.array(document.size) + ROUNDING
            assert inside.all(), (shape.name, frame)


@pytest.mark.parametrize("name", EVERY)
def test_a_sample_saved_again_is_the_same_document(name, tmp_path: Path):
    document = document_of(name)
    project.save(document, tmp_path / "again.betwixt")
    assert project.load(tmp_path / "again.betwixt") == document


def test_the_first_sample_never_stands_still():
    document = document_of(EVERY[0])
    fox = max(document.layers, key=lambda layer: len(layer.keyframes[0].outline.rings[0]))
    poses = [layer_rings(document, fox, frame, solved)[0] for frame in frames(document)]
    for here, there in pairwise(poses):
        gap = np.abs(here[:, None] - there[None, :]).sum(axis=2).min(axis=1)
        assert gap.max() > 5


def test_the_first_sample_ends_where_it_begins_so_that_it_loops():
    for layer in document_of(EVERY[0]).layers:
        assert layer.keyframes[0].outline == layer.keyframes[-1].outline


def test_the_key_turns_further_than_straight_paths_can_follow():
    key = next(spans(document_of("turning-key")))
    assert len(key.morph.rings) == 4  # its bow has three holes
    source, target = (p - p.mean(axis=0) for p in (key.morph.rest, key.morph.target))
    dot = np.sum(source * target)
    cross = np.sum(source[:, 0] * target[:, 1] - source[:, 1] * target[:, 0])
    assert abs(np.degrees(np.arctan2(cross, dot))) > 120


@pytest.mark.parametrize("part", ["eye", "nose", "cheek", "tail tip"])
def test_what_hangs_on_the_fox_drifts_no_further_from_it_than_it_is_drawn(part):
    document = document_of("running-fox")
    layer = next(layer for layer in document.layers if layer.name == part)
    fox = document.layer(layer.carrier)
    for index in range(layer.spans):
        morphs = [solved(span_of(some, index)) for some in (layer, fox)]
        middle = morphs[0].rest.mean(axis=0)[None]
        there = [Located.on(morph.rest, morph.triangles, middle) for morph in morphs]
        drawn = there[0].interpolate(morphs[0].target) - there[1].interpolate(morphs[1].target)
        for frame in range(layer.keyframes[index].frame, layer.keyframes[index + 1].frame):
            s = layer.progress_at(frame)[1]
            moved = carrying(document, solved)(layer, frame)
            own, on_fox = (there[i].interpolate(morphs[i].at(s)) for i in (0, 1))
            drift = moved(own) - on_fox - s * drawn
            assert np.hypot(*drift[0]) < 0.3, frame


def test_the_pinwheel_turns_twice_on_a_stick_that_bends_and_its_hub_goes_with_it():
    document = document_of("spinning-pinwheel")
    by_name = {layer.name: layer for layer in document.layers}
    stick, sails, pin = (by_name[name] for name in ("stick", "sails", "pin"))
    hub, tips = [], []
    for frame in np.linspace(*document.frames, 193):
        [blades], [disc] = (layer_rings(document, some, frame, solved) for some in (sails, pin))
        hub.append(disc.mean(axis=0))
        tips.append(max((complex(*(blade - hub[-1])) for blade in blades), key=abs))
    assert np.ptp(hub, axis=0)[0] > 50
    assert turn_of(document, sails, 0, solved) == pytest.approx(4 * np.pi, abs=0.2)
    quarters = np.unwrap(np.angle(tips), period=np.pi / 2)  # four sails alike
    assert quarters[-1] - quarters[0] == pytest.approx(8 * np.pi, abs=0.1)
    assert abs(turn_of(document, stick, 0, solved)) < 1
