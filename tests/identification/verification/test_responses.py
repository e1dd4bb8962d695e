"""Outcome and amplitude of members and of observations."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.ensembles.ensemble import ensemble
from colonnade.dynamics.ensembles.uncertainty import Uncertainty
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.motion import Motion
from colonnade.identification.verification.responses import OUTCOMES, OVERTURNED, Response, forecast_of

NAN = float("nan")


def test_outcomes_are_ordered_from_standing_to_overturned():
    assert OUTCOMES == ("no-rocking", "rocking", "overturned")


@pytest.mark.parametrize(
    ("outcome", "peak_ratio", "amplitude"),
    [
        pytest.param("no-rocking", 4e-4, 0.0, id="noise of a specimen at rest does not count"),
        pytest.param("rocking", 0.37, 0.37, id="rocking"),
        pytest.param("rocking", 1.2, 1.0, id="beyond the critical angle and back"),
        pytest.param("overturned", None, 1.0, id="overturned, without a peak"),
    ],
)
def test_an_observation_has_outcome_and_amplitude(outcome, peak_ratio, amplitude):
    assert Response.observed(outcome, peak_ratio) == Response(OUTCOMES.index(outcome), amplitude)


@pytest.mark.parametrize(
    ("outcome", "peak_ratio", "said"),
    [
        pytest.param(
            "not-overturned", 0.3, "one of no-rocking, rocking, overturned", id="an outcome that is not known"
        ),
        pytest.param("rocking", None, "peak_ratio", id="rocking without a peak"),
        pytest.param("rocking", NAN, "peak_ratio", id="rocking with a peak that is missing"),
        pytest.param("rocking", -0.1, "zero or more", id="a negative peak"),
    ],
)
def test_an_observation_that_cannot_be_scored_is_refused(outcome, peak_ratio, said):
    with pytest.raises(ValueError, match=said):
        Response.observed(outcome, peak_ratio)


def test_members_at_the_limit_of_rocking_stand():
    forecast = forecast_of([NO_ROCKING_RATIO, np.nextafter(NO_ROCKING_RATIO, 1), 1.3], [NAN, NAN, NAN])
    assert forecast.outcomes.tolist() == [0, 1, 1]
    assert forecast.amplitudes[0] == 0.0
    assert forecast.amplitudes[2] == 1.0


@pytest.mark.parametrize(
    ("peaks", "times", "said"),
    [
        pytest.param([0.1, 0.2], [NAN], "2 members and overturning_time 1", id="lengths differ"),
        pytest.param([0.1, NAN], [2.0, NAN], "stands and its peak_ratio is NaN", id="a standing member without a peak"),
        pytest.param([], [], "at least one member", id="no member"),
    ],
)
def test_members_that_say_nothing_are_refused(peaks, times, said):
    with pytest.raises(ValueError, match=said):
        forecast_of(peaks, times)


def test_a_forecast_has_the_overturning_probability_of_its_ensemble():
    block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    motion = Motion(3.4 * np.sin(np.arange(600) * 0.06), 0.005)
    found = ensemble(block, motion, restitution=0.97, uncertainty=Uncertainty(gain=0.3), count=40)
    forecast = forecast_of(found.peak_ratio, found.overturning_time)
    assert 0 < found.overturning_probability < 1
    assert forecast.overturning_probability == found.overturning_probability
    assert ((forecast.outcomes == OVERTURNED) == np.isfinite(found.overturning_time)).all()
