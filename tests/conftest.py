"""Qt runs offscreen; without its system libraries the tests of core still run."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import settings

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

# A busy machine is no failure, so examples have no deadline. The same ones every time: what passes
# here passes elsewhere. New ones: pytest --hypothesis-profile=explore.
settings.register_profile("explore", deadline=None, max_examples=60)
settings.register_profile("betwixt", settings.get_profile("explore"), derandomize=True)
settings.load_profile("betwixt")

collect_ignore: list[str] = []
QT_PROBLEM = ""
try:
    import PySide6.QtWidgets  # noqa: F401
except ImportError as problem:
    QT_PROBLEM = str(problem)
    collect_ignore.append("app")
else:
    pytest_plugins = ("pytestqt.plugin",)

SHARED_DATA = Path(__file__).parents[2] / "shared" / "data"


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if QT_PROBLEM:
        terminalreporter.write_line(
            f"NOT RUN: the tests of the window, because Qt does not load ({QT_PROBLEM}).", red=True
        )
        terminalreporter.write_line("The README names the system packages that it needs.")


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """The folder of real shapes beside the checkout; tests that need it skip without it."""
    if not SHARED_DATA.is_dir():
        pytest.skip("real shapes (../shared/data) are not here")
    return SHARED_DATA
