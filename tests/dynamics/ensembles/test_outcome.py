"""What an ensemble says of overturning and of its inputs, against scipy's ranks and Wilson's interval."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import spearmanr

from colonnade.dynamics.ensembles.ensemble import ensemble
from colonnade.dynamics.ensembles.uncertainty import INPUTS, Uncertainty
from colonnade.dynamics.motion import Motion
from prism import PRISM

PULSE = Motion(np.concatenate((2.0 * np.sin(2 * np.pi * np.arange(100) / 100), np.zeros(600))), 0.004)


def test_sensitivity_names_what_the_peak_follows_from():
    """One pulse, peak before the first impact: e has no part in it, a larger motion rises higher, a larger α less."""
    uncertainty = Uncertainty(restitution=0.01, critical_angle=0.003, gain=0.02)
    half = Motion(np.concatenate((1.9 * np.sin(np.pi * np.arange(50) / 50), np.zeros(60))), 0.004)
    result = ensemble(PRISM, half, restitution=0.95, uncertainty=uncertainty, count=800)
    found = result.sensitivity()
    assert set(found) == {"restitution", "critical_angle", "gain"}
    assert found["gain"] > 0.9
    assert -0.6 < found["critical_angle"] < -0.1
    assert abs(found["restitution"]) < 0.1
    for name in found:
        expected = spearmanr(result.peak_ratio, result.inputs[:, INPUTS.index(name)]).statistic
        assert found[name] == pytest.approx(expected, abs=1e-12)


def test_no_certainty_follows_from_few_members():
    result = ensemble(PRISM, PULSE, restitution=0.95, uncertainty=Uncertainty(gain=0.01), count=20)
    assert result.overturning_probability == 0.0
    assert result.overturning_interval() == pytest.approx((0.0, 0.16113), abs=1e-4)  # Wilson, 0 of 20
