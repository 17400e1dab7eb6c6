"""Which drawing is held at a frame."""

from __future__ import annotations

import pytest

from core.errors import EditError
from core.model import Document, Keyframe, Layer, Outline
from core.model.edits import update_document

SQUARE = Outline.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])


def document(hold: int, *frames: int) -> Document:
    keys = tuple(Keyframe(frame, SQUARE) for frame in frames)
    return Document((Layer(1, "card", keys),), hold=hold)


@pytest.mark.parametrize(
    ("hold", "drawn"),
    [
        (1, [1, 2, 3, 4, 5, 6, 7, 8, 9]),
        (2, [1, 1, 3, 3, 5, 6, 7, 7, 9]),
        (3, [1, 1, 1, 4, 4, 6, 7, 7, 9]),
    ],
)
def test_drawings_are_held_from_frame_1_on_and_keys_are_seen_at_their_own(
    hold: int, drawn: list[int]
) -> None:
    held = document(hold, 1, 6, 9)
    assert [held.drawn_at(frame) for frame in range(1, 10)] == drawn


def test_between_frames_every_moment_is_its_own() -> None:
    assert document(2, 1, 9).drawn_at(4.5) == 4.5


def test_before_frame_1_drawings_are_held_too() -> None:
    assert [document(2, -4, 9).drawn_at(frame) for frame in (-4, -3, -2, -1, 0, 1)] == [
        *(-4, -3, -3, -1, -1, 1)
    ]


@pytest.mark.parametrize("hold", [0, -1, 13])
def test_no_drawing_is_held_for_no_frame_or_for_ever(hold: int) -> None:
    with pytest.raises(EditError):
        update_document(document(1, 1, 9), hold=hold)
