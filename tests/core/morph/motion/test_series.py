"""A motion and its series are the same."""

import numpy as np
import pytest

import core
from core.morph.motion.series import Series
from tests.core.shapes import ellipse, letter_l


@pytest.mark.parametrize("method", ["arap", "plain arap"])
def test_a_frame_from_the_series_is_the_fit(method):
    morph = core.solve(letter_l(), ellipse(40), recipe=core.Recipe(method=method))
    shape = morph.inbetween.shape
    series = Series(lambda t: shape.fit(shape.ideal(t)))
    for t in np.linspace(0, 1, 29):
        fitted = shape.fit(shape.ideal(t))
        assert np.abs(series(t) - fitted).max() < 1e-12 * np.ptp(fitted)


def test_past_its_ends_and_where_no_series_is_enough_frames_are_the_motions_own():
    asked: list[float] = []

    def motion(t: float) -> np.ndarray:
        asked.append(t)
        return np.array([[abs(t - 0.3), 1.0]])

    kinked, smooth = Series(motion), Series(lambda t: np.array([[np.exp(t), t]]))
    asked.clear()
    assert kinked(0.4)[0, 0] == pytest.approx(0.1)
    assert asked == [0.4]
    assert smooth(1.3)[0, 0] == np.exp(1.3)


def test_a_motion_that_stands_still_is_a_series_of_one_term():
    place = np.array([[1.0, 2.0], [3.0, 4.0]])
    assert Series(lambda t: place)(0.7) == pytest.approx(place)
