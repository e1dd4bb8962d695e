"""The measured angle among runs of a model that are written by hand."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from colonnade.campaign.settings import MeasurementSettings
from colonnade.dynamics.ensemble import LEVELS, Ensemble
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.uncertainty import INPUTS
from colonnade.identification.response.rank import FEWEST
from colonnade.stages.ensemble import EnsembleInputs, measurement_errors
from colonnade.stages.parts import rank as ranking
from colonnade.stages.parts.beginning import Beginning
from colonnade.stages.parts.rank import describe_bands
from colonnade.stages.predict import PredictInputs
from every import every
from prism import PRISM

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
        table=(),
        specimen=("top", "bottom"),
    )


BEGINNING = Beginning(FIRST, 0.0, 0.0, np.zeros(TIME.size), Motion(np.zeros(TIME.size - FIRST), STEP))
CENTRAL = SWING[FIRST:]


def errors_of(measured, **cutoffs):
    return measurement_errors(conditioned(**cutoffs), measured, BEGINNING, inputs())


def rocking(angle=SWING, *, outcome="rocking", error=5e-4, drift=0.0, threshold=1e-3, overturning_time=np.nan):
    """The result of the stage `rocking`, without an angle if none was measured."""
    measured = xr.Dataset(coords={"elapsed": TIME}, attrs={"outcome": outcome})
    if angle is None:
        return measured
    errors = {"rocking_angle_standard_error": error, "rocking_angle_drift": drift, "noise_threshold": threshold}
    return measured.assign(rocking_angle=("elapsed", angle), overturning_time=overturning_time, **errors)


def conditioned(**cutoffs):
    """The result of the stage `condition`: channels with the cut-off (Hz) of each."""
    return xr.Dataset({name: ("elapsed", TIME * 0, {"cutoff_hz": each}) for name, each in cutoffs.items()})


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
    found = measurement_errors(conditioned(), rocking(), released, inputs(free_vibration=True))
    assert (found.start, found.start_error) == (0.1, pytest.approx(5e-4))
    assert found.start_deviation == pytest.approx(np.sqrt((0.005 * 0.1) ** 2 + (5e-4 * ALPHA) ** 2 + 5e-4**2))


def test_the_low_pass_is_the_lowest_of_the_transducers_on_the_specimen():
    channels = {"top": 40.0, "bottom": 25.0}, {"top": 40.0, "table": 5.0}, {"table": 5.0}, {}
    assert [errors_of(rocking(), **cutoffs).cutoff_hz for cutoffs in channels] == [25.0, 40.0, None, None]


def ensemble(members=40, *, overturned=0, widens_at=None, scatter=1e-3):
    """Runs that are the central one and a constant of their own; the band is wide from `widens_at` on."""
    random = np.random.default_rng(3)
    width = np.full(CENTRAL.size, 0.01 * ALPHA)
    if widens_at is not None:
        width[widens_at:] = ALPHA
    bands = CENTRAL + np.linspace(-0.5, 0.5, len(LEVELS))[:, np.newaxis] * width
    drawn = np.tile([1.0 if name in ("clock", "gain") else 0.0 for name in INPUTS], (members, 1))
    peaks = np.linspace(0.1, 0.5, members)
    drawn[:, INPUTS.index("p")] = peaks
    peaks[:overturned] = np.nan
    return Ensemble(
        time=STEP * np.arange(CENTRAL.size),
        central=CENTRAL,
        levels=np.array(LEVELS),
        bands=bands,
        inputs=drawn,
        peak_ratio=peaks,
        overturning_time=np.where(np.arange(members) < overturned, 1.5, np.nan),
        histories=(CENTRAL + random.normal(0, scatter, (members, 1))).astype(np.float32),
    )


def ranked(measured=None, found=None, *, offset=0.0, horizon=0.2):
    measured = rocking() if measured is None else measured
    found = ensemble() if found is None else found
    beginning = replace(BEGINNING, zero_offset=offset)
    starts = np.zeros(found.peak_ratio.size)
    return describe_bands(measured, beginning, found, starts, errors_of(measured), PRISM, horizon * ALPHA)


def test_bands_name_only_the_inputs_that_vary_and_how_the_peak_follows():
    found = ranked()
    assert found["input"].to_numpy().tolist() == ["p"]
    assert found["peak_sensitivity"].to_numpy() == pytest.approx([1.0])


def test_overturning_is_counted_and_timed_on_the_clock_of_the_record():
    found = ranked(found=ensemble(overturned=10))
    assert float(found["overturning_probability"]) == 0.25
    assert 0 < float(found["overturning_probability_low"]) < 0.25 < float(found["overturning_probability_high"]) < 1
    times = found["member_overturning_time"].to_numpy()
    np.testing.assert_allclose(times[:10], 1.5 + TIME[FIRST])
    assert np.isnan(times[10:]).all()


@every(("widens_at", "width", "sample"), [(None, 0.2, -1), (60, 0.2, FIRST + 60), (60, 2.0, -1)])
def test_the_horizon_is_on_the_clock_of_the_record(widens_at, width, sample):
    found = ranked(found=ensemble(widens_at=widens_at), horizon=width)
    assert found["horizon"].item() == pytest.approx(TIME[sample])


def test_a_rank_needs_runs_enough():
    few, enough = (ranked(found=ensemble(members)) for members in (FEWEST - 1, FEWEST))
    assert "measured_distance" not in few
    assert "measured_distance" in enough


def test_without_a_measured_angle_there_is_a_horizon_alone():
    found = ranked(rocking(None))
    assert "horizon" in found
    assert "judged_peak_ratio" not in found


def test_peaks_are_judged_with_the_noise_of_the_measurement():
    """Noise raises the peak of every record of many samples, the measured one's no more than those of the runs."""
    random, noise, ranks = np.random.default_rng(4), 0.02 * ALPHA, []
    for _ in range(20):
        measured = rocking(SWING + random.normal(0, noise, TIME.size), error=noise)
        found = stored(start=FIRST, peaks=ranked(measured)["judged_peak_ratio"].to_numpy())
        ranks.append(row(measured, found)["peak_rank"])
    assert np.mean(ranks) == pytest.approx(0.5, abs=0.2)  # three standard errors of the mean of 20
    peaks = ranked(found=ensemble(overturned=10))["judged_peak_ratio"].to_numpy()
    assert np.isnan(peaks).tolist() == [member < 10 for member in range(40)]


def test_an_angle_like_the_runs_is_among_them_and_a_shifted_one_is_not():
    like, shifted = ranked(), ranked(rocking(SWING + 0.05))
    assert float(like["measured_distance"]) < np.quantile(like["member_distance"], 0.9)
    assert shifted["measured_distance"] > shifted["member_distance"].max()
    assert like["member_distance"].dims == ("judged_member",)


def test_a_zero_offset_is_taken_off_the_measured_angle():
    plain, offset = ranked(), ranked(rocking(SWING + 0.05), offset=0.05)
    assert float(offset["measured_distance"]) == pytest.approx(float(plain["measured_distance"]), rel=1e-6)


@every("changed", [slice(0, FIRST), slice(FIRST + 61, None)])
def test_only_the_time_between_beginning_and_horizon_counts(changed):
    angle = SWING.copy()
    angle[changed] += 0.1
    found = ensemble(widens_at=60)
    assert ranked(rocking(angle), found)["measured_distance"] == ranked(found=found)["measured_distance"]


def test_a_specimen_that_lies_is_held_at_the_critical_angle_that_it_fell_past():
    falls = np.arange(TIME.size) > 210
    angles = np.where(falls, 1.4, SWING), np.where(falls, np.nan, SWING)
    far, lost = (float(ranked(rocking(angle, overturning_time=TIME[211]))["measured_distance"]) for angle in angles)
    assert far == pytest.approx(lost)


PEAKS = np.array([0.1, 0.2, 0.3, 0.4])


def stored(*, peaks=PEAKS, overturned=(), start=0, distance=None):
    """An ensemble as `ensemble` stores it."""
    judged = "judged_member", np.where(np.isin(range(len(peaks)), overturned), np.nan, peaks)
    share = len(overturned) / len(peaks)
    values = {"overturning_probability": share, "horizon": 4.5, "judged_peak_ratio": judged}
    if distance is not None:
        values |= {"measured_distance": distance, "member_distance": ("judged_member", [0.5, 1.0, 1.5, 2.0])}
    return xr.Dataset(values, coords={"elapsed": TIME[start:]})


def row(measured, found):
    compared = ranking.horizons_and_ranks(measured, {"linear": found}, ["linear"], PRISM)
    assert {dimension for dimension, _ in compared.values()} == {"model"}
    return {name: float(values[0]) for name, (_, values) in compared.items()}


def peaked(ratio, **changes):
    """A measured angle whose largest |θ|/α is `ratio`, on the negative side."""
    angle = np.zeros(TIME.size)
    angle[100] = -ratio * ALPHA
    return rocking(angle, **changes)


@every(("ratio", "share"), [(0.05, 0.0), (0.25, 0.5), (0.35, 0.75), (0.9, 1.0)])
def test_the_rank_of_a_peak_is_the_share_of_runs_below_it(ratio, share):
    found = row(peaked(ratio), stored())
    assert found["peak_rank"] == share
    assert (found["horizon"], found["overturning_probability"]) == (4.5, 0.0)


def test_peaks_within_the_noise_are_all_equal():
    assert row(peaked(0.05, threshold=0.35 * ALPHA), stored())["peak_rank"] == pytest.approx(3 / 8)


def test_runs_that_overturn_are_above_every_peak_that_stands():
    found = row(peaked(0.9), stored(overturned=(0, 1)))
    assert (found["peak_rank"], found["overturning_probability"]) == (0.5, 0.5)


@every(("overturned", "share"), [((), 1.0), ((3,), 0.875), ((0, 1, 2, 3), 0.5)])
def test_a_specimen_that_overturned_equals_the_runs_that_did(overturned, share):
    assert row(peaked(0.9, outcome="overturned"), stored(overturned=overturned))["peak_rank"] == share


def test_a_peak_before_the_prediction_begins_does_not_count():
    assert row(peaked(0.9), stored(start=101))["peak_rank"] == 0.0
    assert row(peaked(0.9), stored(start=100))["peak_rank"] == 1.0


def test_missing_samples_do_not_hide_the_peak():
    measured = peaked(0.25)
    measured["rocking_angle"][:50] = np.nan
    assert row(measured, stored())["peak_rank"] == 0.5


@every(("distance", "share"), [(0.1, 0.0), (1.0, 0.375), (1.7, 0.75), (9.0, 1.0)])
def test_the_share_of_closer_runs_is_given_where_distances_are(distance, share):
    assert row(peaked(0.25), stored(distance=distance))["within_spread"] == share
    assert np.isnan(row(peaked(0.25), stored())["within_spread"])


def test_a_model_without_an_ensemble_keeps_its_place():
    compared = ranking.horizons_and_ranks(peaked(0.25), {"linear": stored()}, ["contact", "linear"], PRISM)
    for name, (_, values) in compared.items():
        assert np.isnan(values[0]), name
    assert compared["peak_rank"][1][1] == 0.5
    assert ranking.horizons_and_ranks(peaked(0.25), {}, ["linear"], PRISM) == {}
