"""Bands about a prediction, and whether the measured angle lies within them."""

from copy import deepcopy
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
import xarray as xr

import chain
from colonnade.campaign.settings import MeasurementSettings
from colonnade.dynamics.ensemble import LEVELS, Ensemble
from colonnade.dynamics.motion import Motion
from colonnade.identification.response.rank import is_within
from colonnade.stages import ensemble as running
from colonnade.stages.ensemble import EnsembleInputs, measurement_errors
from colonnade.stages.parts.beginning import Beginning
from colonnade.stages.predict import PredictInputs
from every import every
from prism import PRISM

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
        measured = found[name][1]
        read = running.EnsembleInputs.of(small_campaign, small_campaign.tests[name], model)
        settings = {"members": MEMBERS} | {key: value for key, value in changes.items() if key != "measurement"}
        changed = {"plane": read.plane.model_copy(update=settings)}
        changed["measured"] = read.measured.model_copy(update=changes.get("measurement", {}))
        read = read.model_copy(update=changed)
        measured = measured if rocking is None else rocking
        plans = []

        def runs(plan, central):
            plans.append(plan)
            return running.all_at_once(plan, central)

        pooled = pooled if specimen is None else specimen
        return running.ensemble(measured, read, pooled, run=runs).assign_attrs(plan=plans[0])

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


def test_noise_and_cutoff_are_those_of_the_record_and_a_shaken_block_starts_at_rest(results, ensemble):
    conditioned, _ = results[0]["shake-01"]
    uncertainty, table = ensemble("shake-01").attrs["plan"].uncertainty, conditioned["table_acceleration"].attrs
    assert (uncertainty.noise, uncertainty.cutoff) == (table["noise"], table["cutoff_hz"])
    assert uncertainty.gain > 0.0
    assert uncertainty.theta0 == 0.0


def test_a_free_vibration_varies_with_its_first_angle_and_not_with_the_table(results, ensemble):
    bands = ensemble("free-01")
    uncertainty = bands.attrs["plan"].uncertainty
    assert uncertainty.theta0 > 0.0
    assert (uncertainty.gain, uncertainty.noise, uncertainty.filter) == (0.0, 0.0, 0.0)
    measured = results[0]["free-01"][1]
    assert float(bands["elapsed"][0]) > float(measured["elapsed"][0])
    assert float(bands["overturning_probability"]) == 0.0


@pytest.mark.parametrize("factor", [1.06, 0.94], ids=["larger", "smaller"])
def test_an_angle_that_no_run_has_is_outside(results, ensemble, factor):
    ensemble = partial(ensemble, restitution=5e-4)  # between tests; one free vibration does not show it
    _, rocking = results[0]["shake-01"]
    other = rocking.assign(rocking_angle=factor * rocking["rocking_angle"])
    assert not is_within(float(ensemble("shake-01", rocking=other)["within_spread"]))
    # What the calibration of the transducers leaves open is no misfit of the model.
    open_gain = ensemble("shake-01", rocking=other, measurement={"angle_gain": 0.06})
    assert is_within(float(open_gain["within_spread"]))


def test_runs_of_a_free_vibration_are_measured_to_start_where_it_was_measured(ensemble):
    """A wrong calibration of the angle moves the start too: every run that starts higher is read as lower."""
    assert is_within(float(ensemble("free-01", model="nonlinear")["within_spread"]))


ALPHA = PRISM.critical_angle
STEP = 0.01
TIME = 3.0 + STEP * np.arange(300)
FIRST = 50
"""Sample at which the prediction begins."""
SWING = 0.3 * ALPHA * np.sin(2 * np.pi * 2 * (TIME - TIME[0]))


def inputs(free_vibration=False):
    return EnsembleInputs(
        prediction=PredictInputs(block=PRISM, free_vibration=free_vibration, model="linear", rest_angle=1e-6),
        plane=None,
        contact=None,
        measured=MeasurementSettings(angle_gain=0.005, angle_zero=5e-4),
        filter_order=4,
    )


BEGINNING = Beginning(FIRST, 0.0, 0.0, np.zeros(TIME.size), Motion(np.zeros(TIME.size - FIRST), STEP))
CENTRAL = SWING[FIRST:]


def errors_of(measured):
    return measurement_errors(measured, BEGINNING, inputs())


def rocking(angle=SWING, *, outcome="rocking", error=5e-4, drift=0.0, threshold=1e-3, overturning_time=np.nan):
    """The result of the stage `rocking`, without an angle if none was measured."""
    measured = xr.Dataset(coords={"elapsed": TIME}, attrs={"outcome": outcome})
    if angle is None:
        return measured
    errors = {"rocking_angle_standard_error": error, "rocking_angle_drift": drift, "noise_threshold": threshold}
    return measured.assign(rocking_angle=("elapsed", angle), overturning_time=overturning_time, **errors)


@every(
    ("measured", "noise", "zero"),
    [
        (rocking(), 5e-4, 5e-4 * ALPHA),
        # A drift is an error of the zero, and not once more of the noise.
        (rocking(error=5e-4, drift=3e-4 * np.sqrt(3)), 4e-4, 3e-4),
        (rocking(error=1e-4, drift=1e-3), 0.0, 1e-3 / np.sqrt(3)),
        (rocking(None), 0.0, 5e-4 * ALPHA),
    ],
)
def test_a_measured_angle_has_the_errors_of_its_settings_and_of_its_noise(measured, noise, zero):
    found = errors_of(measured)
    assert (found.interval, found.gain) == (pytest.approx(STEP), 0.005)
    assert (found.noise, found.zero) == (pytest.approx(noise), pytest.approx(zero))
    assert not found.drift.any()
    assert (found.start, found.start_error, found.start_deviation) == (None, 0.0, 0.0)


def test_an_integrated_angle_has_the_deviation_of_its_integration_instead_of_noise():
    deviation = 1e-4 * np.sqrt(TIME - TIME[0])
    found = errors_of(rocking().assign(angle_deviation=("elapsed", deviation)))
    np.testing.assert_array_equal(found.drift, deviation)
    assert found.noise == 0.0


def test_a_start_that_was_measured_is_as_uncertain_as_the_angle():
    released = replace(BEGINNING, theta0=0.1)
    found = measurement_errors(rocking(), released, inputs(free_vibration=True))
    assert (found.start, found.start_error) == (0.1, pytest.approx(5e-4))
    assert found.start_deviation == pytest.approx(np.sqrt((0.005 * 0.1) ** 2 + (5e-4 * ALPHA) ** 2 + 5e-4**2))


def ensemble_of(members=40, *, overturned=(), scatter=1e-3, peaks=None):
    """Runs that are the central one and a constant of their own, or reach a peak of their own (in α) once."""
    offsets = np.random.default_rng(3).normal(0, scatter, (members, 1))
    histories = CENTRAL + offsets
    if peaks is not None:
        members, histories = len(peaks), np.zeros((len(peaks), CENTRAL.size))
        histories[:, 50] = ALPHA * np.array(peaks)
    return Ensemble(
        time=STEP * np.arange(CENTRAL.size),
        central=CENTRAL,
        levels=np.array(LEVELS),
        bands=np.tile(CENTRAL, (len(LEVELS), 1)),
        inputs=np.zeros((members, 7)),
        peak_ratio=np.zeros(members),
        overturning_time=np.where(np.isin(np.arange(members), overturned), 0.5, np.nan),
        histories=histories.astype(np.float32),
    )


EXACT = {"gain": 0.0, "zero": 0.0, "noise": 0.0}


def ranked(measured, found=None, *, offset=0.0, horizon=TIME[-1], **errors):
    known = replace(errors_of(measured), **errors).thinned(FIRST, 1)
    found = ensemble_of() if found is None else found
    beginning = replace(BEGINNING, zero_offset=offset)
    return running.ranks(measured.isel(elapsed=slice(FIRST, None)), beginning, found, known, PRISM, horizon)


def test_peaks_are_judged_with_the_noise_of_the_measurement():
    """Noise raises the peak of every record of many samples, the measured one's no more than those of the runs."""
    random, noise = np.random.default_rng(4), 0.02 * ALPHA
    found = [rocking(SWING + random.normal(0, noise, TIME.size), error=noise) for _ in range(20)]
    ranks = [ranked(measured)["peak_rank"] for measured in found]
    assert np.mean(ranks) == pytest.approx(0.5, abs=0.2)  # three standard errors of the mean of 20


def test_an_angle_like_the_runs_is_among_them_and_a_shifted_one_is_not_unless_that_is_its_zero():
    assert is_within(ranked(rocking())["within_spread"])
    shifted = rocking(SWING + 0.05)
    assert ranked(shifted)["within_spread"] == 1.0
    assert is_within(ranked(shifted, offset=0.05)["within_spread"])


def test_a_specimen_that_lies_is_held_at_the_critical_angle_that_it_fell_past():
    falls = np.arange(TIME.size) > 210
    angles = np.where(falls, 1.4, SWING), np.where(falls, np.nan, SWING)
    found = ensemble_of(scatter=0.1)
    far, lost = (ranked(rocking(angle, overturning_time=TIME[211]), found)["within_spread"] for angle in angles)
    assert far == lost


PEAKS = [0.1, 0.2, 0.3, 0.4]


def peak_rank(ratio, overturned=(), at=100, **changes):
    """The rank of a measured angle whose largest |θ|/α is `ratio`, on the negative side, among `PEAKS`."""
    angle = np.zeros(TIME.size)
    angle[:50], angle[at] = np.nan, -ratio * ALPHA
    return ranked(rocking(angle, **changes), ensemble_of(peaks=PEAKS, overturned=overturned), **EXACT)["peak_rank"]


@every(
    ("ratio", "overturned", "outcome", "share"),
    [
        *((ratio, (), "rocking", share) for ratio, share in ((0.05, 0.0), (0.25, 0.5), (0.35, 0.75), (0.9, 1.0))),
        (0.9, (0, 1), "rocking", 0.5),  # runs that overturn are above every peak that stands
        *((0.9, fell, "overturned", share) for fell, share in (((), 1.0), ((3,), 0.875), ((0, 1, 2, 3), 0.5))),
    ],
)
def test_the_rank_of_a_peak_is_the_share_of_runs_below_it(ratio, overturned, outcome, share):
    assert peak_rank(ratio, overturned, outcome=outcome) == share


def test_a_peak_before_the_prediction_begins_does_not_count():
    assert (peak_rank(0.9, at=FIRST - 1), peak_rank(0.9, at=FIRST)) == (0.0, 1.0)
