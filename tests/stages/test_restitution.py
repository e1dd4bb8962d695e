"""e of a free vibration by the stage, with what it is given: the low-pass, and the motion of the table."""

import numpy as np
import pytest

import chain
from colonnade.errors import StageError
from prism import PRISM


@pytest.fixture
def rocking(small_campaign, free_vibration):
    return chain.measured(small_campaign, "free-01", free_vibration[0])[1]


@pytest.fixture
def identified(small_campaign, rocking):
    return chain.identified(small_campaign, rocking)


def test_restitution_of_a_free_vibration_is_the_true_one_by_both_estimators(identified):
    assert float(identified["restitution"]) == pytest.approx(0.93, abs=5e-4)
    assert identified.attrs["reason"] == ""
    history, peaks = (identified.sel(estimator=name) for name in ("history", "peaks"))
    assert float(history["estimate"]) == pytest.approx(0.93, abs=3e-4)
    assert float(peaks["estimate_low"]) < float(history["estimate"]) < float(peaks["estimate_high"])
    assert np.sqrt(np.nanmean(identified["history_residual"] ** 2)) < 1e-3 * 0.186
    assert identified.attrs["warnings"] == []


def test_a_wrong_inertia_is_allowed_for_and_warned_of(small_campaign, rocking):
    block = PRISM.override(inertia=1.05 * PRISM.inertia)
    result = chain.identified(small_campaign, rocking, block=block)
    assert float(result["restitution"]) == pytest.approx(0.93, abs=1e-3)
    assert [warning.kind for warning in result.attrs["warnings"]] == ["frequency parameter"]


def test_a_record_without_peaks_gives_a_reason_and_no_number(small_campaign, rocking):
    result = chain.identified(small_campaign, rocking.assign(rocking_angle=0 * rocking["rocking_angle"]))
    assert np.isnan(float(result["restitution"]))
    assert " s has 0." in result.attrs["reason"]
    assert result.attrs["warnings"]
    assert np.isnan(result["estimate"]).all()
    assert "No value to start from" in result.attrs["estimate_reasons"][0]


def test_a_free_vibration_without_transducers_is_refused(small_campaign, rocking):
    with pytest.raises(StageError, match="no restitution"):
        chain.identified(small_campaign, rocking.drop_vars("rocking_angle"))


def test_the_fit_takes_the_low_pass_into_account(small_campaign, rocking, identified):
    unfiltered = rocking.copy()
    del unfiltered["rocking_angle"].attrs["cutoff_hz"]
    other = chain.identified(small_campaign, unfiltered)
    assert float(other["estimate"][0]) != float(identified["estimate"][0])
