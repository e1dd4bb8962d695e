"""Members that are taken as if they had been observed."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.ensembles.ensemble import ensemble
from colonnade.dynamics.ensembles.uncertainty import Uncertainty
from colonnade.dynamics.motion import Motion
from colonnade.identification.verification.responses import Forecast
from colonnade.identification.verification.surrogates import surrogate_members


def forecast(members):
    return Forecast(np.zeros(members, dtype=np.int8), np.zeros(members))


def test_tests_of_one_campaign_have_the_same_member_and_others_their_own():
    drawn = surrogate_members([forecast(50)] * 5, [7, 7, 3, 3, 3], resamples=2000)
    assert (drawn[:, 0] == drawn[:, 1]).all()
    assert (drawn[:, 2:4] == drawn[:, 4:]).all()
    assert abs(np.corrcoef(drawn[:, 0], drawn[:, 2])[0, 1]) < 0.1


def test_a_member_of_an_ensemble_has_the_same_errors_in_all_tests():
    """That is why one member can be the observation of a whole campaign."""
    block = Block.prism(width=0.1, depth=0.1, height=0.6, mass=100.0)
    known = Uncertainty(restitution=0.002, critical_angle=0.005, p=0.005, gain=0.005, clock=1e-5, noise=0.01)
    motions = [Motion(2.0 * np.sin(np.arange(size) * 0.1), 0.005) for size in (100, 150)]
    one, other = (ensemble(block, motion, uncertainty=known, count=4) for motion in motions)
    np.testing.assert_array_equal(one.inputs, other.inputs)
    assert np.unique(one.inputs[:, 0]).size == 4


def test_each_member_is_drawn_as_often():
    counted = np.bincount(surrogate_members([forecast(4)], [0], resamples=4000)[:, 0])
    assert counted.tolist() == pytest.approx([1000] * 4, abs=120)


@pytest.mark.parametrize(
    ("forecasts", "campaigns", "said"),
    [
        pytest.param([], [], "at least one forecast", id="none"),
        pytest.param([forecast(3)], [1, 2], "one campaign for each", id="more campaigns than tests"),
        pytest.param([forecast(1)], [1], "single member", id="one member"),
    ],
)
def test_surrogates_that_cannot_be_drawn_are_refused(forecasts, campaigns, said):
    with pytest.raises(ValueError, match=said):
        surrogate_members(forecasts, campaigns)
