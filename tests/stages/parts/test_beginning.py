"""What a free vibration's prediction starts from, what drives it, and what it is held against."""

import numpy as np
import pytest

import chain
from chain import measured
from colonnade.dynamics.block import Block
from colonnade.identification.response.rank import is_within, rank
from colonnade.identification.restitution.arcs.arcs import find_impacts
from colonnade.stages import ensemble as running
from colonnade.stages.parts.beginning import AT_REST, NOT_RECORDED, RECORDED

RELEASE = 1.0
"""s, when a specimen is let go, of 0.5 α."""

E = 0.976
ALPHA = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10).critical_angle


@pytest.fixture
def specimen(small_campaign):
    return chain.pooled(small_campaign, {}, given=E)


def predicted(campaign, rocking, specimen, free=None):
    return chain.predicted(campaign, "free-01", rocking, specimen, "nonlinear", free)


def compared(campaign, rocking, prediction):
    return chain.compared(campaign, "free-01", rocking, {"nonlinear": prediction})


def late(prediction, time, angle):
    """RMS of the times by which the predicted impacts differ from the true ones, s."""
    begins = float(prediction["elapsed"][int(np.argmax(np.isfinite(prediction["rocking_angle"].to_numpy())))])
    true = find_impacts(time[time > begins], angle[time > begins], lowest=0.02 * ALPHA)
    found = prediction["impact_time"].to_numpy()[: true.size]
    return float(np.sqrt(np.mean((found - true[: found.size]) ** 2)))


@pytest.mark.parametrize("offset", [0.002, -0.002], ids=["too high", "too low"])
def test_a_prediction_from_the_true_zero_keeps_time_better(small_campaign, released, specimen, offset):
    recordings, time, angle = released(E)
    _, rocking = measured(small_campaign, "free-01", recordings)
    shifted = rocking.assign(rocking_angle=rocking["rocking_angle"] + offset * ALPHA)
    identified = chain.identified(small_campaign, shifted)
    assert float(identified["zero_offset"]) == pytest.approx(offset * ALPHA, abs=1e-4 * ALPHA)

    without = predicted(small_campaign, shifted, specimen)
    prediction = predicted(small_campaign, shifted, specimen, identified)
    assert float(prediction["zero_offset"]) == float(identified["zero_offset"])
    assert late(prediction, time, angle) < 0.25 * late(without, time, angle)

    # The misfit is that of two angles about one zero.
    misfits = [compared(small_campaign, shifted, each) for each in (without, prediction)]
    assert float(misfits[1]["nrmse"][0]) < 0.25 * float(misfits[0]["nrmse"][0])
    assert float(misfits[1]["zero_offset"]) == float(identified["zero_offset"])
    true_peak = np.abs(angle[time > float(misfits[1]["measured_peak_time"]) - 0.01]).max() / ALPHA
    assert float(misfits[1]["measured_peak_ratio"]) == pytest.approx(true_peak, abs=5e-4)


@pytest.mark.parametrize("every", [5, 8], ids=["100 Hz", "62.5 Hz"])
def test_a_prediction_from_a_peak_between_two_samples_is_not_late(small_campaign, released, specimen, every):
    """Started at rest at the next sample, it would be late by up to a sampling interval, here 10 and 16 ms."""
    recordings, time, angle = released(E)
    _, rocking = measured(small_campaign, "free-01", recordings)
    lateness = []
    for shift in range(0, every, 2):
        prediction = predicted(small_campaign, rocking.isel(elapsed=slice(shift, None, every)), specimen)
        begins = float(prediction["elapsed"][int(np.argmax(np.isfinite(prediction["rocking_angle"].to_numpy())))])
        true = find_impacts(time[time > begins], angle[time > begins], lowest=0.02 * ALPHA)
        lateness.append(float(prediction["impact_time"][0]) - true[0])
    assert np.abs(lateness).max() < 0.15 * every * float(time[1])


def test_a_wrong_zero_that_is_identified_leaves_a_true_model_within_its_spread(small_campaign, released, specimen):
    ready, rocking = measured(small_campaign, "free-01", released(E)[0])
    shifted = rocking.assign(rocking_angle=rocking["rocking_angle"] + 0.02 * ALPHA)
    identified = chain.identified(small_campaign, shifted)
    read = running.EnsembleInputs.of(small_campaign, small_campaign.tests["free-01"], "nonlinear")
    read = read.model_copy(update={"settings": read.settings.model_copy(update={"members": 40})})
    ranks = [
        rank(float(bands["measured_distance"]), bands["member_distance"].to_numpy())
        for bands in (running.ensemble(ready, shifted, specimen, read, each) for each in (None, identified))
    ]
    assert [is_within(each) for each in ranks] == [False, True]


def test_a_zero_offset_of_a_restitution_that_was_refused_is_not_used(small_campaign, released, specimen):
    _, rocking = measured(small_campaign, "free-01", released(E)[0])
    refused = chain.identified(small_campaign, rocking).assign(restitution=((), np.nan), zero_offset=((), 0.01))
    assert float(predicted(small_campaign, rocking, specimen, refused)["zero_offset"]) == 0.0


def test_a_measured_peak_is_that_of_the_time_that_is_predicted(small_campaign, released, specimen):
    _, rocking = measured(small_campaign, "free-01", released(E, overshoot=0.05)[0])
    prediction = predicted(small_campaign, rocking, specimen)
    result = compared(small_campaign, rocking, prediction)
    after_the_first_impact = float(prediction["peak_ratio"])
    assert after_the_first_impact < 0.5
    assert float(result["measured_peak_ratio"]) == pytest.approx(after_the_first_impact, abs=1e-3)
    assert float(result["measured_peak_time"]) > RELEASE
    assert float(rocking["peak_ratio"]) == pytest.approx(0.55, abs=1e-3)
    assert float(result["release_ratio"]) == pytest.approx(0.5, abs=1e-3)
    assert float(result["peak_ratio_error"][0]) == pytest.approx(0.0, abs=1e-3)


def test_a_table_that_moves_drives_the_prediction_of_a_free_vibration(small_campaign, released, specimen):
    _, rocking = measured(small_campaign, "free-01", released(E, 0.05)[0])
    prediction = predicted(small_campaign, rocking, specimen)
    assert prediction.attrs["driven_by"] == RECORDED
    np.testing.assert_array_equal(prediction["base_acceleration"], rocking["base_acceleration"])
    unmoved = predicted(small_campaign, rocking.drop_vars("base_acceleration"), specimen)
    assert unmoved.attrs["driven_by"] == NOT_RECORDED
    driven, free = (float(compared(small_campaign, rocking, each)["nrmse"][0]) for each in (prediction, unmoved))
    assert driven < 0.02
    assert free > 5 * driven


def test_the_noise_of_an_accelerometer_moves_no_table(small_campaign, released, specimen):
    _, rocking = measured(small_campaign, "free-01", released(E)[0])
    assert float(rocking["base_acceleration"].std()) > 0.0
    prediction = predicted(small_campaign, rocking, specimen)
    assert prediction.attrs["driven_by"] == AT_REST
    assert not prediction["base_acceleration"].to_numpy().any()
    without = predicted(small_campaign, rocking.drop_vars("base_acceleration"), specimen)
    np.testing.assert_array_equal(prediction["rocking_angle"], without["rocking_angle"])


def test_it_is_driven_as_its_restitution_is(small_campaign, released, specimen):
    _, rocking = measured(small_campaign, "free-01", released(E)[0])
    base = rocking["base_acceleration"]
    noisy = rocking.assign(base_acceleration=base.copy(data=np.random.default_rng(1).normal(0.0, 0.2, base.size)))
    identified = chain.identified(small_campaign, noisy)
    assert np.isfinite(float(identified["restitution"]))
    assert predicted(small_campaign, noisy, specimen, identified).attrs["driven_by"] == AT_REST
    assert predicted(small_campaign, noisy, specimen).attrs["driven_by"] == RECORDED


@pytest.mark.parametrize(("share", "varied"), [(0.0, False), (0.05, True)], ids=["at rest", "moving"])
def test_an_ensemble_varies_the_base_motion_only_if_it_drives(small_campaign, released, specimen, share, varied):
    ready, rocking = measured(small_campaign, "free-01", released(E, share)[0])
    read = running.EnsembleInputs.of(small_campaign, small_campaign.tests["free-01"], "linear")
    read = read.model_copy(update={"settings": read.settings.model_copy(update={"members": 4})})
    bands = running.ensemble(ready, rocking, specimen, read)
    deviations = bands["input_deviation"].sel(input="gain") if "gain" in bands["input"] else 0.0
    assert (float(deviations) > 0.0) == varied
    assert (bands.attrs["noise"] > 0.0) == varied
