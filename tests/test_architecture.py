"""What may know what, and what may be loaded when."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def test_the_import_contracts_hold():
    done = subprocess.run(
        [Path(sys.executable).parent / "lint-imports", "--no-cache"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("module", "heavy"),
    [
        ("core", ["scipy", "shapely", "triangle", "PySide6", "msgspec", "svgelements"]),
        ("app.__main__", ["numpy", "scipy", "PySide6.QtWidgets", "pyqtgraph"]),
        ("core.morph.library", ["PySide6", "pyqtgraph", "triangle"]),
    ],
)
def test_importing_loads_nothing_heavy(module, heavy):
    code = f"import {module}, sys; print([m for m in {heavy!r} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "[]"


def test_the_projects_own_text_names_no_place_on_a_machine():
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True)
    if listed.returncode != 0:
        pytest.skip("not a git checkout")
    for name in listed.stdout.split():
        if name.endswith((".py", ".md", ".toml", ".svg", ".json")):
            text = (ROOT / name).read_text(encoding="utf-8")
            assert "/work" + "/" not in text, name
            assert "/home" + "/" not in text, name
