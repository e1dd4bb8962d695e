"""From the rocking angle to restitution, prediction and comparison."""

import re

import numpy as np
import pytest

from colonnade.errors import StageError
from colonnade.stages import compare as comparing
from colonnade.stages import condition as conditioning
from colonnade.stages import ingest as ingesting
from colonnade.stages import predict as predicting
from colonnade.stages import restitution as identifying
from colonnade.stages import rocking as rocking_stage
from colonnade.stages import specimen as pooling
from colonnade.stages.parts.beginning import begin


@pytest.fixture
def measured(conditioned_and_measured):
    return {name: result.copy(deep=True) for name, (_, result) in conditioned_and_measured.items()}


@pytest.fixture
def identified(small_campaign, measured):
    read = identifying.RestitutionInputs.of(small_campaign, small_campaign.tests["free-01"])
    return identifying.restitution(measured["free-01"], read)


@pytest.fixture
def pooled(small_campaign, identified):
    return pooling.specimen({"free-01": identified}, pooling.SpecimenInputs.of(small_campaign, "prism"))


def test_restitution_of_a_free_vibration_is_the_true_one(identified):
    assert float(identified["restitution"]) == pytest.approx(0.93, abs=5e-4)
    assert identified.attrs["reason"] == ""
    used = identified["peak_used"].to_numpy() == 1
    fitted, seen = identified["fitted_angle"].to_numpy()[used], identified["peak_angle"].to_numpy()[used]
    np.testing.assert_allclose(fitted, seen, atol=2e-4)


def test_the_whole_history_agrees_with_the_peaks_and_stands_beside_them(identified):
    assert identified["model"].to_numpy().tolist() == ["linear", "nonlinear"]
    nonlinear = identified.sel(model="nonlinear")  # the truth's own model
    assert float(nonlinear["restitution_history"]) == pytest.approx(0.93, abs=3e-4)
    assert float(nonlinear["restitution_history_low"]) < float(nonlinear["restitution_history"])
    assert float(nonlinear["restitution_history_residual"]) < 1e-3 * 0.186
    assert float(identified.sel(model="linear")["restitution_history"]) == pytest.approx(0.93, abs=2e-3)
    assert identified.attrs["history_reason"] == ""
    assert identified.attrs["warnings"] == []


def test_a_whole_history_that_disagrees_with_the_peaks_is_warned_of(small_campaign, measured):
    read = identifying.RestitutionInputs.of(small_campaign, small_campaign.tests["free-01"])
    block = read.block.override(inertia=1.05 * read.block.inertia)
    result = identifying.restitution(measured["free-01"], read.model_copy(update={"block": block}))
    assert float(result["restitution"]) == pytest.approx(0.93, abs=1e-3)
    assert any("standard errors apart" in warning.text for warning in result.attrs["warnings"])


def test_a_record_without_peaks_gives_a_reason_and_no_number(small_campaign, measured):
    still = measured["free-01"].assign(rocking_angle=measured["free-01"]["rocking_angle"] * 0)
    result = identifying.restitution(
        still, identifying.RestitutionInputs.of(small_campaign, small_campaign.tests["free-01"])
    )
    assert np.isnan(float(result["restitution"]))
    assert "the record has 0" in result.attrs["reason"]
    assert result.attrs["warnings"]
    assert np.isnan(result["restitution_history"]).all()
    assert "No value to start from" in result.attrs["history_reason"]


def test_a_free_vibration_without_transducers_is_refused(small_campaign, measured):
    read = identifying.RestitutionInputs.of(small_campaign, small_campaign.tests["free-01"])
    with pytest.raises(StageError, match="no restitution"):
        identifying.restitution(measured["free-01"].drop_vars("rocking_angle"), read)


def test_the_restitution_given_comes_before_the_identified_before_the_rigid_one(small_campaign, identified):
    read = pooling.SpecimenInputs.of(small_campaign, "prism")
    given = pooling.specimen({"free-01": identified}, read.model_copy(update={"given": (0.8, 0.9)}))
    assert given.attrs["restitution_source"] == "given"
    assert given["side_restitution"].to_numpy().tolist() == [0.8, 0.9]
    found = pooling.specimen({"free-01": identified}, read)
    assert found.attrs["restitution_source"] == "identified"
    assert found["test_id"].to_numpy().tolist() == ["free-01"]
    rigid = pooling.specimen({}, read)
    assert rigid.attrs["restitution_source"] == "rigid-body"
    assert float(rigid["restitution"]) == pytest.approx(0.94848, abs=1e-5)
    assert "no free vibration" in rigid.attrs["reason"]
    assert (given.attrs["warnings"], found.attrs["warnings"]) == ([], [])
    (told,) = rigid.attrs["warnings"]
    assert (told.severity, told.kind) == ("note", "rigid-body e")
    refused = identified.assign(restitution=np.nan).assign_attrs(reason="the peaks do not decay")
    (told,) = pooling.specimen({"free-01": refused}, read).attrs["warnings"]
    assert told.severity == "warning"
    assert "Predictions use the rigid body's e, 0.9485, because none of its free vibrations gives one" in told.text


def test_the_prediction_on_the_recorded_motion_is_the_true_history(small_campaign, measured, pooled):
    test = small_campaign.tests["shake-01"]
    predicted = predicting.predict(
        measured["shake-01"], pooled, predicting.PredictInputs.of(small_campaign, test, "linear")
    )
    assert predicted.attrs["outcome"] == "rocking"
    assert predicted.attrs["restitution_source"] == "identified"
    compared = comparing.compare(
        measured["shake-01"], {"linear": predicted}, comparing.CompareInputs.of(small_campaign, test)
    )
    assert float(compared["nrmse"][0]) < 0.01
    assert abs(float(compared["peak_ratio_error"][0])) < 0.01
    assert compared["predicted_outcome"].to_numpy().tolist() == ["rocking"]
    assert compared.attrs["warnings"] == []


def test_a_free_vibration_is_predicted_from_its_first_peak_on(small_campaign, measured, pooled):
    test = small_campaign.tests["free-01"]
    predicted = predicting.predict(
        measured["free-01"], pooled, predicting.PredictInputs.of(small_campaign, test, "nonlinear")
    )
    angle = predicted["rocking_angle"].to_numpy()
    begins = int(np.argmax(np.isfinite(angle)))
    assert np.isnan(angle[:begins]).all()
    assert 1.0 < float(predicted["elapsed"][begins]) < 2.0
    compared = comparing.compare(
        measured["free-01"], {"nonlinear": predicted}, comparing.CompareInputs.of(small_campaign, test)
    )
    assert float(compared["nrmse"][0]) < 0.01
    # The release itself, which is larger, is not part of the prediction.
    assert abs(float(compared["peak_ratio_error"][0])) < 0.005


def test_an_outcome_that_the_log_contradicts_is_warned_of(small_campaign, measured, pooled):
    test = small_campaign.tests["shake-01"]
    predicted = predicting.predict(
        measured["shake-01"], pooled, predicting.PredictInputs.of(small_campaign, test, "linear")
    )
    read = comparing.CompareInputs.of(small_campaign, test).model_copy(update={"observed_outcome": "overturned"})
    compared = comparing.compare(measured["shake-01"], {"linear": predicted}, read)
    assert "the test log says overturned" in compared.attrs["warnings"][0].text


def test_a_test_without_transducers_is_compared_by_its_observed_outcome(small_campaign, measured, pooled):
    test = small_campaign.tests["shake-01"]
    bare = measured["shake-01"].drop_vars(
        [name for name in measured["shake-01"] if str(name).startswith(("rock", "peak_r"))]
    )
    bare.attrs["outcome"] = ""
    predicted = predicting.predict(bare, pooled, predicting.PredictInputs.of(small_campaign, test, "linear"))
    compared = comparing.compare(bare, {"linear": predicted}, comparing.CompareInputs.of(small_campaign, test))
    assert compared.attrs["outcome_measured"] == "not-overturned"
    assert np.isnan(float(compared["nrmse"][0]))


def test_a_base_motion_with_a_hole_is_refused_with_its_place(small_campaign, measured, pooled):
    broken = measured["shake-01"].copy(deep=True)
    broken["base_acceleration"][1000:1010] = np.nan
    read = predicting.PredictInputs.of(small_campaign, small_campaign.tests["shake-01"], "linear")
    with pytest.raises(StageError, match=r"is missing 10 of \d+ samples, the first at 2\.000 s"):
        predicting.predict(broken, pooled, read)
    with pytest.raises(StageError, match="table's motion along x was not recorded"):
        predicting.predict(broken.drop_vars("base_acceleration"), pooled, read)


def test_a_free_vibration_whose_peak_is_no_angle_of_a_block_is_refused_with_what_to_check(small_campaign, measured):
    degrees = measured["free-01"].assign(rocking_angle=np.rad2deg(measured["free-01"]["rocking_angle"]))
    read = predicting.PredictInputs.of(small_campaign, small_campaign.tests["free-01"], "linear")
    with pytest.raises(StageError, match=r"first peak .* rad; less than a right angle was expected\. Check unit"):
        begin(degrees, read)


def test_a_tilted_table_is_felt_as_a_base_acceleration_the_other_way(small_campaign, measured, pooled):
    read = predicting.PredictInputs.of(small_campaign, small_campaign.tests["shake-01"], "linear")
    tilt = 0.3 * read.block.critical_angle
    level = predicting.predict(measured["shake-01"], pooled, read)
    tilted = predicting.predict(measured["shake-01"], pooled, read.model_copy(update={"tilt": tilt}))
    pushed = measured["shake-01"].copy()
    pushed["base_acceleration"] = pushed["base_acceleration"] - read.block.gravity * np.sin(tilt)
    other = predicting.predict(pushed, pooled, read)
    np.testing.assert_array_equal(tilted["rocking_angle"], other["rocking_angle"])
    # With its +x side lower the specimen leans, and rocks further, to θ > 0.
    assert float(tilted["rocking_angle"].max()) > float(level["rocking_angle"].max())
    np.testing.assert_array_equal(tilted["base_acceleration"], level["base_acceleration"])


def predicted_with(campaign, recording, pooled, *, damage=None):
    test = campaign.tests["shake-01"]
    found = ingesting.ingest({"main": recording}, ingesting.IngestInputs.of(campaign, test))
    ready = conditioning.condition(found, conditioning.ConditionInputs.of(campaign, test))
    measured = rocking_stage.rocking(ready, rocking_stage.RockingInputs.of(campaign, test))
    if damage is not None:
        measured = damage(measured)
    return predicting.predict(measured, pooled, predicting.PredictInputs.of(campaign, test, "linear"))


def test_a_recorded_vertical_motion_is_part_of_the_prediction(shaken_upwards, pooled):
    campaign, recording, angle = shaken_upwards
    given = pooled.assign(side_restitution=0 * pooled["side_restitution"] + 0.93)
    predicted = predicted_with(campaign, recording, given)
    without = predicted_with(campaign, recording, given, damage=lambda found: found.drop_vars(VERTICAL))
    assert predicted.attrs["warnings"] == []
    errors = [np.sqrt(np.mean((each["rocking_angle"].to_numpy() - angle) ** 2)) for each in (predicted, without)]
    assert errors[0] < 0.01 * campaign.block("prism").critical_angle
    assert errors[1] > 10 * errors[0]


VERTICAL = "vertical_base_acceleration"


def _with_gap(found):
    found[VERTICAL][1000:1010] = np.nan
    return found


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (_with_gap, r"is missing 10 of \d+ samples, the first at 2\.000 s: predicted without it"),
        (lambda found: found.assign({VERTICAL: 0 * found[VERTICAL]}), "accelerometer is dead"),
        (lambda found: found.assign({VERTICAL: 5 * found[VERTICAL]}), "the specimen would leave the table"),
        (lambda found: found.drop_vars(VERTICAL), "No channel of the table's vertical acceleration is usable"),
    ],
    ids=["a gap", "a dead channel", "a gain that is wrong", "a channel that was given up"],
)
def test_without_a_usable_vertical_motion_a_prediction_goes_on_and_says_so(shaken_upwards, pooled, damage, words):
    campaign, recording, _ = shaken_upwards
    predicted = predicted_with(campaign, recording, pooled, damage=damage)
    without = predicted_with(campaign, recording, pooled, damage=lambda found: found.drop_vars(VERTICAL))
    assert len(predicted.attrs["warnings"]) == 1
    assert re.search(words, predicted.attrs["warnings"][0].text)
    np.testing.assert_array_equal(predicted["rocking_angle"], without["rocking_angle"])


@pytest.mark.parametrize(
    ("share", "told"), [(0.09, []), (0.5, ["50\u00a0% of that along x"])], ids=["a little", "much"]
)
def test_motion_across_is_left_out_and_told_where_it_is_not_small(small_campaign, measured, pooled, share, told):
    base = measured["shake-01"]["base_acceleration"]
    across = measured["shake-01"].assign(transverse_base_acceleration=share * base)
    read = predicting.PredictInputs.of(small_campaign, small_campaign.tests["shake-01"], "linear")
    warnings = predicting.predict(across, pooled, read).attrs["warnings"]
    assert len(warnings) == len(told)
    assert all(words in warning.text for words, warning in zip(told, warnings, strict=True))


def test_an_ensemble_is_driven_by_the_vertical_motion_too(shaken_upwards, measured):
    campaign, _, _ = shaken_upwards
    vertical = 0.2 * measured["shake-01"]["base_acceleration"]
    read = predicting.PredictInputs.of(campaign, campaign.tests["shake-01"], "linear")
    beginning = begin(measured["shake-01"].assign({VERTICAL: vertical}), read)
    np.testing.assert_array_equal(beginning.motion.vertical, vertical)
