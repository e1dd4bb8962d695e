import numpy as np
import pytest

from colonnade.figures.stored import curves

STRONG = "sine-3hz-too-strong-for-the-block-1"


def test_measured_and_predicted_are_over_the_critical_angle(known):
    _, record, stored, block = known("span-2.0")
    measured = curves.measured_ratio(stored, block)
    assert np.nanmax(np.abs(measured.values)) == pytest.approx(record.peak_ratio, rel=1e-6)
    assert set(curves.predicted_ratios(stored, block)) == {"linear", "nonlinear"}


def test_misfits_end_where_the_comparison_ends(known):
    _, _, stored, block = known("span-3.0")
    measured, predicted = curves.measured_ratio(stored, block), curves.predicted_ratios(stored, block)
    for model, misfit in curves.misfits(stored, measured, predicted).items():
        assert misfit.time[-1] <= stored.compared("compared_until", model) < measured.time[-1]


def test_each_model_has_the_bands_of_its_ensemble(known):
    _, _, stored, block = known("span-2.0")
    for spread in curves.spreads(stored, block).values():
        assert spread.bands.shape == (spread.levels.size, spread.time.size)
        assert 0.0 < spread.horizon <= spread.time[-1]


def test_what_was_not_measured_is_none(known):
    _, _, stored, block = known("watched")
    assert curves.measured_ratio(stored, block) is None
    assert curves.motion(stored, "slide", "mm") is None
    assert curves.motion(stored, "base_acceleration", "m/s²") is not None


def test_a_curve_ends_where_it_overturns(known):
    _, record, stored, block = known(STRONG)
    curve = curves.measured_ratio(stored, block)
    fall = stored.value("rocking", "overturning_time")
    last = int(np.flatnonzero(np.isfinite(curve.values))[-1])
    assert record.outcome == "overturned"
    assert record.peak_time == fall
    assert curve.time[last] == pytest.approx(fall, abs=0.005)
    assert abs(curve.values[last]) == pytest.approx(1.0, abs=0.1)
