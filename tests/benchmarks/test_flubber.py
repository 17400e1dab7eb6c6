"""Flubber is asked pair by pair; a small package stands in for it here."""

import shutil

import numpy as np
import pytest

from tests.benchmarks import flubber
from tests.core.shapes import letter_l

STAND_IN = """
exports.interpolate = (a, b, { maxSegmentLength, string }) => (t) =>
  a.map((p, i) => p.map((x, k) => (1 - t) * x + t * b[i][k] + (string ? NaN : 0)));
"""

needs_node = pytest.mark.skipif(shutil.which("node") is None, reason="node is not here")


@pytest.fixture
def package(tmp_path):
    folder = tmp_path / "node_modules" / "flubber"
    folder.mkdir(parents=True)
    (folder / "index.js").write_text(STAND_IN, encoding="utf-8")
    return tmp_path


@needs_node
def test_frames_come_back_as_drawn_whatever_the_scale(package):
    assert flubber.installed(package) == package
    running = flubber.Flubber(package)
    for source, target in ((letter_l(), 2 * letter_l()), (1e-3 * letter_l(), letter_l())):
        frames = running.frames(source, target, np.array([0, 0.25, 1]), 128)
        assert np.stack(frames) == pytest.approx(
            np.stack([source, 0.75 * source + 0.25 * target, target])
        )
    running.close()


def test_without_node_the_reason_is_said(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", "")
    with pytest.raises(flubber.AbsentError, match="node is not here"):
        flubber.installed(tmp_path)


@needs_node
def test_a_package_that_cannot_be_fetched_is_no_failure(monkeypatch, tmp_path):
    monkeypatch.setattr(flubber.shutil, "which", lambda name: str(tmp_path / name))
    with pytest.raises(flubber.AbsentError, match="could not fetch flubber"):
        flubber.installed(tmp_path)
