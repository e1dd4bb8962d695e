"""summary.json and summary.csv: the contract's form, and the results' own numbers."""

import csv

import pytest

from colonnade.campaign.forms.summary import Summary
from colonnade.store import files


def test_the_summary_has_the_contracts_form(undisturbed):
    summary = undisturbed.summary()
    Summary.model_validate(summary)
    assert list(summary) == ["schema", "campaign", "colonnade", "specimens", "tests", "forecasts", "assessments"]
    assert summary["tests"]["pulse-02"]["outcome"] == "overturned"
    assert summary["tests"]["pulse-02"]["peak_ratio"] is None


def test_the_summary_says_what_the_results_say(undisturbed):
    test = undisturbed.summary()["tests"]["pulse-01"]
    rocking = files.read(undisturbed.layout.stage("pulse-01", "rocking"))
    compared = files.read(undisturbed.layout.stage("pulse-01", "compare"))
    assert test["peak_ratio"] == float(rocking["peak_ratio"])
    assert test["pga"] == float(rocking["peak_ground_acceleration"])
    assert test["impacts"] == rocking.sizes["impact"]
    assert test["predicted"]["linear"]["nrmse"] == float(compared["nrmse"].sel(model="linear"))


def test_a_free_vibrations_peak_is_that_of_the_time_that_is_predicted(undisturbed):
    summary = undisturbed.summary()["tests"]
    test, compared = summary["free-01"], files.read(undisturbed.layout.stage("free-01", "compare"))
    assert test["peak_ratio"] == float(compared["measured_peak_ratio"])
    assert test["peak_ratio"] == pytest.approx(test["predicted"]["nonlinear"]["peak_ratio"], abs=2e-3)
    # Released from 0.5; then by Housner's relation, 1 − (1 − φ)² = e² [1 − (1 − φ₀)²]. The raw files are that near.
    assert test["release_ratio"] == pytest.approx(0.5, abs=5e-3)
    assert test["peak_ratio"] == pytest.approx(1 - (1 - 0.93**2 * 0.75) ** 0.5, abs=5e-3)
    assert summary["pulse-01"]["release_ratio"] is None


def test_the_specimens_restitution_is_the_true_one_with_its_interval(undisturbed):
    restitution = undisturbed.summary()["specimens"]["prism"]["restitution"]
    assert restitution["source"] == "identified"
    assert restitution["tests"] == ["free-01", "free-02"]
    assert restitution["low"] < 0.93 < restitution["high"]
    assert restitution["value"] == pytest.approx(0.93, abs=0.002)  # by which the raw files were written


def test_the_table_has_a_row_a_test_with_the_same_numbers(undisturbed):
    rows = list(csv.DictReader(undisturbed.layout.summary_csv.read_text(encoding="utf-8").splitlines()))
    assert [row["test"] for row in rows] == ["free-01", "free-02", "pulse-01", "pulse-02"]
    assert float(rows[2]["peak_ratio"]) == undisturbed.summary()["tests"]["pulse-01"]["peak_ratio"]
    assert rows[3]["peak_ratio"] == ""


def test_a_free_vibration_shows_peaks_and_whole_history(undisturbed):
    found = undisturbed.summary()["tests"]["free-01"]["restitution"]
    stored = files.read(undisturbed.layout.stage("free-01", "restitution"))
    assert found["value"] == float(stored["restitution"])
    assert set(found["whole_history"]) == {"nonlinear"}
    history = found["whole_history"]["nonlinear"]
    assert history["value"] == float(stored["restitution_history"].sel(model="nonlinear"))
    assert history["value"] == pytest.approx(0.93, abs=1e-3)
    assert history["low"] < history["value"] < history["high"]


def test_warnings_of_stages_are_the_tests_warnings(small):
    text = small.raw("pulse-01").read_text(encoding="utf-8").splitlines()
    text[50] = "0.245000,OVERFLOW,0.0"
    small.raw("pulse-01").write_text("\n".join(text) + "\n", encoding="utf-8")
    small.run()
    assert any("OVERFLOW" in warning["text"] for warning in small.summary()["tests"]["pulse-01"]["warnings"])
    assert small.summary()["tests"]["pulse-02"]["warnings"] == []
