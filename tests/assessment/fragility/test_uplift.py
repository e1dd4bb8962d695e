"""Start of rocking: a curve, or the threshold g tan α."""

import numpy as np
import pytest

from colonnade.assessment.fragility.outcomes import gather
from colonnade.assessment.fragility.uplift import uplift
from virtual_capacities import names


def test_with_peak_acceleration_and_no_vertical_motion_it_is_a_threshold():
    outcomes = gather(names(2), [[1.0, 2.0]] * 2, [[0.0, 0.1], [0.0, 0.2]])
    found = uplift(outcomes, threshold=(1.7, 1.9))
    assert (found.threshold, found.curve) == ((1.7, 1.9), None)


def test_otherwise_it_is_a_curve_of_the_histories_that_rocked():
    peak = np.where(np.random.default_rng(1).normal(2.0, 0.5, (40, 1)) < np.linspace(1, 3, 8), 0.3, 0.0)
    found = uplift(gather(names(40), np.tile(np.linspace(1, 3, 8), (40, 1)), peak), resamples=100)
    assert found.threshold is None
    assert found.curve.median.low < 2.0 < found.curve.median.high


def test_a_threshold_that_falls_is_refused():
    with pytest.raises(ValueError, match="rising pair"):
        uplift(gather(names(2), [[1.0]] * 2, [[0.0]] * 2), threshold=(2.0, 1.0))
