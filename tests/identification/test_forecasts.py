"""Outcome and amplitude of members and of observations, and members taken as observed."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.ensemble import ensemble
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.identification.forecasts import (
    OUTCOMES,
    OVERTURNED,
    Response,
    base_rates,
    forecast_of,
    score,
)


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


def test_members_at_the_limit_of_rocking_stand():
    forecast = forecast_of([NO_ROCKING_RATIO, np.nextafter(NO_ROCKING_RATIO, 1), 1.3])
    assert forecast.outcomes.tolist() == [0, 1, 1]
    assert forecast.amplitudes[0] == 0.0
    assert forecast.amplitudes[2] == 1.0


def test_a_forecast_has_the_overturning_probability_of_its_ensemble():
    block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    motion = Motion(3.4 * np.sin(np.arange(600) * 0.06), 0.005)
    found = ensemble(block, motion, restitution=0.97, uncertainty=Uncertainty(gain=0.3), count=40)
    forecast = forecast_of(found.peak_ratio)
    assert 0 < found.overturning_probability < 1
    assert forecast.overturning_probability == found.overturning_probability
    assert ((forecast.outcomes == OVERTURNED) == np.isfinite(found.overturning_time)).all()


def test_a_member_of_an_ensemble_has_the_same_errors_in_all_tests():
    """That is why one member can be the observation of a whole campaign."""
    block = Block.prism(width=0.1, depth=0.1, height=0.6, mass=100.0)
    known = Uncertainty(restitution=0.002, critical_angle=0.005, p=0.005, gain=0.005, clock=1e-5, noise=0.01)
    motions = [Motion(2.0 * np.sin(np.arange(size) * 0.1), 0.005) for size in (100, 150)]
    one, other = (ensemble(block, motion, uncertainty=known, count=4) for motion in motions)
    np.testing.assert_array_equal(one.inputs, other.inputs)
    assert np.unique(one.inputs[:, 0]).size == 4


def test_a_test_is_forecast_by_all_others_of_its_campaign():
    observed = [Response(0, 0.0), Response(1, 0.4), Response(2, 1.0)]
    forecasts = base_rates(observed)
    assert [each.outcomes.tolist() for each in forecasts] == [[1, 2], [0, 2], [0, 1]]
    assert [each.amplitudes.tolist() for each in forecasts] == [[0.4, 1.0], [0.0, 1.0], [0.0, 0.4]]


def test_the_brier_score_of_the_base_rate_is_its_variance():
    """Fair and leave-one-out: the mean over the tests is the unbiased variance k (n − k) / (n (n − 1))."""
    observed = [Response(2, 1.0)] * 3 + [Response(1, 0.5)] * 7
    found = np.mean([score(*each)["brier"] for each in zip(base_rates(observed), observed, strict=True)])
    assert found == pytest.approx(3 * 7 / (10 * 9), abs=1e-12)
