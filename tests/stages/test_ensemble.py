"""Bands about a prediction, and whether the measured angle lies within them."""

from copy import deepcopy
from functools import partial

import numpy as np
import pytest

import chain
from colonnade.dynamics.uncertainty import INPUTS
from colonnade.identification.response.rank import is_within, rank
from colonnade.stages import ensemble as running

MEMBERS = 60


@pytest.fixture
def results(small_campaign, conditioned_and_measured):
    """Conditioned and rocking of both tests, and the pooled specimen."""
    found = deepcopy(conditioned_and_measured)
    identified = chain.identified(small_campaign, found["free-01"][1])
    return found, chain.pooled(small_campaign, {"free-01": identified})


@pytest.fixture
def ensemble(small_campaign, results):
    def run(name, model="linear", specimen=None, rocking=None, **changes):
        found, pooled = results
        conditioned, measured = found[name]
        read = running.EnsembleInputs.of(small_campaign, small_campaign.tests[name], model)
        settings = {"members": MEMBERS} | {key: value for key, value in changes.items() if key != "measurement"}
        changed = {"plane": read.plane.model_copy(update=settings)}
        changed["measured"] = read.measured.model_copy(update=changes.get("measurement", {}))
        read = read.model_copy(update=changed)
        measured = measured if rocking is None else rocking
        return running.ensemble(conditioned, measured, read, pooled if specimen is None else specimen)

    return run


def test_the_bands_lie_about_the_prediction_on_its_clock(small_campaign, results, ensemble):
    (_, rocking), pooled = results[0]["shake-01"], results[1]
    predicted = chain.predicted(small_campaign, "shake-01", rocking, pooled)
    bands = ensemble("shake-01")
    np.testing.assert_array_equal(bands["elapsed"], predicted["elapsed"])
    np.testing.assert_array_equal(bands["rocking_angle"], predicted["rocking_angle"])
    low, median, high = (bands["rocking_angle_band"].sel(quantile=level) for level in (0.025, 0.5, 0.975))
    assert (low <= high).all()
    assert float((high - low).max()) > 1e-3
    assert float(np.abs(median - bands["rocking_angle"]).mean()) < 0.3 * float((high - low).mean())


def test_noise_and_cutoff_are_those_of_the_record(results, ensemble):
    conditioned, _ = results[0]["shake-01"]
    bands = ensemble("shake-01")
    table = conditioned["table_acceleration"].attrs
    assert bands.attrs["noise"] == table["noise"]
    assert bands.attrs["cutoff_hz"] == table["cutoff_hz"]
    assert set(bands["input"].to_numpy()) == set(INPUTS) - {"theta0"}


def test_a_free_vibration_varies_with_its_first_angle_and_not_with_the_table(results, ensemble):
    bands = ensemble("free-01")
    assert set(bands["input"].to_numpy()) == {"restitution", "critical_angle", "p", "clock", "theta0"}
    measured = results[0]["free-01"][1]
    assert float(bands["elapsed"][0]) > float(measured["elapsed"][0])
    assert float(bands["overturning_probability"]) == 0.0


def test_the_measured_angle_is_within_the_spread_of_the_model_that_it_follows(small_campaign, results, ensemble):
    bands = ensemble("shake-01")
    compared = compare(small_campaign, results, bands)
    assert is_within(float(compared["within_spread"]))
    assert float(compared["within_spread"]) == rank(float(bands["measured_distance"]), bands["member_distance"].values)
    assert 0.02 < float(compared["peak_rank"]) < 0.98
    assert float(compared["overturning_probability"]) == 0.0


@pytest.mark.parametrize("factor", [1.06, 0.94], ids=["larger", "smaller"])
def test_an_angle_that_no_run_has_is_outside(small_campaign, results, ensemble, factor):
    ensemble = partial(ensemble, restitution=5e-4)  # between tests; one free vibration does not show it
    _, rocking = results[0]["shake-01"]
    other = rocking.assign(rocking_angle=factor * rocking["rocking_angle"])
    compared = compare(small_campaign, results, ensemble("shake-01", rocking=other), other)
    assert not is_within(float(compared["within_spread"]))
    # What the calibration of the transducers leaves open is no misfit of the model.
    known = ensemble("shake-01", rocking=other)
    open_gain = ensemble("shake-01", rocking=other, measurement={"angle_gain": 0.06})
    assert is_within(float(compare(small_campaign, results, open_gain, other)["within_spread"]))
    assert float(open_gain["measured_distance"]) < float(known["measured_distance"])


def test_runs_of_a_free_vibration_are_measured_to_start_where_it_was_measured(ensemble):
    """A wrong calibration of the angle moves the start too: every run that starts higher is read as lower."""
    bands = ensemble("free-01", model="nonlinear")
    assert is_within(rank(float(bands["measured_distance"]), bands["member_distance"].values))


def compare(campaign, results, ensemble, rocking=None):
    found, pooled = results
    rocking = found["shake-01"][1] if rocking is None else rocking
    predicted = chain.predicted(campaign, "shake-01", rocking, pooled)
    return chain.compared(campaign, "shake-01", rocking, {"linear": predicted}, {"linear": ensemble}).isel(model=0)
