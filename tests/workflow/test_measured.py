"""What goes into a test's record of the summary, from results whose numbers are in sight."""

from __future__ import annotations

import csv

import numpy as np
import pytest
import xarray as xr

from colonnade.campaign import load
from colonnade.store import files
from colonnade.workflow.measured import measured, predicted, specimen_prototype

SCALE = 20.0
TIME = np.arange(0.0, 10.0, 0.01)


@pytest.fixture
def campaign(undisturbed, tmp_path):
    text = (undisturbed.folder / "campaign.toml").read_text(encoding="utf-8")
    path = tmp_path / "campaign.toml"
    path.write_text(text.replace('mass = "26.10 kg"', 'mass = "26.10 kg", scale = 20'), encoding="utf-8")
    return load(path)


def rocking(**changes):
    slide = np.where(TIME < 6.0, -0.002 * TIME, 0.4)
    values = {
        "peak_ratio": 0.4,
        "peak_time": 4.0,
        "peak_ground_acceleration": 3.0,
        "overturning_time": np.nan,
    } | changes
    return xr.Dataset(
        {name: ((), value) for name, value in values.items()}
        | {
            "rocking_angle": ("elapsed", 0.01 * TIME),
            "slide": ("elapsed", slide),
            "impact_time": ("impact", [1.0, 2.0]),
        },
        coords={"elapsed": TIME},
        attrs={"outcome": "rocking"},
    )


def compared(order="3", **values):
    found = {"forcing_frequency": 3.01, "frequency_ratio": 3.36, "amplitude_ratio": 1.5, "impacts_per_cycle": 0.7}
    return xr.Dataset(
        {name: ((), value) for name, value in (found | values).items()}
        | {
            "nrmse": ("model", [0.1, 0.2]),
            "predicted_response_order": ("model", np.array(["3", "irregular"], dtype=object)),
        },
        coords={"model": np.array(["linear", "nonlinear"], dtype=object)},
        attrs={"response_order": order, "response_order_reason": "because"},
    )


def test_prototype_values_stand_beside_the_models(campaign):
    fields = measured(campaign, campaign.tests["pulse-01"], {"rocking": rocking()})
    assert fields["duration"] == pytest.approx(9.99)
    assert fields["peak_slide"] == 0.4
    assert fields["prototype"].peak_slide == pytest.approx(8.0)
    assert fields["prototype"].peak_time == pytest.approx(4.0 * np.sqrt(SCALE))
    prototype = specimen_prototype(campaign, "prism")
    assert prototype.sizes == pytest.approx({"width": 1.72, "depth": 1.72, "height": 9.12})
    assert prototype.p == pytest.approx(campaign.block("prism").p / np.sqrt(SCALE))
    assert prototype.mass == pytest.approx(26.10 * SCALE**3)


def test_the_slide_of_a_specimen_that_fell_counts_while_it_stood(campaign):
    fields = measured(campaign, campaign.tests["pulse-01"], {"rocking": rocking(overturning_time=5.0)})
    assert fields["peak_slide"] == pytest.approx(0.01)


def test_without_a_scale_there_is_no_prototype(undisturbed):
    campaign = load(undisturbed.folder)
    assert "prototype" not in measured(campaign, campaign.tests["pulse-01"], {"rocking": rocking()})
    assert specimen_prototype(campaign, "prism") is None


@pytest.mark.parametrize(("stored", "order"), [("", None), ("1", 1), ("3", 3), ("irregular", "irregular")])
def test_a_sine_tests_forcing_and_order_are_the_comparisons(stored, order, campaign):
    sine = campaign.tests["pulse-01"].model_copy(update={"kind": "sine", "frequency": 3.0})
    fields = measured(campaign, sine, {"rocking": rocking(), "compare": compared(stored)})
    assert fields["order"] == order
    assert (fields["frequency"], fields["frequency_ratio"], fields["amplitude_ratio"]) == (3.01, 3.36, 1.5)
    assert fields["prototype"].frequency == pytest.approx(3.01 / np.sqrt(SCALE))
    bare = compared(stored).drop_vars(["forcing_frequency", "amplitude_ratio", "impacts_per_cycle"])
    fields = measured(campaign, sine, {"rocking": rocking(), "compare": bare})
    assert fields["frequency"] == 3.0
    assert np.isnan(fields["amplitude_ratio"])


def test_each_models_order_and_error_are_its_own():
    result = xr.Dataset({"peak_ratio": ((), 0.4)}, attrs={"outcome": "rocking"})
    done = {"predict-linear": result, "predict-nonlinear": result, "compare": compared()}
    assert (predicted(done, "linear").order, predicted(done, "linear").nrmse) == (3, 0.1)
    assert (predicted(done, "nonlinear").order, predicted(done, "nonlinear").nrmse) == ("irregular", 0.2)
    assert predicted({"predict-linear": result}, "linear").nrmse is None


def test_a_free_vibration_shows_peaks_and_whole_history(undisturbed):
    found = undisturbed.summary()["tests"]["free-01"]["restitution"]
    stored = files.read(undisturbed.layout.stage("free-01", "restitution"))
    assert found["value"] == float(stored["restitution"])
    assert set(found["whole_history"]) == {"linear", "nonlinear"}
    linear = found["whole_history"]["linear"]  # the model that the raw files were made with
    assert linear["value"] == float(stored["restitution_history"].sel(model="linear"))
    assert linear["value"] == pytest.approx(0.93, abs=1e-3)
    assert linear["low"] < linear["value"] < linear["high"]


def test_the_table_holds_them_in_columns_of_their_own_and_nothing_where_there_is_nothing(undisturbed):
    rows = list(csv.DictReader(undisturbed.layout.summary_csv.read_text(encoding="utf-8").splitlines()))
    summary = undisturbed.summary()["tests"]
    free, pulse = rows[0], rows[2]
    assert float(free["restitution_value"]) == summary["free-01"]["restitution"]["value"]
    assert float(free["restitution_history_linear_value"]) > 0.9
    assert (pulse["restitution_value"], pulse["order"], pulse["warnings"]) == ("", "", "")
    assert {pulse["linear_outcome"], pulse["nonlinear_outcome"]} <= {"rocking", "overturned"}
