"""The study of the verdict: its numbers keep what they promise, and its tests give the same ranks again."""

import numpy as np
import pytest
from scipy import stats

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.uncertainty import Uncertainty
from verdict_study import WITHIN
from verdict_trial import HEIGHTS, RATE, draw, run

STILL_ROCKING = 175
"""Number of a free vibration that rocks until its record ends."""


def test_a_true_model_is_within_its_spread_at_the_nominal_rate(found):
    whole = found["all"]
    assert (found["tests"], whole["judged"]) == (1000, 1000)
    low, high = stats.binom.interval(0.95, whole["judged"], whole["nominal"])
    assert low <= round(whole["within"] * whole["judged"]) <= high
    assert whole["nominal"] == pytest.approx(96 / 101, abs=1e-4)


def test_a_free_vibration_that_still_rocks_as_its_record_ends_has_the_zero_that_was_identified(found):
    """The zero that its end gives is wrong by 0.066 α."""
    assert found["ranks"]["true"][STILL_ROCKING] <= WITHIN
    rank = run(found["seed"], STILL_ROCKING, 0.0, found["members"]).rank
    assert rank == pytest.approx(found["ranks"]["true"][STILL_ROCKING], abs=0.02)


def test_a_wrong_e_is_found_more_often_than_a_true_one_is_called_wrong(found):
    for row in (found["all"], *found["counts"]):
        assert row["found"] > 3 * (1 - row["nominal"])


@pytest.mark.whole
@pytest.mark.parametrize("name", ["true", "wrong"])
def test_the_first_tests_have_the_same_ranks_again(found, name):
    wrong = {"true": 0.0, "wrong": found["wrong"]}[name]
    ranks = [run(found["seed"], number, wrong, found["members"]).rank for number in range(8)]
    np.testing.assert_allclose(ranks, found["ranks"][name][:8], atol=0.02)


def test_the_record_of_a_test_shows_what_truly_happened():
    """Without any error, the recorded base motion gives the recorded angle."""
    exact = draw(1, 1, Uncertainty(), angle_gain=0.0, angle_zero=0.0)
    top, bottom, table = (channel.values for channel in exact.recording.channels)
    assert exact.kind == "sine"
    height = HEIGHTS[exact.specimen]
    seen = np.arcsin((top - bottom) / (0.85 * height))
    motion = Motion(table, 1 / RATE)
    predicted = rock(exact.block, motion, restitution=exact.restitution, model="nonlinear").angle
    early = slice(0, 1000)
    np.testing.assert_allclose(seen[early], predicted[early], atol=0.01 * exact.block.critical_angle)
