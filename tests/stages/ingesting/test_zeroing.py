"""Where zero is taken, and what is subtracted there."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.errors import StageError
from colonnade.signals.rest import RestWindow
from colonnade.stages.ingesting.clocks import ChannelOnClock
from colonnade.stages.ingesting.zeroing import rest_window, zeroed

CLOCK = np.arange(0.0, 10.0, 0.01)
CHANNELS = {"top": ChannelOnClock(quantity="displacement", on="specimen", recorder="main")}


def _window(**changed):
    moving = np.where((CLOCK > 2.0) & (CLOCK < 7.0), np.sin(CLOCK), 0.0)
    given = {"zero": "auto", "free_vibration": False, "duration": 0.5, "effects": {}, "warnings": []} | changed
    return rest_window(CLOCK, {"top": moving}, {"top": {"noise": 1e-3}}, CHANNELS, **given)


def test_a_shaken_test_is_zeroed_at_its_start_and_a_free_vibration_at_its_end():
    assert _window().stop <= 2.0
    assert _window(free_vibration=True).start >= 7.0


@pytest.mark.parametrize(
    ("zero", "start"), [("end", 7.0), ((4.0, 5.0), 4.0)], ids=["the end by name", "a stretch by its times"]
)
def test_a_test_may_say_where_its_zero_is(zero, start):
    assert _window(zero=zero).start >= start


def test_none_takes_no_zero():
    assert _window(zero="none") is None


def _zeroed(values, resting=0.0, window=RestWindow(0.0, 1.0, quiet=True)):  # noqa: B008
    attributes, warnings = {"noise": 1e-6}, []
    return zeroed(CLOCK, values, "top", attributes, window, resting, warnings), attributes, warnings


def test_the_value_at_rest_is_subtracted_and_noted():
    values, attributes, warnings = _zeroed(np.full(CLOCK.size, 0.7))
    np.testing.assert_allclose(values, 0.0, atol=1e-15)
    assert (attributes["zero"], warnings) == (pytest.approx(0.7), [])


def test_an_accelerometer_becomes_its_part_of_gravity():
    values, attributes, _ = _zeroed(np.full(CLOCK.size, 9.9), resting=9.81)
    np.testing.assert_allclose(values, 9.81)
    assert attributes["zero"] == pytest.approx(0.09)


def test_one_that_does_not_sense_gravity_is_reported():
    _, _, (warning,) = _zeroed(np.zeros(CLOCK.size), resting=9.81)
    assert (warning.kind, "Gravity was added" in warning.text) == ("gravity", True)


def test_a_channel_without_a_value_in_the_window_is_left_out():
    values, _, (warning,) = _zeroed(np.where(CLOCK < 2.0, np.nan, 1.0))
    assert (values, warning.kind, warning.severity) == (None, "channel left out", "serious")


def test_a_window_outside_the_record_is_refused():
    with pytest.raises(StageError, match=r"no sample is between 20 and 21 s; the record goes from 0 to 9\.99 s"):
        _zeroed(np.zeros(CLOCK.size), window=RestWindow(20.0, 21.0, quiet=True))
