"""The playhead shows the frame that is due, and goes where it is told."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from pytestqt.qtbot import QtBot

from app.document.playhead import Loop, Playhead
from app.document.session import Session
from core.model import Document, Keyframe, Layer, Outline
from core.model.edits import move_keyframe, update_document, update_layer

SQUARE = Outline.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])


def layer(layer_id: int, *frames: int) -> Layer:
    return Layer(layer_id, f"layer {layer_id}", tuple(Keyframe(f, SQUARE) for f in frames))


class Clock:
    """Time that passes when the test says so, in seconds."""

    def __init__(self) -> None:
        self.time = 100.0

    def __call__(self) -> float:
        return self.time


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def session(qapp: object) -> Iterator[Session]:
    session = Session(Document((layer(1, 1, 9), layer(2, 5, 13))))
    yield session
    session.close()


@pytest.fixture
def playhead(session: Session, clock: Clock) -> Iterator[Playhead]:
    playhead = Playhead(session, now=clock)
    yield playhead
    playhead.stop()


def shows(playhead: Playhead, frame: float, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: playhead.frame == frame)


def watch(playhead: Playhead) -> list[float]:
    frames: list[float] = []
    playhead.moved.connect(frames.append)
    return frames


# -- playing -----------------------------------------------------------------------------------


@pytest.mark.parametrize("fps", [12.0, 23.976, 24.0, 30.0, 60.0])
def test_it_shows_the_frame_that_is_due_by_the_clock(
    fps: float, session: Session, playhead: Playhead, clock: Clock, qtbot: QtBot
) -> None:
    session.apply("Frame rate", update_document, fps=fps)
    playhead.play()
    for frames in (1, 2, 5, 12):
        clock.time = 100.0 + frames / fps
        shows(playhead, 1 + frames, qtbot)


def test_nothing_is_shown_before_it_is_due(playhead: Playhead, clock: Clock, qtbot: QtBot) -> None:
    playhead.play()
    clock.time += 0.9 / 24
    seen = watch(playhead)
    clock.time += 0.1 / 24
    shows(playhead, 2, qtbot)
    assert seen == [2]


def test_a_slow_paint_drops_frames_and_not_time(
    playhead: Playhead, clock: Clock, qtbot: QtBot
) -> None:
    seen = watch(playhead)
    playhead.play()
    clock.time += 7 / 24
    shows(playhead, 8, qtbot)
    assert seen == [8]


def test_loop_starts_again_at_the_first_frame(
    playhead: Playhead, clock: Clock, qtbot: QtBot
) -> None:
    playhead.set_loop(Loop.LOOP)
    playhead.play()
    clock.time += 12 / 24
    shows(playhead, 13, qtbot)
    clock.time += 4 / 24
    shows(playhead, 4, qtbot)
    assert playhead.playing


def test_once_stops_on_the_last_frame_and_then_plays_from_the_first(
    playhead: Playhead, clock: Clock, qtbot: QtBot
) -> None:
    playhead.set_loop(Loop.ONCE)
    playhead.play()
    clock.time += 99
    qtbot.waitUntil(lambda: not playhead.playing)
    assert playhead.frame == 13
    playhead.play()
    assert playhead.frame == 1


def test_ping_pong_turns_at_both_ends(playhead: Playhead, clock: Clock, qtbot: QtBot) -> None:
    playhead.set_loop(Loop.PING_PONG)
    playhead.set_range((3, 6))
    playhead.play()
    seen = []
    for _ in range(9):
        seen.append(playhead.frame)
        clock.time += 1 / 24
        shows(playhead, [4, 5, 6, 5, 4, 3, 4, 5, 6][len(seen) - 1], qtbot)
    assert seen == [3, 4, 5, 6, 5, 4, 3, 4, 5]


def test_play_shows_the_first_frame_when_it_starts_outside_the_range(playhead: Playhead) -> None:
    playhead.set_range((5, 8))
    playhead.play()
    assert playhead.frame == 5


def test_play_from_the_start_ignores_where_the_playhead_is(playhead: Playhead) -> None:
    playhead.move_to(7)
    playhead.play(from_start=True)
    assert playhead.frame == 1


def test_another_frame_rate_while_playing_goes_on_from_what_is_shown(
    session: Session, playhead: Playhead, clock: Clock, qtbot: QtBot
) -> None:
    playhead.play()
    clock.time += 4 / 24
    shows(playhead, 5, qtbot)
    session.apply("Frame rate", update_document, fps=12.0)
    seen = watch(playhead)
    clock.time += 1 / 12
    shows(playhead, 6, qtbot)
    assert seen == [6]


def test_another_range_while_playing_goes_on_from_what_is_shown(
    session: Session, playhead: Playhead, clock: Clock, qtbot: QtBot
) -> None:
    playhead.play()
    clock.time += 4 / 24
    shows(playhead, 5, qtbot)
    playhead.set_range((3, 6))
    seen = watch(playhead)
    for frame in (6, 3, 4):
        clock.time += 1 / 24
        shows(playhead, frame, qtbot)
    assert seen == [6, 3, 4]


def test_scrubbing_while_playing_goes_on_from_there(
    playhead: Playhead, clock: Clock, qtbot: QtBot
) -> None:
    playhead.play()
    playhead.move_to(9)
    clock.time += 2 / 24
    shows(playhead, 11, qtbot)


def test_toggle_plays_and_stops_and_says_so_once_each(playhead: Playhead) -> None:
    told: list[bool] = []
    playhead.playing_changed.connect(told.append)
    playhead.toggle()
    playhead.play()
    playhead.toggle()
    playhead.stop()
    assert told == [True, False]


def test_a_listener_may_stop_it_at_a_frame(playhead: Playhead, clock: Clock, qtbot: QtBot) -> None:
    playhead.moved.connect(playhead.stop)
    playhead.play()
    clock.time += 1 / 24
    shows(playhead, 2, qtbot)
    assert not playhead.playing


# -- moving ------------------------------------------------------------------------------------


def test_steps_are_whole_frames_from_anywhere(playhead: Playhead) -> None:
    for start, by, end in ((3, 1, 4), (3, -1, 2), (3.4, 1, 4), (3.4, -1, 3), (3, 10, 13)):
        playhead.move_to(start)
        playhead.step(by)
        assert playhead.frame == end


def test_steps_between_keys_visit_the_keys_of_all_visible_layers(
    session: Session, playhead: Playhead
) -> None:
    seen = watch(playhead)
    for direction in (1, 1, 1, 1, -1, -1, -1, -1):
        playhead.step_key(direction)
    assert seen == [5, 9, 13, 9, 5, 1]
    session.apply("Hide", update_layer, 2, visible=False)
    playhead.step_key(1)
    assert playhead.frame == 9


def test_to_start_and_to_end_go_to_the_ends_of_the_range(playhead: Playhead) -> None:
    playhead.to_end()
    assert playhead.frame == 13
    playhead.set_range((2, 6))
    playhead.to_end()
    assert playhead.frame == 6
    playhead.to_start()
    assert playhead.frame == 2


def test_time_begins_at_frame_one_or_at_an_earlier_key(
    session: Session, playhead: Playhead
) -> None:
    playhead.move_to(-4)
    assert playhead.frame == 1
    session.apply("Move", move_keyframe, 1, 0, -2)
    playhead.move_to(-4)
    assert playhead.frame == -2


def test_the_range_is_all_keys_until_the_artist_sets_one(
    session: Session, playhead: Playhead
) -> None:
    assert playhead.range == (1, 13)
    assert not playhead.limited
    playhead.set_range((9, 4))
    assert playhead.range == (4, 9)
    assert playhead.limited
    playhead.set_range(None)
    session.apply("Move", move_keyframe, 2, 1, 20)
    assert playhead.range == (1, 20)


def test_another_document_starts_at_its_first_frame_with_its_own_range(
    session: Session, playhead: Playhead
) -> None:
    playhead.set_range((3, 6))
    playhead.play()
    session.replace(Document((layer(1, 4, 40),)))
    assert (playhead.frame, playhead.range, playhead.playing) == (4, (4, 40), False)
