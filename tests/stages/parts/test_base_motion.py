"""What drives a prediction, and what is said of a base motion that cannot be used whole."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from colonnade.errors import StageError
from colonnade.stages.parts.base_motion import (
    base_acceleration,
    transverse_acceleration,
    vertical_acceleration,
    weakened,
)
from colonnade.units import format_percent

TIME = np.arange(0.0, 2.0, 0.01)
WAVE = np.sin(2 * np.pi * 3.0 * TIME)


def _rocking(**variables):
    named = {name: ("elapsed", values) for name, values in variables.items()}
    return xr.Dataset(named, coords={"elapsed": ("elapsed", TIME)})


def _gap(values):
    holed = values.copy()
    holed[50:53] = np.nan
    return holed


def test_a_whole_record_is_returned_as_it_is():
    np.testing.assert_array_equal(base_acceleration(_rocking(base_acceleration=WAVE)), WAVE)


def test_a_record_that_is_missing_is_refused_with_what_to_add():
    with pytest.raises(StageError, match=r'was not recorded in this test.*on = "table"'):
        base_acceleration(_rocking())


def test_missing_samples_are_refused_with_the_first():
    with pytest.raises(StageError, match=r"missing 3 of 200 samples, the first at 0\.500 s"):
        base_acceleration(_rocking(base_acceleration=_gap(WAVE)))


def test_a_vertical_motion_is_only_missed_if_the_set_up_has_its_channel():
    assert vertical_acceleration(_rocking(), gravity=9.81, expected=False) == (None, [])
    assert len(vertical_acceleration(_rocking(), gravity=9.81, expected=True)[1]) == 1


def test_a_model_in_space_takes_the_motion_across_if_it_is_whole():
    assert transverse_acceleration(_rocking(transverse_base_acceleration=_gap(WAVE))) is None
    np.testing.assert_array_equal(transverse_acceleration(_rocking(transverse_base_acceleration=WAVE)), WAVE)


@pytest.mark.parametrize(("frequency", "loss"), [(3.0, None), (8.0, 0.021), (20.0, 0.125)])
def test_content_too_fast_for_straight_lines_is_said_with_its_loss(frequency, loss):
    # sinc²(f / 100 Hz): 0.997, 0.979, 0.875
    found = weakened(np.sin(2 * np.pi * frequency * TIME))
    assert [format_percent(loss) in each.text for each in found] == [True] if loss else not found


def test_the_loss_is_that_of_a_sine_drawn_with_straight_lines():
    fine = np.arange(0.0, 2.0, 0.0005)
    drawn = np.interp(fine, np.append(TIME, 2.0), np.sin(2 * np.pi * 10.0 * np.append(TIME, 2.0)))
    kept = 2.0 * np.mean(drawn * np.sin(2 * np.pi * 10.0 * fine))
    (finding,) = weakened(np.sin(2 * np.pi * 10.0 * TIME))
    assert f"by {format_percent(1 - kept)} " in finding.text


def test_a_table_at_rest_loses_nothing():
    assert weakened(np.zeros(100)) == []
