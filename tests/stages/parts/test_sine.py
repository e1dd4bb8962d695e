"""Sine tests: Ω and A of what the table did, and the order of the measured and of each predicted response."""

import numpy as np
import pytest
import xarray as xr

import chain
from chain import compared

FREQUENCY, AMPLITUDE = 4.0, 1.7  # of the base motion that `shaken` makes


@pytest.fixture
def sine_test(small_campaign):
    return small_campaign.tests["shake-01"].model_copy(update={"kind": "sine", "frequency": FREQUENCY})


@pytest.fixture
def measured(small_campaign, shaken, sine_test):
    return chain.measured(small_campaign, sine_test, shaken[0])[1]


@pytest.fixture
def predicted(small_campaign, measured, sine_test):
    pooled = chain.pooled(small_campaign, {}, given=0.93)
    return {
        model: chain.predicted(small_campaign, sine_test, measured, pooled, model) for model in ("linear", "nonlinear")
    }


def test_frequency_and_amplitude_ratio_are_those_of_the_recorded_motion(small_campaign, sine_test, measured, predicted):
    result = compared(small_campaign, sine_test, measured, predicted)
    block = small_campaign.block("prism")
    assert float(result["forcing_frequency"]) == pytest.approx(FREQUENCY, rel=1e-3)
    assert float(result["frequency_ratio"]) == pytest.approx(2 * np.pi * FREQUENCY / block.p, rel=1e-3)
    assert float(result["amplitude_ratio"]) == pytest.approx(AMPLITUDE, rel=5e-3)
    assert result.attrs["warnings"] == []


def test_measured_and_predicted_responses_have_the_true_order(small_campaign, sine_test, shaken, measured, predicted):
    _, time, angle, _ = shaken
    late = (time > 4.5) & (time < 5.75)
    unlike = np.std(np.interp(time[late] + 1 / FREQUENCY, time, angle) - angle[late]) / np.std(angle[late])
    assert unlike < 0.6
    result = compared(small_campaign, sine_test, measured, predicted)
    assert result.attrs["response_order"] == "1"
    assert "every period" in result.attrs["response_order_reason"]
    assert result["model"].to_numpy().tolist() == ["linear", "nonlinear"]
    assert result["predicted_response_order"].to_numpy()[0] == "1"  # the linear model is the truth here
    assert float(result["impacts_per_cycle"]) == pytest.approx(2.0, abs=0.4)


def test_another_frequency_than_the_given_one_is_told_and_the_recorded_one_used(
    small_campaign, sine_test, measured, predicted
):
    wrong = sine_test.model_copy(update={"frequency": 4.1})
    result = compared(small_campaign, wrong, measured, predicted)
    assert "4.1 Hz" in result.attrs["warnings"][0].text
    assert float(result["forcing_frequency"]) == pytest.approx(FREQUENCY, rel=1e-3)
    near = compared(small_campaign, sine_test.model_copy(update={"frequency": 4.03}), measured, predicted)
    assert near.attrs["warnings"] == []


@pytest.mark.parametrize("ratio", [0.5, 0.87, 0.95, 1.05, 1.15, 2.0])
def test_another_amplitude_than_the_given_one_is_told_with_what_follows(
    ratio, small_campaign, sine_test, measured, predicted
):
    recorded = AMPLITUDE * small_campaign.block("prism").uplift_acceleration
    asked = sine_test.model_copy(update={"amplitude": recorded / ratio})
    told = [each.text for each in compared(small_campaign, asked, measured, predicted).attrs["warnings"]]
    assert len(told) == (abs(ratio - 1) > 0.1)
    assert all(f"{ratio:.2f} times the test's `amplitude`" in text for text in told)
    assert all(f"then A is {1 / ratio:.2f} times" in text for text in told)


@pytest.mark.parametrize(("outcome", "words"), [("overturned", "overturned"), ("no-rocking", "did not rock")])
def test_what_overturned_or_did_not_rock_has_no_order(outcome, words, small_campaign, sine_test, measured, predicted):
    result = compared(small_campaign, sine_test, measured.assign_attrs(outcome=outcome), predicted)
    assert result.attrs["response_order"] == ""
    assert words in result.attrs["response_order_reason"]
    assert np.isfinite(float(result["amplitude_ratio"]))


def test_a_motion_that_is_no_sine_keeps_the_given_frequency_and_is_told(small_campaign, sine_test, measured, predicted):
    noise = np.random.default_rng(0).normal(0, 1, measured.sizes["elapsed"])
    shaken = measured.assign(base_acceleration=("elapsed", noise))
    result = compared(small_campaign, sine_test, shaken, predicted)
    assert "no stretch of 3 periods" in result.attrs["warnings"][0].text
    assert float(result["frequency_ratio"]) == pytest.approx(2 * np.pi * 4.0 / small_campaign.block("prism").p)
    assert "amplitude_ratio" not in result


def test_a_specimen_without_transducers_has_forcing_and_predicted_orders(
    small_campaign, sine_test, measured, predicted
):
    bare = xr.Dataset({"base_acceleration": measured["base_acceleration"]}, attrs={"outcome": ""})
    result = compared(small_campaign, sine_test, bare, predicted)
    assert result.attrs["response_order"] == ""
    assert "No rocking angle" in result.attrs["response_order_reason"]
    assert result["predicted_response_order"].to_numpy()[0] == "1"
