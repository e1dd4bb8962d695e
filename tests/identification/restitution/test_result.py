"""What an identification returns, where most of it is missing."""

from __future__ import annotations

from dataclasses import FrozenInstanceError, fields

import numpy as np
import pytest

from colonnade.identification.restitution.result import Constancy, Estimate, FittedHistory, Impacts, Peaks, Restitution

REFUSED = {"value": None, "low": None, "high": None, "standard_error": None, "level": 0.95}


@pytest.mark.parametrize("kind", [Peaks, Impacts])
def test_peaks_and_impacts_are_empty_unless_given(kind):
    nothing = kind()
    for each in fields(kind):
        values = getattr(nothing, each.name)
        assert values.shape == (0,)
        assert values.dtype == (bool if each.name == "used" else np.float64)


@pytest.mark.parametrize("kind", [Peaks, Impacts])
def test_two_results_share_no_array(kind):
    first, second = kind(), kind()
    assert not any(getattr(first, each.name) is getattr(second, each.name) for each in fields(kind))


def test_a_refusal_has_everything_but_a_value():
    refused = Restitution(**REFUSED, method="", reason="too short")
    assert refused.reason == "too short"
    assert (refused.peaks.time.size, refused.impacts.time.size) == (0, 0)
    assert (refused.estimates, refused.departures, refused.history, refused.recommended) == ((), (), None, "")
    assert refused.zero_offset == 0.0


def test_what_is_not_known_of_constancy_is_no_number():
    assert all(np.isnan(getattr(Constancy(), each.name)) for each in fields(Constancy))


def test_an_estimate_with_a_value_has_no_reason():
    estimate = Estimate("peaks", 0.95, 0.94, 0.96, 0.005, 0.95, "plane rocking")
    assert (estimate.reason, estimate.residual) == ("", None)


def test_a_history_without_unknowns_has_a_covariance_of_no_size():
    history = FittedHistory(np.arange(3.0), np.zeros(3), np.zeros(3), "nonlinear")
    assert history.covariance.shape == (len(history.names), len(history.values)) == (0, 0)
    assert np.isnan(history.probability)
    assert history.cutoff_hz is None


@pytest.mark.parametrize(
    "result",
    [Peaks(), Constancy(), Estimate("peaks", **REFUSED, assumptions="")],
    ids=["peaks", "constancy", "estimate"],
)
def test_results_cannot_be_changed(result):
    with pytest.raises(FrozenInstanceError):
        setattr(result, fields(result)[0].name, None)
