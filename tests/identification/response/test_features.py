"""A measured angle as a whole: noise, outcome, impacts, peak."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.response.features import DRIFT_FACTOR, NOISE_FACTOR, angle_features
from prism import PRISM

ALPHA = PRISM.critical_angle
TIME = np.arange(0, 10, 0.002)
ROCKING = np.where((TIME > 2) & (TIME < 6), 0.4 * ALPHA * np.sin(2 * np.pi * (TIME - 2)), 0.0)
ERROR = 1e-4


def features(angle, **changed):
    return angle_features(
        TIME, angle, **{"error": ERROR, "block": PRISM, "rest_duration": 1.0, "catch": None} | changed
    )


def noise(size=ERROR):
    return size * np.random.default_rng(2).standard_normal(TIME.size)


def test_rocking_has_its_peak_and_an_impact_at_each_passage():
    found = features(ROCKING + noise())
    assert found.verdict.outcome == "rocking"
    np.testing.assert_allclose(found.impact_times, np.arange(2.5, 6.0, 0.5), atol=2e-3)
    assert found.peak_ratio == pytest.approx(0.4, abs=0.01)
    assert abs(found.peak_angle) == pytest.approx(0.4 * ALPHA, abs=5 * ERROR)
    assert (found.peak_time - 2.25) % 0.5 == pytest.approx(0.0, abs=0.03) or (found.peak_time - 2.25) % 0.5 > 0.47


def test_noise_alone_is_not_rocking():
    found = features(noise())
    assert found.verdict.outcome == "no-rocking"
    assert found.threshold == pytest.approx(NOISE_FACTOR * ERROR, rel=0.05)
    assert found.impact_times.size == 0


def test_a_drift_between_the_rests_raises_the_threshold_and_the_error():
    drift = 3e-3 * np.clip((TIME - 2) / 4, 0, 1)
    found = features(drift + noise())
    assert found.drift == pytest.approx(3e-3, rel=0.02)
    assert found.threshold == pytest.approx(NOISE_FACTOR * ERROR + DRIFT_FACTOR * found.drift)
    assert found.standard_error == pytest.approx(np.hypot(ERROR, found.drift / np.sqrt(3)))
    assert found.verdict.outcome == "no-rocking"


def test_a_specimen_held_tilted_at_one_end_does_not_drift():
    held = np.where(TIME < 2, 0.3 * ALPHA, 0.0)
    assert features(held + noise()).drift == 0.0


def test_after_overturning_nothing_counts():
    fallen = np.where(TIME > 5, 2.0, ROCKING)
    found = features(fallen + noise())
    assert found.verdict.outcome == "overturned"
    assert np.isnan(found.peak_ratio)
    assert found.impact_times.max() < found.verdict.overturning_time


def test_missing_samples_are_passed_over():
    broken = ROCKING + noise()
    broken[1200:1210] = np.nan
    assert features(broken).peak_ratio == pytest.approx(0.4, abs=0.01)
