"""summary.json and summary.csv: the contract's form, the results' own numbers, which forecast counts and its score."""

import csv
import json
from types import SimpleNamespace

import pytest

from colonnade.campaign.forms.summary import Summary
from colonnade.store import files
from colonnade.store.forecasts import Forecasts, Known
from colonnade.workflow import run
from colonnade.workflow.graph import RawFile
from colonnade.workflow.summary import choose, is_blind
from foreseeing import LATER, TEST, foreseen_of


def test_the_summary_has_the_contracts_form_and_says_what_the_results_say(undisturbed):
    summary = undisturbed.summary()
    Summary.model_validate(summary)
    assert list(summary) == ["schema", "campaign", "colonnade", "specimens", "tests", "forecasts", "assessments"]
    fallen, test = summary["tests"]["pulse-02"], summary["tests"]["pulse-01"]
    assert (fallen["outcome"], fallen["peak_ratio"], test["release_ratio"]) == ("overturned", None, None)
    rocking, compared = (files.read(undisturbed.layout.stage("pulse-01", stage)) for stage in ("rocking", "compare"))
    assert test["peak_ratio"] == float(rocking["peak_ratio"])
    assert test["pga"] == float(rocking["peak_ground_acceleration"])
    assert test["impacts"] == rocking.sizes["impact"]
    assert test["predicted"]["linear"]["nrmse"] == float(compared["nrmse"].sel(model="linear"))
    rows = list(csv.DictReader(undisturbed.layout.summary_csv.read_text(encoding="utf-8").splitlines()))
    assert [row["test"] for row in rows] == ["free-01", "free-02", "pulse-01", "pulse-02"]
    assert float(rows[2]["peak_ratio"]) == test["peak_ratio"]


def test_free_vibrations_have_the_peak_of_the_time_that_is_predicted_and_the_true_restitution(undisturbed):
    summary, compared = undisturbed.summary(), files.read(undisturbed.layout.stage("free-01", "compare"))
    test, restitution = summary["tests"]["free-01"], summary["specimens"]["prism"]["restitution"]
    assert test["peak_ratio"] == float(compared["measured_peak_ratio"])
    assert test["peak_ratio"] == pytest.approx(test["predicted"]["nonlinear"]["peak_ratio"], abs=2e-3)
    # Released from 0.5; then by Housner's relation, 1 − (1 − φ)² = e² [1 − (1 − φ₀)²]. The raw files are that near.
    assert test["release_ratio"] == pytest.approx(0.5, abs=5e-3)
    assert test["peak_ratio"] == pytest.approx(1 - (1 - 0.93**2 * 0.75) ** 0.5, abs=5e-3)
    assert (restitution["source"], restitution["tests"]) == ("identified", ["free-01", "free-02"])
    assert restitution["low"] < 0.93 < restitution["high"]
    assert restitution["value"] == pytest.approx(0.93, abs=0.002)  # by which the raw files were written


def test_warnings_of_stages_are_the_tests_warnings(small):
    text = small.raw("pulse-01").read_text(encoding="utf-8").splitlines()
    text[50] = "0.245000,OVERFLOW,0.0"
    small.raw("pulse-01").write_text("\n".join(text) + "\n", encoding="utf-8")
    small.run()
    assert any("OVERFLOW" in warning["text"] for warning in small.summary()["tests"]["pulse-01"]["warnings"])
    assert small.summary()["tests"]["pulse-02"]["warnings"] == []


RAW = {"raw/a.csv": RawFile("a" * 64), "raw/b.csv": RawFile(None)}
SEEN = {"raw/a.csv": "a" * 64}
CAMPAIGN = SimpleNamespace(tests={"span": SimpleNamespace(id="span", specimen="prism")})


def forecast(name, raw_files=None, test="span", specimen="prism"):
    return Known(name, "0" * 64, SimpleNamespace(test=test, specimen=specimen, raw_files=raw_files or {}))


def test_a_forecast_is_blind_if_no_raw_file_was_there_by_name_or_content():
    for there in ({}, {"raw/c.csv": "c" * 64}):
        assert is_blind(forecast("f", there), RAW)
    for there in (SEEN, {"raw/a.csv": "c" * 64}, {"elsewhere.csv": "a" * 64}, {"raw/b.csv": "c" * 64}):
        assert not is_blind(forecast("f", there), RAW), there


@pytest.mark.parametrize(
    ("known", "counts", "scored"),
    [
        ((forecast("1"), forecast("2"), forecast("3", SEEN)), ["2"], ["2"]),
        ((forecast("1", SEEN), forecast("2", SEEN)), ["2"], []),
        ((forecast("1", test=None), forecast("2", test="gone"), forecast("3", specimen="cone")), [], []),
    ],
    ids=["the last that is blind", "without one the last, not scored", "of no test or another specimen none"],
)
def test_of_several_forecasts_one_counts(known, counts, scored):
    chosen = choose(CAMPAIGN, Forecasts(known), {"span": RAW})
    for found, expected in ((chosen.counts, counts), (chosen.scored, scored)):
        assert [each.name for each in found.values()] == expected


def summary_of(folder):
    text = (folder / "processed" / "summary.json").read_text(encoding="utf-8")
    return Summary.model_validate_json(text)


def done(result):
    return {(stage.subject, stage.stage) for stage in result.stages if stage.action == "done"}


@pytest.mark.whole
def test_what_was_foreseen_is_scored_after_the_test_and_only_that_is_redone(foreseen_copy):
    folder = foreseen_copy
    run(folder, only=[LATER.replace("9", "2.0")], workers=1)
    before = summary_of(folder)
    assert before.tests[LATER].forecast.reason == "the test has no result yet"
    assert before.tests[LATER].forecast.models["linear"].overturned == 1.0
    assert (before.forecasts.count, before.forecasts.blind, before.forecasts.models) == (2, 2, {})
    raw = (folder / "raw" / "span-2.5.csv").read_bytes()
    (folder / "raw" / f"{LATER}.csv").write_bytes(raw + b"\n")
    assert (LATER, "forecast") in done(run(folder, only=[LATER], workers=1))
    found = summary_of(folder)
    scores = found.tests[LATER].forecast.models["nonlinear"]
    # All members overturned: the score is the distance from 1 to the peak that was measured.
    assert scores.on_target.crps == pytest.approx(1 - found.tests[LATER].peak_ratio)
    assert scores.on_target.brier == 1.0
    assert scores.on_recorded.crps < 0.05
    assert found.forecasts.models["nonlinear"].tests == 1
    assert found.forecasts.models["nonlinear"].skill_rigid_body is None
    assert done(run(folder, only=[LATER], workers=1)) == set()
    late = foreseen_of(folder, motion=TEST, levels=["1x"], test=LATER)[0]
    (folder / "forecasts" / "odd.json").write_text(json.dumps({"a": 1}), encoding="utf-8")
    last = run(folder, only=[LATER], workers=1)
    assert done(last) == set()
    assert [found.text for found in last.of_campaign if found.kind == "forecast"] == [
        "forecasts/odd.json: it was altered after it was made: its hash is another. It is left out."
    ]
    files = {each.file: each for each in summary_of(folder).forecasts.files}
    assert files[late.path.name].blind is False
    assert files["odd.json"].refused
    for path in (folder / "forecasts").iterdir():
        path.unlink()
    run(folder, only=[LATER], workers=1)
    assert summary_of(folder).forecasts is None
    assert not (folder / "processed" / "tests" / LATER / "forecast.nc").exists()
