"""Every benchmark command runs to its end, at its smallest size."""

import os
import subprocess
import sys
from importlib import import_module

import pytest

from tests.conftest import QT_PROBLEM

pytestmark = pytest.mark.skipif(bool(QT_PROBLEM), reason="benchmarks paint with Qt")


@pytest.fixture
def run(qapp, monkeypatch, capsys):
    """Run a command, with settings made smaller; return what it prints."""

    def command(name, *arguments, **settings):
        module = import_module(f"tests.benchmarks.{name}")
        monkeypatch.setattr(sys, "argv", [name, *arguments])
        for setting, value in settings.items():
            monkeypatch.setattr(module, setting, value)
        module.main()
        return capsys.readouterr().out

    return command


def run_window(name, *arguments, settings, folder):
    """Run a command that opens a window in a process of its own; return what it prints."""
    code = f"import tests.benchmarks.{name} as command; command.{settings}; command.main()"
    private = {name: str(folder) for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME")}
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments],
        env=os.environ | private | {"QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_speed(run):
    text = run("speed", "--repeats", "1", DENSITIES={"paper size": 20})
    assert "back-substitution" in text
    assert "x ours" in text


def test_figures(run, tmp_path):
    from tests.benchmarks.figures import figure_2

    run("figures", "-o", str(tmp_path), FIGURES={"mirrored": figure_2})
    assert (tmp_path / "mirrored.png").stat().st_size > 5000


def test_sweep(run, shared_data, tmp_path):
    pairs = ["--every", "200", "--cross-class", "1", "--density", "8", "--frames", "3"]
    options = ["--given-marks", "--jobs", "2", "-o", str(tmp_path)]
    text = run("sweep", *pairs, *options, installed=lambda: None)
    assert "3 pairs, 0 refused" in text
    assert {path.name for path in tmp_path.iterdir()} >= {"table.csv", "summary.txt", "worst.png"}


def test_peers(run, shared_data, tmp_path):
    small = ["--every", "200", "--triangles", "64", "-o", str(tmp_path)]
    assert "2 meshes" in run("peers", *small, find_spec=lambda module: None)
    assert (tmp_path / "table.csv").is_file()


def test_scrub(tmp_path):
    text = run_window("scrub", "--density", "20", settings="FRAMES = 4", folder=tmp_path)
    assert "overlay" in text


def test_pictures(tmp_path):
    small = "resources.FIRST_SAMPLE = 'letter-a-to-r'"
    run_window("pictures", "-o", str(tmp_path), settings=small, folder=tmp_path)
    assert {path.name for path in tmp_path.glob("*.png")} == {"strip.png", "window.png"}


def test_responsiveness(shared_data, tmp_path):
    small = ["--pairs", "horse-02", "--solves", "10", "--windows", "10"]
    settings = "CANCELS = 1; command.SECONDS = 0.2"
    text = run_window("responsiveness", *small, settings=settings, folder=tmp_path)
    assert "its check" in text
    assert "windows" in text
