"""From the rocking angle to prediction and comparison."""

import numpy as np
import pytest

import chain
from colonnade.errors import StageError
from colonnade.stages.parts.beginning import begin
from colonnade.stages.predict import PredictInputs
from every import every


@pytest.fixture
def rocked(conditioned_and_measured):
    """The rocking angle of each test."""
    return {name: result.copy(deep=True) for name, (_, result) in conditioned_and_measured.items()}


@pytest.fixture
def pooled(small_campaign, rocked):
    return chain.pooled(small_campaign, {"free-01": chain.identified(small_campaign, rocked["free-01"])})


def test_the_prediction_on_the_recorded_motion_is_the_true_history(small_campaign, rocked, pooled):
    predicted = chain.predicted(small_campaign, "shake-01", rocked["shake-01"], pooled)
    assert predicted.attrs["outcome"] == "rocking"
    assert predicted.attrs["restitution_source"] == "identified"
    compared = chain.compared(small_campaign, "shake-01", rocked["shake-01"], {"linear": predicted})
    assert float(compared["nrmse"][0]) < 0.01
    assert abs(float(compared["peak_ratio_error"][0])) < 0.01
    assert compared.attrs["warnings"] == []


def test_a_free_vibration_is_predicted_from_its_first_peak_on(small_campaign, rocked, pooled):
    predicted = chain.predicted(small_campaign, "free-01", rocked["free-01"], pooled, "nonlinear")
    angle = predicted["rocking_angle"].to_numpy()
    begins = int(np.argmax(np.isfinite(angle)))
    assert np.isnan(angle[:begins]).all()
    assert 1.0 < float(predicted["elapsed"][begins]) < 2.0
    compared = chain.compared(small_campaign, "free-01", rocked["free-01"], {"nonlinear": predicted})
    assert float(compared["nrmse"][0]) < 0.01
    # The release itself, which is larger, is not part of the prediction.
    assert abs(float(compared["peak_ratio_error"][0])) < 0.005


def test_a_free_vibration_whose_peak_is_no_angle_of_a_block_is_refused_with_what_to_check(small_campaign, rocked):
    degrees = rocked["free-01"].assign(rocking_angle=np.rad2deg(rocked["free-01"]["rocking_angle"]))
    read = PredictInputs.of(small_campaign, small_campaign.tests["free-01"], "linear")
    with pytest.raises(StageError, match=r"first peak .* rad; less than a right angle was expected\. Check unit"):
        begin(degrees, read)


def test_a_tilted_table_is_felt_as_a_base_acceleration_the_other_way(small_campaign, rocked, pooled):
    block = small_campaign.block("prism")
    tilt = 0.3 * block.critical_angle
    level = chain.predicted(small_campaign, "shake-01", rocked["shake-01"], pooled)
    tilted = chain.predicted(small_campaign, "shake-01", rocked["shake-01"], pooled, tilt=tilt)
    pushed = rocked["shake-01"].copy()
    pushed["base_acceleration"] = pushed["base_acceleration"] - block.gravity * np.sin(tilt)
    other = chain.predicted(small_campaign, "shake-01", pushed, pooled)
    np.testing.assert_array_equal(tilted["rocking_angle"], other["rocking_angle"])
    # With its +x side lower the specimen leans, and rocks further, to θ > 0.
    assert float(tilted["rocking_angle"].max()) > float(level["rocking_angle"].max())
    np.testing.assert_array_equal(tilted["base_acceleration"], level["base_acceleration"])


def predicted_with(campaign, recording, pooled, *, damage=None):
    _, rocking = chain.measured(campaign, "shake-01", {"main": recording})
    return chain.predicted(campaign, "shake-01", rocking if damage is None else damage(rocking), pooled)


def test_a_recorded_vertical_motion_is_part_of_the_prediction(shaken_upwards, pooled):
    campaign, recording, angle = shaken_upwards
    given = pooled.assign(side_restitution=0 * pooled["side_restitution"] + 0.93)
    predicted = predicted_with(campaign, recording, given)
    without = predicted_with(campaign, recording, given, damage=_without)
    assert predicted.attrs["warnings"] == []
    errors = [np.sqrt(np.mean((each["rocking_angle"].to_numpy() - angle) ** 2)) for each in (predicted, without)]
    assert errors[0] < 0.01 * campaign.block("prism").critical_angle
    assert errors[1] > 10 * errors[0]


VERTICAL = "vertical_base_acceleration"


def _without(found):
    return found.drop_vars(VERTICAL)


def _with_gap(found):
    found[VERTICAL][1000:1010] = np.nan
    return found


@every("damage", [_with_gap, lambda found: found.assign({VERTICAL: 5 * found[VERTICAL]})])
def test_without_a_usable_vertical_motion_a_prediction_goes_on_and_says_so(shaken_upwards, pooled, damage):
    campaign, recording, _ = shaken_upwards
    predicted = predicted_with(campaign, recording, pooled, damage=damage)
    without = predicted_with(campaign, recording, pooled, damage=_without)
    (told,) = predicted.attrs["warnings"]
    assert "along z" in told.text
    assert "misses samples or would lift the specimen off the table" in told.text
    np.testing.assert_array_equal(predicted["rocking_angle"], without["rocking_angle"])
    assert without.attrs["warnings"] == []


@every(("share", "told"), [(0.09, ""), (0.12, " along x). That is left out: models in the plane take none along y")])
def test_motion_across_is_left_out_and_told_where_it_is_not_small(small_campaign, rocked, pooled, share, told):
    base = rocked["shake-01"]["base_acceleration"]
    across = rocked["shake-01"].assign(transverse_base_acceleration=share * base)
    warnings = chain.predicted(small_campaign, "shake-01", across, pooled).attrs["warnings"]
    assert len(warnings) == bool(told)
    assert told in " ".join(map(str, warnings))
