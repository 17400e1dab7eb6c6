"""What counts as an error."""

from __future__ import annotations

import pytest

import core
from core.errors import Where


def test_stopping_on_request_is_no_error() -> None:
    assert not issubclass(core.Cancelled, core.MorphError)


@pytest.mark.parametrize("kind", core.MorphError.__subclasses__())
def test_every_error_says_where_then_what_then_how_to_mend_it(kind: type[core.MorphError]) -> None:
    error = kind("It broke.", where=Where(path="a.betwixt"), hint="Mend it.")
    assert str(error) == "a.betwixt: It broke. Mend it."
