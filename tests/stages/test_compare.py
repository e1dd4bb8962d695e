"""Measured and predicted histories that are written by hand, compared in numbers that are known."""

import numpy as np
import pytest
import xarray as xr

import chain
from colonnade.findings import MEASUREMENT, Severity
from colonnade.stages.compare import CompareInputs, compare
from every import every
from prism import PRISM

ALPHA = PRISM.critical_angle
TIME = 2.0 + 0.01 * np.arange(200)
SWING = 0.4 * np.sin(2 * np.pi * 3.0 * TIME)
"""|θ|/α of a block that rocks."""


def history(ratio, *, outcome="rocking", zero_offset=0.0):
    """A rocking angle given in α, with what both `rocking` and `predict` say of it."""
    ratio = np.asarray(ratio, dtype=float)
    largest = int(np.nanargmax(np.abs(ratio)))
    peak = {"peak_ratio": float(np.abs(ratio[largest])), "peak_time": float(TIME[largest])}
    angle = "elapsed", ALPHA * ratio + zero_offset
    zero = {"zero_offset": zero_offset, "angle_gain": 1.0}
    return unmeasured().assign(rocking_angle=angle, **zero, **peak).assign_attrs(outcome=outcome)


def unmeasured():
    """What `rocking` gives without transducers."""
    return xr.Dataset(coords={"elapsed": TIME}, attrs={"outcome": ""})


def inputs(**changes):
    return CompareInputs(block=PRISM, **{"observed_outcome": None, "kind": "earthquake", **changes})


def against(measured, predicted, **changes):
    """The comparison with one model."""
    return compare(measured, {"linear": predicted}, inputs(**changes)).isel(model=0)


@every("measured_falls", [True, False])
def test_nothing_counts_from_where_either_first_passes_the_critical_angle(measured_falls):
    falling = np.where(np.arange(TIME.size) < 120, SWING, 1.5)
    pair = (falling, SWING + 0.1) if measured_falls else (SWING + 0.1, falling)
    found = against(*map(history, pair))
    assert float(found["nrmse"]) == pytest.approx(0.1)
    assert float(found["compared_until"]) == TIME[119]


def test_samples_that_are_missing_do_not_count_and_without_any_below_the_critical_angle_there_is_no_nrmse():
    measured, predicted = SWING.copy(), SWING + 0.1
    measured[20:40], predicted[60:90] = np.nan, np.nan
    assert float(against(history(measured), history(predicted))["nrmse"]) == pytest.approx(0.1)
    fallen = against(history(np.full(TIME.size, 1.2)), history(SWING))
    assert np.isnan([fallen["nrmse"], fallen["compared_until"]]).all()


def test_the_measured_angle_counts_about_the_true_zero():
    measured = history(SWING, zero_offset=0.01)
    found = against(measured, history(SWING).assign(zero_offset=0.01))
    assert float(found["nrmse"]) == pytest.approx(0.0, abs=1e-12)
    assert float(found["zero_offset"]) == 0.01
    assert float(against(measured, history(SWING))["nrmse"]) == pytest.approx(0.01 / ALPHA)


def test_models_stand_in_order_each_with_its_own_numbers():
    shares = {"nonlinear": 0.5, "contact": 1.25, "linear": 1.0}
    predicted = {model: history(share * SWING) for model, share in shares.items()}
    found = compare(history(SWING), predicted, inputs())
    order = ["contact", "linear", "nonlinear"]
    assert found["model"].to_numpy().tolist() == order
    rms = float(np.sqrt(np.mean(SWING**2)))
    peak = float(np.abs(SWING).max())
    for number, model in enumerate(order):
        assert float(found["nrmse"][number]) == pytest.approx(abs(shares[model] - 1) * rms, abs=1e-12)
        assert float(found["peak_ratio_error"][number]) == pytest.approx((shares[model] - 1) * peak, abs=1e-12)
    alone = compare(history(SWING), {}, inputs(frequency=3.0))  # without models, and of a test that is no sine
    assert alone.sizes["model"] == 0
    assert "frequency_ratio" not in alone
    assert "response_order" not in alone.attrs
    for each in (found, alone):
        assert float(each["measured_peak_ratio"]) == pytest.approx(peak)
        assert float(each["measured_peak_time"]) == TIME[np.argmax(np.abs(SWING))]


def test_without_a_measured_angle_nothing_has_a_number():
    found = against(unmeasured(), history(SWING), observed_outcome="rocking")
    assert np.isnan(found[["nrmse", "compared_until", "peak_ratio_error", "measured_peak_ratio"]].to_array()).all()
    assert found.attrs["warnings"] == []


@every(
    ("measured", "observed", "agree"),
    [
        ("rocking", "rocking", True),
        ("overturned", "overturned", True),
        ("rocking", "not-overturned", True),
        ("no-rocking", "not-overturned", True),
        ("rocking", None, True),
        ("", "overturned", True),
        ("overturned", "not-overturned", False),
        ("rocking", "overturned", False),
        ("no-rocking", "rocking", False),
    ],
)
def test_the_transducers_and_the_log_agree_or_it_is_serious(measured, observed, agree):
    found = against(history(SWING, outcome=measured), history(SWING), observed_outcome=observed)
    warnings = found.attrs["warnings"]
    assert (warnings == []) is agree
    if not agree:
        found = warnings[0]
        assert (found.kind, found.severity, found.follows) == ("outcome", Severity.SERIOUS, MEASUREMENT)
        assert f"The transducers show {measured}, the test log says {observed}" in warnings[0].text


FREQUENCY, AMPLITUDE = 4.0, 1.7  # of the base motion that `shaken` makes


@pytest.fixture
def sine(small_campaign, shaken):
    """Compare the sine test with two models, some of its keys and of what was measured changed."""
    test = small_campaign.tests["shake-01"].model_copy(update={"kind": "sine", "frequency": FREQUENCY})
    measured, pooled = chain.measured(small_campaign, test, shaken[0])[1], chain.pooled(small_campaign, {}, given=0.93)
    models = ("linear", "nonlinear")
    predicted = {model: chain.predicted(small_campaign, test, measured, pooled, model) for model in models}

    def compared(changes=None, outcome="rocking", **channels):
        seen = measured.assign({name: ("elapsed", values) for name, values in channels.items()})
        seen = (seen if outcome else seen.drop_vars("rocking_angle")).assign_attrs(outcome=outcome)
        return chain.compared(small_campaign, test.model_copy(update=changes), seen, predicted)

    return compared


def test_the_forcing_is_the_recorded_one_and_responses_have_the_true_order(sine):
    result = sine()
    assert float(result["forcing_frequency"]) == pytest.approx(FREQUENCY, rel=1e-3)
    assert float(result["frequency_ratio"]) == pytest.approx(2 * np.pi * FREQUENCY / PRISM.p, rel=1e-3)
    assert float(result["amplitude_ratio"]) == pytest.approx(AMPLITUDE, rel=5e-3)
    assert result.attrs["warnings"] == []
    assert result.attrs["response_order"] == "1"
    assert "every period" in result.attrs["response_order_reason"]
    assert result["predicted_response_order"].to_numpy()[0] == "1"  # the linear model is the truth here
    assert float(result["impacts_per_cycle"]) == pytest.approx(2.0, abs=0.4)


RECORDED = AMPLITUDE * PRISM.uplift_acceleration


@every(
    ("asked", "said"),
    [
        ({"frequency": 4.1}, "4.1 Hz"),
        ({"frequency": 4.03}, None),
        ({"amplitude": RECORDED / 0.87}, "0.87 times the test's `amplitude`"),
        ({"amplitude": RECORDED / 1.15}, "1.15 times the test's `amplitude`"),
        ({"amplitude": RECORDED / 0.95}, None),
    ],
)
def test_another_frequency_or_amplitude_than_the_given_one_is_told_and_the_recorded_one_used(asked, said, sine):
    result = sine(asked)
    told = [each.text for each in result.attrs["warnings"]]
    assert len(told) == (said is not None)
    assert all(said in text for text in told)
    assert float(result["forcing_frequency"]) == pytest.approx(FREQUENCY, rel=1e-3)


@every(("outcome", "words"), [("overturned", "overturned"), ("no-rocking", "did not rock"), ("", "No rocking angle")])
def test_what_overturned_did_not_rock_or_was_not_measured_has_no_order(outcome, words, sine):
    result = sine(outcome=outcome)
    assert result.attrs["response_order"] == ""
    assert words in result.attrs["response_order_reason"]
    assert result["predicted_response_order"].to_numpy()[0] == "1"


def test_a_motion_that_is_no_sine_keeps_the_given_frequency_and_is_told(sine, shaken):
    noise = np.random.default_rng(0).normal(0, 1, shaken[1].size)
    result = sine(base_acceleration=noise)
    assert "no stretch of 3 periods" in result.attrs["warnings"][0].text
    assert float(result["frequency_ratio"]) == pytest.approx(2 * np.pi * 4.0 / PRISM.p)
    assert "amplitude_ratio" not in result


def test_what_the_ensembles_say_stands_by_model_and_a_model_without_one_keeps_its_place():
    said = {"horizon": 4.5, "within_spread": 0.3, "peak_rank": 0.5, "overturning_probability": 0.25}
    predicted = {model: history(SWING) for model in ("contact", "linear")}
    found = compare(history(SWING), predicted, inputs(), {"linear": xr.Dataset(said)})
    for name, value in said.items():
        assert np.isnan(found[name][0]), name
        assert float(found[name][1]) == value, name
    assert "horizon" not in compare(history(SWING), predicted, inputs())
