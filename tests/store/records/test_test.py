"""What goes into the record of a test, from results whose numbers are in sight."""

import numpy as np
import pytest
import xarray as xr

from colonnade.stages.specimen import SpecimenInputs, taken
from colonnade.store.records.stored import Failure, Stored
from colonnade.store.records.test import record_of_specimen, record_of_test

SCALE = 20.0
TIME = np.arange(0.0, 10.0, 0.01)


@pytest.fixture
def campaign(written):
    return written()


def record(campaign, results, test=None):
    datasets = {stage if isinstance(stage, tuple) else (stage, None): each for stage, each in results.items()}
    return record_of_test(campaign, test or campaign.tests["pulse-01"], Stored(datasets))


def rocking(**changes):
    slide = np.where(TIME < 6.0, -0.002 * TIME, 0.4)
    values = {"peak_ratio": 0.4, "peak_time": 4.0, "peak_ground_acceleration": 3.0, "overturning_time": np.nan}
    series = {"rocking_angle": ("elapsed", 0.01 * TIME), "slide": ("elapsed", slide)}
    series |= {"impact_time": ("impact", [1.0, 2.0])}
    return xr.Dataset((values | changes) | series, coords={"elapsed": TIME}, attrs={"outcome": "rocking"})


def compared(order="3", **values):
    found = {"forcing_frequency": 3.01, "frequency_ratio": 3.36, "amplitude_ratio": 1.5, "impacts_per_cycle": 0.7}
    orders = np.array(["3", "irregular"], dtype=object)
    series = {"nrmse": ("model", [0.1, 0.2]), "predicted_response_order": ("model", orders)}
    models = np.array(["linear", "nonlinear"], dtype=object)
    said = {"response_order": order, "response_order_reason": "because"}
    return xr.Dataset((found | values) | series, coords={"model": models}, attrs=said)


def test_prototype_values_stand_beside_the_models(campaign):
    test = record(campaign, {"rocking": rocking()})
    assert test.duration == pytest.approx(9.99)
    assert (test.peak_slide, test.impacts, test.pga) == (0.4, 2, 3.0)
    assert test.prototype.peak_slide == pytest.approx(8.0)
    assert test.prototype.peak_time == pytest.approx(4.0 * np.sqrt(SCALE))
    assert test.prototype.frequency is None


def test_the_slide_of_a_specimen_that_fell_counts_while_it_stood(campaign):
    assert record(campaign, {"rocking": rocking(overturning_time=5.0)}).peak_slide == pytest.approx(0.01)


def test_without_a_scale_there_is_no_prototype(written):
    assert record(written(", scale = 20"), {"rocking": rocking()}).prototype is None


@pytest.mark.parametrize(("stored", "order"), [("", None), ("1", 1), ("3", 3), ("irregular", "irregular")])
def test_a_sine_tests_forcing_and_order_are_the_comparisons(stored, order, campaign):
    sine = campaign.tests["pulse-01"].model_copy(update={"kind": "sine", "frequency": 3.0})
    test = record(campaign, {"rocking": rocking(), "compare": compared(stored)}, sine)
    assert (test.order, test.order_reason, test.impacts_per_cycle) == (order, "because", 0.7)
    assert (test.frequency, test.frequency_ratio, test.amplitude_ratio) == (3.01, 3.36, 1.5)
    assert test.prototype.frequency == pytest.approx(3.01 / np.sqrt(SCALE))
    bare = compared(stored).drop_vars(["forcing_frequency", "amplitude_ratio", "impacts_per_cycle"])
    test = record(campaign, {"rocking": rocking(), "compare": bare}, sine)
    assert (test.frequency, test.amplitude_ratio) == (3.0, None)


def test_each_models_order_and_error_are_its_own(campaign):
    result = xr.Dataset({"peak_ratio": ((), 0.4)}, attrs={"outcome": "rocking"})
    models = {("predict", "linear"): result, ("predict", "nonlinear"): result}
    predicted = record(campaign, models | {"compare": compared()}).predicted
    assert (predicted["linear"].order, predicted["linear"].nrmse) == (3, 0.1)
    assert (predicted["nonlinear"].order, predicted["nonlinear"].nrmse) == ("irregular", 0.2)
    assert record(campaign, models).predicted["linear"].nrmse is None


def test_a_record_is_done_failed_or_pending_with_the_reason(campaign):
    def status(stored):
        test = record_of_test(campaign, campaign.tests["pulse-01"], stored)
        return test.status, test.reason

    assert status(Stored()) == ("pending", None)
    assert status(Stored(outdated="out of date")) == ("pending", "out of date")
    assert status(Stored({("compare", None): compared()})) == ("done", None)
    failures = [Failure("ingest", "No file."), Failure("", "Specimen prism failed.")]
    told = ("failed", "ingest: No file. Specimen prism failed.")
    assert status(Stored({("compare", None): compared()}, failures=failures)) == told


@pytest.mark.parametrize(
    ("more", "known"),
    [('date = "26.04.2013"\noperator = "Κ. Παπάς"\n', ("2013-04-26", "Κ. Παπάς")), ("", (None, None))],
)
def test_the_record_says_who_and_when_if_that_is_known(written, more, known):
    said = record(written(more=more), {})
    assert (said.date, said.operator) == known


@pytest.fixture
def of_specimen(written):
    campaign = written()
    return lambda name: record_of_specimen(campaign, name, taken(None, SpecimenInputs.of(campaign, name)))


def test_an_e_is_one_value_or_one_a_side_with_its_source(of_specimen):
    given, rigid = of_specimen("statue").restitution, of_specimen("prism").restitution
    assert (given.value, given.source, given.reason) == ((0.9, 0.8), "given", None)
    assert (rigid.value, rigid.source) == (pytest.approx(0.9485, abs=5e-5), "rigid-body")
    assert "have not been identified" in rigid.reason
